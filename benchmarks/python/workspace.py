# SPDX-License-Identifier: BSD-3-Clause
"""An arm on a hull over the bottom against Coal: ``python -m benchmarks.python.workspace``.

A Panda under a hull of 20,000 triangles over a bottom of two million, on one thread. Clearance: the
smallest distance of a posture's capsules to both; Coal (PyPI ``coal``) takes the same capsules one
at a time on BVHModelOBBRSS of the same meshes. Distances are compared before any time is printed;
where something overlaps, only that. Continuous checks: motions of two seconds that pass the bottom
or the hull at 10 mm, between two rows that are about a radian apart in each joint.
"""

import argparse
import platform
import statistics

import coal
import numpy as np

import bathyal
from bathyal._core import simd_level
from benchmarks.python.segments import coal_model, height, seabed, seconds

RADIUS = 0.06
MOUNT = np.array([[1.0, 0, 0, 0.6], [0, -1, 0, 0], [0, 0, -1, -0.25], [0, 0, 0, 1]])
PASSES_AT = 0.010  # [m]


def ellipsoid(rings=100, around=100):
    """Hull of 20,000 triangles, 2 m long."""
    u, v = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.arange(around) * 2 * np.pi / around)
    points = np.stack([np.cos(u), np.sin(u) * np.cos(v), np.sin(u) * np.sin(v)], -1)
    corner = np.arange((rings + 1) * around).reshape(around, rings + 1)
    after = np.roll(corner, -1, axis=0)
    quads = np.stack([corner[:, :-1], after[:, :-1], after[:, 1:], corner[:, 1:]], -1).reshape(
        -1, 4
    )
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return bathyal.TriangleMesh(points.reshape(-1, 3) * [1.0, 0.35, 0.3], triangles)


def workspace(mesh, scene, altitude):
    """Hull and arm over the middle of the bottom."""
    pose = np.eye(4)
    pose[:3, 3] = 250.0, 250.0, height(np.array([[250.0, 250.0]]))[0] + altitude
    return bathyal.Workspace(
        bathyal.arms.panda(), MOUNT, hull=bathyal.Hull(mesh), scene=scene, vehicle_pose=pose,
        radii=RADIUS,
    )  # fmt: skip


def coal_pairs(ws, model, still, other):
    """From capsules to [(capsule, its pose, model, its pose)], without excluded pairs."""
    skip = {(link, to) for link, to, _ in ws.excluded}

    def of(capsules):
        pairs = []
        for link, capsule in zip(ws.capsule_links, capsules, strict=True):
            if link == "link_0":
                continue
            start, end = capsule[:3], capsule[3:6]
            length = float(np.linalg.norm(end - start))
            z = (end - start) / length if length > 0 else np.array([0.0, 0, 1])
            x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
            x /= np.linalg.norm(x)
            turn = coal.Transform3s(np.column_stack([x, np.cross(z, x), z]), 0.5 * (start + end))
            shape = coal.Capsule(float(capsule[6]), length)
            pairs += [
                (shape, turn, at, pose)
                for name, at, pose in (("hull", model, still), ("scene", *other))
                if (link, name) not in skip
            ]
        return pairs

    return of


def coal_clearances(postures, request):
    return np.array(
        [
            min(
                coal.distance(shape, turn, model, pose, request, coal.DistanceResult())
                for shape, turn, model, pose in pairs
            )
            for pairs in postures
        ]
    )


def compare(name, ours, theirs):
    apart = ours > 0
    if (theirs[~apart] > 1e-5).any() or (theirs[apart] <= 0).any():
        raise SystemExit(f"{name}: one of them sees an overlap, the other none")
    worst = np.abs(ours[apart] - theirs[apart]).max()
    if worst > 1e-5:
        raise SystemExit(f"{name}: a distance is {worst} m off Coal's")
    return worst


