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
    exact = len(arm.lower) >= 5  # fewer coordinates have no choice of direction
    if 1 - found.reached.mean() < GOAL or (exact and 1 - found.along.mean() < GOAL):
        raise SystemExit(f"{name}: less than {GOAL:.0%} agree")
    full, full_wall, full_spent = timed(lambda: ws.reach_map(voxel=edge), 1)
    cells = [
        name, f"{reach.reached.size / 1e6:.3f}", f"{1e3 * edge:.1f}", f"{wall:.1f}",
        f"{spent:.1f}", f"{1 - found.reached.mean():.2%}",
        f"{1 - found.along.mean():.2%}" if exact else "–", f"{full_wall:.1f}",
        f"{full_spent:.1f}", f"{full.free.sum() / full.reached.sum():.1%}",
    ]  # fmt: skip
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    print("## Reach maps against inverse kinematics\n")
    print(
        "| arm | 10⁶ voxels | edge [mm] | map [s] | of processors [s] | agree, any orientation "
        "| agree, each of 26 directions | with clearance [s] | of processors [s] | reached free |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name in ("panda", "ur10e", "maevskiy_zanin"):
        row(name, getattr(bathyal.arms, name)(), arguments.rounds)
    print(
        f"\nAll threads, the least of {arguments.rounds} rounds (with clearance: one); {CHECKED:,} "
        "voxels of the whole box are drawn and asked of `Arm.inverse` with 64 starts. Arms of "
        "fewer than five coordinates have no choice of direction. "
        f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}."
    )


if __name__ == "__main__":
    main()
