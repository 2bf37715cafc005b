# SPDX-License-Identifier: BSD-3-Clause
"""What a caller writes into an array that it gave changes no answer, and reaches no memory."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import bathyal

GRID = np.array([[x, y, 0.01 * x * y] for x in range(6) for y in range(5)], dtype=float)


def test_triangles_written_to_afterwards_are_those_that_were_given():
    triangles = np.array([[0, 1, 2]], np.int32)
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    mesh = bathyal.TriangleMesh(vertices, triangles)
    scene = bathyal.Scene(mesh)
    triangles += 10**6
    assert mesh.triangles.tolist() == [[0, 1, 2]]
    assert scene.cast((0.2, 0.2, 1), (0, 0, -1)).triangle.tolist() == [0]
    assert bathyal.mesh_report(mesh).area == 0.5


def test_triangles_of_a_view_and_of_a_read_only_view_are_copied():
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    buffer = np.array([[0, 1, 2], [0, 0, 0]], np.int32)
    shown = buffer[:1]
    shown.flags.writeable = False
    meshes = [bathyal.TriangleMesh(vertices, buffer[:1]), bathyal.TriangleMesh(vertices, shown)]
    buffer[:] = 10**6
    for mesh in meshes:
        assert mesh.triangles.tolist() == [[0, 1, 2]]


def test_a_scene_keeps_the_vertices_it_was_built_on():
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    mesh = bathyal.TriangleMesh(vertices, [[0, 1, 2]])
    assert np.shares_memory(mesh.vertices, vertices)
    scene = bathyal.Scene(mesh)
    vertices[:] = np.nan
    assert scene.cast((0.2, 0.2, 1), (0, 0, -1)).range.tolist() == [1.0]
    assert scene.nearest([[0.2, 0.2, 2.0]]).distance.tolist() == [2.0]
    with pytest.raises(ValueError, match="`vertices`: expected finite coordinates"):
        bathyal.Scene(mesh)


def test_arrays_of_the_engine_are_shared_and_not_copied():
    cloud = bathyal.clean_cloud(GRID).cloud
    again = bathyal.TriangleMesh(cloud.points, bathyal.triangulate(cloud).triangles)
    assert np.shares_memory(again.vertices, cloud.points)
    assert np.shares_memory(bathyal.Scene(again).meshes[0].vertices, cloud.points)
    assert np.shares_memory(bathyal.triangulate(cloud).vertices, cloud.points)


WRITER = """
import sys, threading, numpy as np, bathyal
random = np.random.default_rng(0)
points = random.uniform(0, 100, (20000, 3))
flat = points * [1, 1, 0.01]
points[:] = flat
cloud = bathyal.PointCloud(points, attributes={"u": points[:, 2]})
mesh = bathyal.TriangleMesh(points, bathyal.triangulate(flat).triangles)
scene = bathyal.Scene(bathyal.triangulate(flat))
calls = {
    "triangulate": lambda: bathyal.triangulate(cloud),
    "clean_cloud": lambda: bathyal.clean_cloud(
        cloud, spike_sigma=3, outlier_sigma=3, voxel=1.0, same_place="deepest"),
    "find_sheets": lambda: bathyal.find_sheets(cloud),
    "fit_plane": lambda: bathyal.fit_plane(cloud),
    "write": lambda: cloud.write("cloud.xyz"),
    "Scene": lambda: bathyal.Scene(mesh),
    "mesh_report": lambda: bathyal.mesh_report(mesh),
    "nearest": lambda: scene.nearest(points),
    "contains": lambda: scene.contains(points[:4000]),
    "cast": lambda: scene.cast(points, points),
    "occluded": lambda: scene.occluded(points, points[::-1].copy()),
}
done = threading.Event()
def write():
    other = flat[::-1].copy()
    while not done.is_set():
        points[:] = other
        points[:] = flat
writer = threading.Thread(target=write)
writer.start()
try:
    for _ in range(4):
        try:
            calls[sys.argv[1]]()
        except ValueError as error:
            assert "expected" in str(error), error
finally:
    done.set()
    writer.join()
"""


@pytest.mark.parametrize(
    "call",
    ["triangulate", "clean_cloud", "find_sheets", "fit_plane", "write", "Scene", "mesh_report",
     "nearest", "contains", "cast", "occluded"],
)  # fmt: skip
def test_writing_to_points_while_the_engine_works_on_them_ends_in_an_answer(call, tmp_path):
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", WRITER, call],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,  # what is tested for may never end
    )
    assert done.returncode == 0, done.stderr[-2000:]