def clearance_rows(mesh, scene, hull_model, bottom_model, rounds, poses):
    print("| clearance of a Panda | Coal / ours | ours [µs/posture] | Coal | overlapping "
          "| largest difference [mm] |\n|---|---|---|---|---|---|")  # fmt: skip
    request = coal.DistanceRequest(True)
    for name, altitude in (("1 m above the bottom", 1.0), ("3 m above it", 3.0)):
        ws = workspace(mesh, scene, altitude)
        q = np.random.default_rng(1).uniform(ws.arm.lower, ws.arm.upper, (poses, 7))
        world = np.linalg.inv(ws.vehicle_pose.at(0.0))
        moved = coal.Transform3s(world[:3, :3], world[:3, 3])
        still = coal.Transform3s.Identity()
        of = coal_pairs(ws, hull_model, still, (bottom_model, moved))
        postures = [of(capsules) for capsules in ws.place_capsules(q)]
        ours = ws.clearance(q, num_threads=1).distance
        worst = compare(name, ours, coal_clearances(postures, request))
        times = np.array(
            [
                [
                    seconds(lambda ws=ws, q=q: ws.clearance(q, num_threads=1)),
                    seconds(lambda p=postures: coal_clearances(p, request)),
                ]
                for _ in range(rounds)
            ]
        )
        ratio = statistics.median(times[:, 1] / times[:, 0])
        each = 1e6 * np.median(times, axis=0) / poses
        print(f"| {name} | {ratio:.1f} × | {each[0]:.0f} | {each[1]:.0f} "
              f"| {100 * np.mean(ours <= 0):.0f} % | {1e3 * worst:.0e} |")  # fmt: skip


def passing_motion(mesh, scene, seed):
    """A workspace and two rows between which the arm passes at 10 mm."""
    rng = np.random.default_rng(seed)
    ws = workspace(mesh, scene, 3.0)
    while True:
        rows = rng.uniform(0.8 * ws.arm.lower, 0.8 * ws.arm.upper, (1, 7))
        rows = np.vstack([rows, rows + rng.uniform(-1, 1, 7)])
        dense = rows[0] + np.linspace(0, 1, 2001)[:, None] * (rows[1] - rows[0])
        near = ws.clearance(dense)
        if min(near.distance.min(), near.self_distance.min()) > 0.05:
            break
    low, high = 0.3, 3.0  # altitudes: contact, free
    for _ in range(40):
        middle = 0.5 * (low + high)
        least = workspace(mesh, scene, middle).clearance(dense).distance.min()
        low, high = (middle, high) if least < PASSES_AT else (low, middle)
    return workspace(mesh, scene, high), rows


def motion_row(mesh, scene, motions):
    times = []
    for seed in range(motions):
        ws, rows = passing_motion(mesh, scene, seed)
        if not ws.check_motion(rows).free:
            raise SystemExit(f"motion {seed}: refused, though it passes at 10 mm")
        times.append(
            statistics.median(seconds(lambda w=ws, q=rows: w.check_motion(q)) for _ in range(5))
        )
    print("\n| continuous check, 2 s, passing at 10 mm | median [ms] | slowest |\n|---|---|---|")
    middle, slowest = 1e3 * statistics.median(times), 1e3 * max(times)
    print(f"| {motions} motions | {middle:.2f} | {slowest:.2f} |")


def run(rounds, poses, motions):
    mesh = ellipsoid()
    vertices, triangles = seabed()
    scene = bathyal.Scene(bathyal.TriangleMesh(vertices, triangles))
    print("## Clearance and continuous checks against Coal\n")
    clearance_rows(
        mesh, scene, coal_model(mesh.vertices, mesh.triangles), coal_model(vertices, triangles),
        rounds, poses,
    )  # fmt: skip
    motion_row(mesh, scene, motions)
    print(
        f"\nMedians of {rounds} rounds of {poses:,} postures, one thread, processor time; ratios "
        f"above 1 where ours is faster. SIMD level {simd_level()}; Coal {coal.__version__}, numpy "
        f"{np.__version__}, Python {platform.python_version()}."
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--poses", type=int, default=300)
    parser.add_argument("--motions", type=int, default=20)
    arguments = parser.parse_args()
    run(arguments.rounds, arguments.poses, arguments.motions)
