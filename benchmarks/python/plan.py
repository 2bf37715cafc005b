# SPDX-License-Identifier: BSD-3-Clause
"""Plans of an arm among obstacles: ``python -m benchmarks.python.plan``.

Scenarios: a Panda under the bow of a box hull over a triangulated survey. Sampling: from a stowed
posture to points of the bottom that the arm can reach, the tip may touch it. Collides: from a
posture on one side of a mast to one on the other whose straight motion touches something. Random
worlds: a Panda on a hull among spheres, between postures whose straight motion touches. Every path
is sampled densely before any figure is printed: by clearances, those in random worlds at every
tenth row by Coal (PyPI ``coal``), too.

OMPL's RRTConnect (PyPI ``ompl``, where it is installed; it is no requirement of the project) is
asked for the same motions, its motions checked by our ``check_motion``, and ended at the same
number of checks.
"""

import argparse
import platform
import time

import coal
import numpy as np

import bathyal
from tests.support.coal_bodies import touches_by_coal
from tests.support.random_worlds import dense, random_spheres
from tests.support.vehicles import box_mesh, pose

STEP = 1e-3  # [rad] of dense samples
MOUNT = np.array([[1.0, 0, 0, 0.6], [0, -1, 0, 0], [0, 0, -1, -0.25], [0, 0, 0, 1]])
STOWED = np.array([0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785])
ALTITUDE = 1.3  # of the vehicle over the bottom [m]


def scenario():
    """Panda, hull and survey, the vehicle over its middle."""
    survey = bathyal.generate_survey(origin=(0, 0, -38), length=24, width=12, boulders=40)
    bottom = bathyal.triangulate(survey)
    scene = bathyal.Scene(bottom)
    middle = bottom.vertices[:, :2].mean(axis=0)
    under = scene.cast([[*middle, 0.0]], [[0, 0, -1.0]]).point[0]
    place = pose(under[0], under[1], under[2] + ALTITUDE)
    hull = bathyal.Hull(box_mesh([-1.0, -0.35, -0.25], [1.0, 0.35, 0.25]))
    mast = bathyal.KeepOut.cylinder(0.04, 0.6, pose(1.15, 0.0, -0.55), name="mast")
    return bathyal.Workspace(
        bathyal.arms.panda(), MOUNT, hull=hull, scene=scene, keepouts=[mast], vehicle_pose=place
    )


def reachable(ws, rng, low, high, above):
    """A point `above` the bottom under the arm's reach that is free to go to, and a posture."""
    world = ws.vehicle_pose.at(0.0)
    while True:
        out, turn = rng.uniform(0.2, 0.9), rng.uniform(low, high)
        over = world @ [0.6 + out * np.cos(turn), out * np.sin(turn), 0.0, 1.0]
        point = ws.scene.cast([over[:3]], [[0, 0, -1.0]]).point[0] + [0, 0, above]
        found = ws.check_target([point])
        near = ws.clearance(found.q[0]) if found.status[0] == "free" else None
        if near and (above == 0.0 or near.distance > 0.02):
            return point, found.q[0]


def around_the_mast(ws, count):
    """Pairs of postures to port and to starboard whose straight motion touches something."""
    rng = np.random.default_rng(3)
    pairs = []
    while len(pairs) < count:
        port = reachable(ws, rng, 0.15, 1.2, 0.3)[1]
        starboard = reachable(ws, rng, -1.2, -0.15, 0.3)[1]
        if not ws.check_motion([port, starboard]):
            pairs.append((port, starboard))
    return pairs


def pairs_that_collide(ws, rng, count):
    """Free postures whose straight motion touches something."""
    found = []
    while len(found) < count:
        q = rng.uniform(ws.arm.lower, ws.arm.upper, (64, len(ws.arm.lower)))
        near = ws.clearance(q)
        q = q[np.minimum(near.distance, near.self_distance) > 0.01]
        found += [(a, b) for a, b in zip(q[:-1:2], q[1::2], strict=False)
                  if not ws.check_motion([a, b])]  # fmt: skip
    return found[:count]


def verify(ws, plan, tip_contact=False):
    """Ends the run when a path touches between its rows, or breaks a limit."""
    rows = dense(plan.path, STEP)
    near = ws.clearance(rows, tip_contact=tip_contact)
    if not (np.minimum(near.distance, near.self_distance) >= 0).all():
        raise SystemExit("a path touches something")
    if not ((plan.path >= ws.arm.lower) & (plan.path <= ws.arm.upper)).all():
        raise SystemExit("a path leaves the limits")
    return rows


def timed(ws, tasks, **options):
    seconds, plans = [], []
    for seed, (start, goal) in enumerate(tasks):
        begin = time.process_time()
        plans.append(ws.plan(start, **goal, seed=seed, **options))
        seconds.append(time.process_time() - begin)
    return np.array(seconds), plans


