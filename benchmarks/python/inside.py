# SPDX-License-Identifier: BSD-3-Clause
"""Points inside hulls against Open3D: ``python -m benchmarks.python.inside``.

Half of the points lie within 1 cm of the surface, the others anywhere in its box. Both start from
numpy arrays in their own precision (float64; Open3D float32), both builds are in the time: ours of
the hierarchy and the voxels, Open3D's of Embree's. Answers are compared before any time is printed:
Open3D casts one ray a point in float32, so where the two differ the solid angles of all triangles,
summed one by one, must give ours; on hulls with holes too.
"""

import argparse
import platform
import statistics
import time

import numpy as np
import open3d

import bathyal
from tests.support.inside import explained_by_winding, occupancy, query_points, subdivided
from tests.support.scene_meshes import HULLS

POINTS = 1_000_000
MOST_CHECKED = 200  # differences that are checked one by one


def contains(mesh, points, threads):
    return bathyal.Hull(mesh, num_threads=threads).contains(points, num_threads=threads)


def compare(name, mesh, points):
    """Number of points that differ; ends the run when one is not as the definition has it."""
    inside = contains(mesh, points, 0)
    differ = np.flatnonzero(inside != occupancy(mesh, points))
    checked = differ[:: max(1, len(differ) // MOST_CHECKED)]
    right = explained_by_winding(mesh, points[checked], inside[checked])
    if not right.all():
        raise SystemExit(f"{name}: {np.sum(~right)} of {len(checked)} differences are ours")
    return len(differ)


def interleaved(rounds, works, threads):
    """Seconds of each work in every round; on one thread, of the processor."""
    clock = time.process_time if threads == 1 else time.perf_counter
    times = []
    for _ in range(rounds):
        row = []
        for work in works:
            start = clock()
            work()
            row.append(clock() - start)
        times.append(row)
    return np.array(times)


def row(name, mesh, rounds):
    points = query_points(mesh, POINTS)
    single = points.astype(np.float32)
    differ = compare(name, mesh, points)
    closed = "yes" if bathyal.Hull(mesh).report.closed else "no"
    cells = [name, f"{len(mesh.triangles):,}", closed]
    for threads in (1, 2):
        times = interleaved(
            rounds,
            [lambda n=threads: contains(mesh, points, n),
             lambda n=threads: occupancy(mesh, single, n)],
            threads,
        )  # fmt: skip
        ratio = statistics.median(times[:, 1] / times[:, 0])
        cells += [f"**{ratio:.1f} ×**", *(f"{1e3 * t:.0f}" for t in np.median(times, axis=0))]
    print("| " + " | ".join([*cells, str(differ)]) + " |", flush=True)


def run(rounds, least):
    print("## Points inside hulls against Open3D\n")
    print(
        "| hull | triangles | closed | Open3D / ours, 1 thread | ours [ms] | Open3D [ms] "
        "| Open3D / ours, 2 threads | ours [ms] | Open3D [ms] | answers that differ |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|")
    for path in sorted(HULLS.glob("*.dae")):
        row(path.stem, bathyal.read_mesh(path), rounds)
    for name in ("caldus", "torpedo_mk48_collision", "uxo_b"):
        mesh = subdivided(bathyal.read_mesh(HULLS / f"{name}.dae"), least)
        row(f"{name}, subdivided", mesh, rounds)
    print(
        f"\n`python -m benchmarks.python.inside`: {POINTS:,} points, half of them within 1 cm of "
        f"the surface, medians of {rounds} interleaved rounds, builds included. One thread: "
        "processor time; two: the wall clock. Of the answers that differ, up to "
        f"{MOST_CHECKED} a hull are checked: the solid angles of all triangles give ours each "
        f"time. Open3D {open3d.__version__}, numpy {np.__version__}, Python "
        f"{platform.python_version()}."
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--triangles", type=int, default=100_000, help="of the subdivided hulls")
    arguments = parser.parse_args()
    run(arguments.rounds, arguments.triangles)
