# SPDX-License-Identifier: BSD-3-Clause
"""Sections of a seabed against VTK: ``python -m benchmarks.python.section``.

Peers, from PyPI (``pip install vtk``), in the same run, on the same triangles: ``vtkCutter`` (every
cell) and ``vtkPlaneCutter`` (keeps a sphere tree, which like our hierarchy is built before the
clock starts). Both cut by the whole plane, they have no other way; of theirs, what lies
between the two points is compared. Lengths are compared before any time is printed.
"""

import argparse
import platform
import statistics
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import bathyal


def seabed(side, seed=7):
    """A square of 2 (side − 1)² triangles at 0.5 m: swell, sand waves, roughness."""
    axis = 0.5 * np.arange(side)
    x, y = np.meshgrid(axis, axis)
    z = np.sin(0.02 * x) * 3.0 + 0.4 * np.sin(0.7 * x + 0.2 * y) - 50.0
    z += np.random.default_rng(seed).normal(0.0, 0.02, z.shape)
    vertices = np.column_stack([x.ravel(), y.ravel(), z.ravel()])
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    right, above, across = corner + 1, corner + side, corner + side + 1
    triangles = np.empty((2 * corner.size, 3), np.int32)
    triangles[0::2] = np.column_stack([corner, right, across])
    triangles[1::2] = np.column_stack([corner, across, above])
    return vertices, triangles


def poly_data(vertices, triangles):
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(vertices, deep=True))
    cells = vtk.vtkCellArray()
    offsets = np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int64)
    cells.SetData(
        numpy_to_vtk(offsets, deep=True, array_type=vtk.VTK_ID_TYPE),
        numpy_to_vtk(triangles.ravel().astype(np.int64), deep=True, array_type=vtk.VTK_ID_TYPE),
    )
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def vtk_plane(a, b):
    plane = vtk.vtkPlane()
    plane.SetOrigin(*a)
    plane.SetNormal(*np.cross(b - a, (0.0, 0.0, 1.0)))
    return plane


def vtk_cutter(data, plane):
    cutter = vtk.vtkCutter()
    cutter.SetCutFunction(plane)
    cutter.SetInputData(data)
    cutter.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    return cutter


def vtk_plane_cutter(data, plane):
    cutter = vtk.vtkPlaneCutter()
    cutter.SetPlane(plane)
    cutter.SetInputData(data)
    cutter.ComputeNormalsOff()
    cutter.InterpolateAttributesOff()
    cutter.BuildTreeOn()
    cutter.GeneratePolygonsOff()
    return cutter


def lines_of(cutter):
    """(N, 2, 3) segments of the peer's last cut."""
    output = cutter.GetOutputDataObject(0)
    if output.IsA("vtkPartitionedDataSet"):
        parts = [output.GetPartition(i) for i in range(output.GetNumberOfPartitions())]
    elif output.IsA("vtkMultiBlockDataSet"):
        parts = [output.GetBlock(i) for i in range(output.GetNumberOfBlocks())]
    else:
        parts = [output]
    found = []
    for part in parts:
        if part is None or part.GetNumberOfCells() == 0:
            continue
        cells = vtk_to_numpy(part.GetLines().GetConnectivityArray()).reshape(-1, 2)
        found.append(vtk_to_numpy(part.GetPoints().GetData())[cells].astype(float))
    return np.concatenate(found)


def length_between(segments, a, b):
    """Of the segments, what lies between a and b along the horizontal."""
    along = (b - a) * (1.0, 1.0, 0.0)
    s = (segments - a) @ along / (along @ along)
    low, high = s.min(axis=1), s.max(axis=1)
    kept = np.clip(high, 0.0, 1.0) - np.clip(low, 0.0, 1.0)
    part = np.divide(kept, high - low, out=np.zeros_like(kept), where=high > low)
    return float(np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1) @ part)


def our_length(lines):
    return sum(float(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum()) for line in lines)


def seconds(work, *arguments):
    start = time.perf_counter()
    work(*arguments)
    return time.perf_counter() - start