def row(name, ws, tasks, **options):
    seconds, plans = timed(ws, tasks, **options)
    solved = [plan for plan in plans if plan]
    for plan in solved:
        verify(ws, plan, **options)
    checks = [plan.checks for plan in plans]
    print(
        f"| {name} | {len(solved)} of {len(tasks)} | {1e3 * np.median(seconds):.0f} | "
        f"{1e3 * np.quantile(seconds, 0.9):.0f} | {1e3 * seconds.max():.0f} | "
        f"{np.median(checks):.0f} | {np.median([p.time[-1] for p in solved]):.1f} |",
        flush=True,
    )


def ompl_solves(ompl, ws, start, goal, seed, max_checks):
    """Whether RRTConnect with OMPL's own settings finds a path within so many checks."""
    base, geometric, util = ompl
    used = 0
    size = len(ws.arm.lower)

    def posture(state):
        return np.array([state[k] for k in range(size)])

    class Motions(base.MotionValidator):
        def checkMotion(self, one, other):
            nonlocal used
            used += 1
            return ws.check_motion([posture(one), posture(other)]).free

    def valid(state):
        nonlocal used
        used += 1
        return ws.check_motion([posture(state)]).free

    util.RNG.setSeed(seed + 1)
    space = base.RealVectorStateSpace(size)
    bounds = base.RealVectorBounds(size)
    for k in range(size):
        bounds.setLow(k, float(ws.arm.lower[k]))
        bounds.setHigh(k, float(ws.arm.upper[k]))
    space.setBounds(bounds)
    setup = geometric.SimpleSetup(space)
    information = setup.getSpaceInformation()
    setup.setStateValidityChecker(valid)
    motions = Motions(information)
    information.setMotionValidator(motions)
    ends = []
    for q in (start, goal):
        state = space.allocState()
        for k in range(size):
            state[k] = float(q[k])
        ends.append(state)
    setup.setStartAndGoalStates(*ends)
    setup.setPlanner(geometric.RRTConnect(information))
    setup.solve(base.PlannerTerminationCondition(lambda: used >= max_checks))
    return setup.haveExactSolutionPath() and used <= max_checks


def load_ompl():
    try:
        from ompl import base, geometric, util
    except ImportError:
        return None
    util.noOutputHandler()
    return base, geometric, util


def random_worlds(count, limits):
    """Plans in random worlds, verified, and the share solved within each number of checks."""
    ompl = load_ompl()
    ours, theirs = np.zeros(len(limits), dtype=int), np.zeros(len(limits), dtype=int)
    solved, sampled, seconds = 0, 0, []
    for seed in range(count):
        ws = random_spheres(seed, 10)
        start, goal = pairs_that_collide(ws, np.random.default_rng([seed, 2]), 1)[0]
        begin = time.process_time()
        plan = ws.plan(start, goal, seed=seed)
        seconds.append(time.process_time() - begin)
        if plan:
            rows = verify(ws, plan)
            if touches_by_coal(ws, rows[::10]).any():
                raise SystemExit(f"Coal sees a contact in world {seed}")
            solved += 1
            sampled += len(rows)
        for k, most in enumerate(limits):
            ours[k] += ws.plan(start, goal, seed=seed, max_checks=most).status == "solved"
            if ompl:
                theirs[k] += ompl_solves(ompl, ws, start, goal, seed, most)
    print(
        f"\nRandom worlds: {solved} of {count} solved, median {1e3 * np.median(seconds):.0f} ms; "
        f"{sampled:,} rows sampled along the paths, at most {STEP} rad apart, none touches.\n"
    )
    print("| checks at most | ours solved | OMPL's RRTConnect solved |")
    print("|---|---|---|")
    for k, most in enumerate(limits):
        other = f"{theirs[k]} of {count}" if ompl else "not installed"
        print(f"| {most} | {ours[k]} of {count} | {other} |")


def run(seeds, worlds, limits):
    print("## Plans among obstacles\n")
    ws = scenario()
    triangles = sum(len(mesh.triangles) for mesh in ws.scene.meshes)
    print("| scenario | solved | median [ms] | 90 % [ms] | longest [ms] | checks | motion [s] |")
    print("|---|---|---|---|---|---|---|")
    rng = np.random.default_rng(7)
    points = [reachable(ws, rng, -1.5, 1.5, 0.0)[0] for _ in range(seeds)]
    row(
        "sampling", ws, [(STOWED, {"point": point}) for point in points], tip_contact=True,
    )  # fmt: skip
    row("straight motion collides", ws, [(a, {"goal": b}) for a, b in around_the_mast(ws, seeds)])
    random_worlds(worlds, limits)
    print(
        f"\n`python -m benchmarks.python.plan`: {seeds} seeds, a bottom of {triangles:,} "
        f"triangles, processor time of one thread; every path sampled each {STEP} rad before "
        f"figures are printed. Coal {coal.__version__}, numpy {np.__version__}, Python "
        f"{platform.python_version()}."
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--worlds", type=int, default=1000)
    parser.add_argument("--checks", type=int, nargs="+", default=[10, 20, 40, 80, 160, 320])
    arguments = parser.parse_args()
    run(arguments.seeds, arguments.worlds, arguments.checks)
