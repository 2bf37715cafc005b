# SPDX-License-Identifier: BSD-3-Clause
"""Points inside hulls against Open3D: ``python -m benchmarks.python.inside``.

Half of the points lie within 1 cm of the surface, the others anywhere in its box. Both start from
numpy arrays in their own precision (float64; Open3D float32), both builds are in the time: ours of
the hierarchy and the voxels, Open3D's of Embree's. Answers are compared before any time is printed:
Open3D casts one ray a point in float32, so where the two differ the solid angles of all triangles,
summed one by one, must give ours; on hulls with holes too.

CGAL's Side_of_triangle_mesh is a peer for those who install its bindings by hand (``pip install
cgal``, GPL: nothing of bathyal uses it). It takes one point a call from Python; what such a call
costs without any work is measured and taken off. Some hulls are no polyhedra to it.
"""

import argparse
import os
import platform
import statistics
import tempfile
import time

import numpy as np
import open3d

try:
    from CGAL.CGAL_Kernel import Point_3
    from CGAL.CGAL_Polygon_mesh_processing import Side_of_triangle_mesh
    from CGAL.CGAL_Polyhedron_3 import Polyhedron_3
except ImportError:
    Polyhedron_3 = None

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


def polyhedron(mesh):
    """CGAL's, None of what is no closed polyhedron to it."""
    corners, inverse = np.unique(mesh.vertices, axis=0, return_inverse=True)
    faces = inverse.reshape(-1)[mesh.triangles]
    whole = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "hull.off")
        with open(path, "w") as file:
            file.write(f"OFF\n{len(corners)} {whole.sum()} 0\n")
            np.savetxt(file, corners, "%.17g")
            np.savetxt(file, np.column_stack([np.full(whole.sum(), 3), faces[whole]]), "%d")
        made = Polyhedron_3(path)
    return made if made.size_of_facets() == whole.sum() and made.is_closed() else None


def cgal_ratio(mesh, points):
    """CGAL's processor time over ours, one thread, builds included; None where it has none."""
    made = polyhedron(mesh) if Polyhedron_3 else None
    if made is None:
        return None
    some = [Point_3(*p) for p in points[:: max(1, len(points) // 20_000)].tolist()]
    start = time.process_time()
    side = Side_of_triangle_mesh(made)
    side.bounded_side(some[0])  # the tree is built at the first query
    built = time.process_time()
    for point in some:
        side.bounded_side(point)
    asked = time.process_time()
    for point in some:
        point.x()  # a call that does nothing
    called = time.process_time()
    each = ((asked - built) - (called - asked)) / len(some)
    theirs = (built - start) + each * len(points)
    start = time.process_time()
    contains(mesh, points, 1)
    return theirs / (time.process_time() - start)


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
    ratio = cgal_ratio(mesh, points)
    cells += [str(differ), "–" if ratio is None else f"**{ratio:.1f} ×**"]
    print("| " + " | ".join(cells) + " |", flush=True)


def run(rounds, least):
    print("## Points inside hulls against Open3D\n")
    print(
        "| hull | triangles | closed | Open3D / ours, 1 thread | ours [ms] | Open3D [ms] "
        "| Open3D / ours, 2 threads | ours [ms] | Open3D [ms] | answers that differ "
        "| CGAL / ours, 1 thread |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|")
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