def again(cutter):
    cutter.Modified()
    cutter.Update()


def shifted(a, b, step):
    """The cut moved to its side by `step` [m]."""
    side = np.cross(b - a, (0.0, 0.0, 1.0))
    return a + step * side / np.linalg.norm(side), b + step * side / np.linalg.norm(side)


def compare(scene, data, a, b, rounds):
    """One row: checks the lengths, then times the peers and, after each, five of our sections.

    Each of the five lies elsewhere, as those of a path do, so none finds its triangles in a cache
    that the one before has warmed.
    """
    plane = vtk_plane(a, b)
    peers = [vtk_cutter(data, plane), vtk_plane_cutter(data, plane)]
    lines = scene.section(a, b)
    for peer in peers:
        peer.Update()
        expected = length_between(lines_of(peer), a, b)
        if not np.isclose(our_length(lines), expected, rtol=1e-9, atol=0.0):
            name = peer.GetClassName()
            raise SystemExit(f"ours is {our_length(lines)} m long, that of {name} {expected} m")
    cuts = [shifted(a, b, 3.7 * k) for k in range(1, 6)]
    ours, theirs = ([], []), ([], [])
    for _ in range(rounds):
        for k, peer in enumerate(peers):
            theirs[k].append(seconds(again, peer))
            ours[k].append(seconds(lambda: [scene.section(*cut) for cut in cuts]) / len(cuts))
    ratios = [
        statistics.median(t / o for t, o in zip(theirs[k], ours[k], strict=True)) for k in (0, 1)
    ]
    times = [statistics.median(t) for t in (ours[0] + ours[1], *theirs)]
    return ratios, times, sum(len(line.triangle) for line in lines)


def run(rounds, backend):
    vtk.vtkSMPTools.SetBackend(backend)
    print("## Sections against VTK\n")
    print("| section | triangles | vtkCutter / ours | vtkPlaneCutter / ours | ours [ms] |")
    print("|---|---|---|---|---|")
    builds, peers = [], []
    for side in (317, 1001):
        vertices, triangles = seabed(side)
        mesh = bathyal.TriangleMesh(vertices, triangles)
        build = statistics.median(seconds(bathyal.Scene, mesh) for _ in range(3))
        builds.append(f"{len(triangles):,} triangles: {1e3 * build:.0f} ms")
        scene = bathyal.Scene(mesh)
        data = poly_data(vertices, triangles)
        width = 0.5 * (side - 1)
        middle = np.array([0.4 * width, 0.5 * width, 0.0])
        for a, b in (
            (np.array([0.0, 0.31 * width, 0.0]), np.array([width, 0.64 * width, 0.0])),
            (middle, middle + np.array([0.2 * width, 0.1 * width, 0.0])),
            (middle, middle + np.array([8.0, 6.0, 0.0])),
        ):
            ratios, times, count = compare(scene, data, a, b, rounds)
            name = f"{np.linalg.norm(b - a):.0f} m, {count} segments"
            print(
                f"| {name} | {len(triangles):,} | {ratios[0]:.0f} × | {ratios[1]:.0f} × "
                f"| {1e3 * times[0]:.3f} |"
            )
            peers.append(f"{1e3 * times[1]:.1f} and {1e3 * times[2]:.1f}")
    print(f"\nThe peers' times, row by row [ms]: {'; '.join(peers)}.")
    print(f"Our hierarchy, built once: {'; '.join(builds)}.")
    print(
        f"Medians of {rounds} rounds. VTK {vtk.VTK_VERSION} ({backend}), ours on one thread; "
        f"numpy {np.__version__}, Python {platform.python_version()}, {platform.machine()}."
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=21)
    parser.add_argument(
        "--backend",
        default="Sequential",
        choices=["Sequential", "STDThread"],
        help="the peers' threads; its wheels' own choice, Sequential, is the faster on two cores",
    )
    arguments = parser.parse_args()
    run(arguments.rounds, arguments.backend)
