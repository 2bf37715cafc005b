# SPDX-License-Identifier: BSD-3-Clause
"""Reach maps against inverse kinematics: ``python -m benchmarks.python.reach_map``.

The map of about 10⁶ voxels and 26 directions is made by forward sampling; `Arm.inverse`, with up to
64 starts, answers the same for 10⁴ voxels drawn over the whole box, in any orientation and along a
direction drawn for each. Agreement is printed before any time; that of a time is the map without
and with the look for collisions (the arm's capsules, of 5 cm, among themselves and against a box
that it is bolted to).
"""

import argparse
import platform
import time

import numpy as np

import bathyal
from tests.support.reach import differences

VOXELS = 1_000_000
CHECKED = 10_000
GOAL = 0.99
HULL_HALF = np.array([0.6, 0.3, 0.25])


def box():
    corners = HULL_HALF * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
    faces += [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    corners[:, 2] -= HULL_HALF[2] + 0.02  # the foot is bolted to its lid
    return bathyal.Hull(bathyal.TriangleMesh(corners, faces))


def edge_for(ws, voxels):
    """Edge of a voxel for about so many of them."""
    edge = 0.1
    for _ in range(3):
        made = ws.reach_map(voxel=edge, directions=6, samples=1, check_clearance=False)
        edge *= float((made.reached.size / voxels) ** (1 / 3))
    return edge


def timed(work, rounds):
    """Least seconds of so many calls, by the clock and of the processors."""
    wall, spent = [], []
    for _ in range(rounds):
        start, used = time.perf_counter(), time.process_time()
        made = work()
        wall.append(time.perf_counter() - start)
        spent.append(time.process_time() - used)
    return made, min(wall), min(spent)


def row(name, arm, rounds):
    ws = bathyal.Workspace(arm, hull=box(), radii=0.05)
    edge = edge_for(ws, VOXELS)
    reach, wall, spent = timed(lambda: ws.reach_map(voxel=edge, check_clearance=False), rounds)
    found = differences(reach, arm, CHECKED, seed=7)
    inside = found.inside
    print(
        f"{name}: {reach.reached.size / 1e6:.3f}e6 voxels of {1e3 * edge:.1f} mm, "
        f"{reach.reached.mean():.1%} reached; {CHECKED} drawn\n"
        f"  agree, any orientation  {1 - found.reached.mean():.2%} "
        f"(missed {found.missed.sum()}, too many {(found.reached & ~found.missed).sum()}; "
        f"of voxels in the reach {1 - found.reached[inside].mean():.2%})"
    )
    exact = len(arm.lower) >= 5  # fewer coordinates have no choice of direction
    if exact:
        print(
            f"  agree, along a direction  {1 - found.along.mean():.2%} "
            f"(of voxels in the reach {1 - found.along[inside].mean():.2%})"
        )
    if 1 - found.reached.mean() < GOAL or (exact and 1 - found.along.mean() < GOAL):
        raise SystemExit(f"{name}: less than {GOAL:.0%} agree")
    full, full_wall, full_spent = timed(lambda: ws.reach_map(voxel=edge), 1)
    print(
        f"  map  {wall:.1f} s, {spent:.1f} s of processors\n"
        f"  with clearance  {full_wall:.1f} s, {full_spent:.1f} s of processors; "
        f"{full.free.sum() / full.reached.sum():.1%} of the reached free",
        flush=True,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    print(f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}")
    for name in ("panda", "ur10e", "maevskiy_zanin"):
        row(name, getattr(bathyal.arms, name)(), arguments.rounds)


if __name__ == "__main__":
    main()
