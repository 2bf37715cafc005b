# SPDX-License-Identifier: BSD-3-Clause
"""Scene.nearest: truth, properties, a peer."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.scene_meshes import UTM, box, moved, quaternions, rotation_from, seabed, sphere


def segment_distance(q, a, b):
    edge = b - a
    t = np.clip((q - a) @ edge / max(edge @ edge, 1e-300), 0.0, 1.0)
    return np.linalg.norm(a + t * edge - q)


def distance_to_triangle(q, corners):
    a, b, c = corners
    best = min(segment_distance(q, a, b), segment_distance(q, b, c), segment_distance(q, c, a))
    normal = np.cross(b - a, c - a)
    if normal @ normal > 0.0:
        uv, *_ = np.linalg.lstsq(np.column_stack([b - a, c - a]), q - a, rcond=None)
        if uv.min() >= 0.0 and uv.sum() <= 1.0:
            best = min(best, abs(normal @ (q - a)) / np.linalg.norm(normal))
    return best


def test_nearest_on_a_box():
    points = np.random.default_rng(1).uniform(-5, 5, (500, 3))
    near = bathyal.Scene(box()).nearest(points)
    beyond = np.abs(points) - (1.0, 2.0, 3.0)
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
    expected = np.where(outside > 0.0, outside, -beyond.max(axis=1))
    np.testing.assert_allclose(near.distance, expected, atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(near.point - points, axis=1), expected, atol=1e-14)


def test_nearest_arrays_agree_with_each_other():
    mesh = seabed()
    near = bathyal.Scene([box(centre=(1e3, 0, 0)), mesh]).nearest(
        np.random.default_rng(2).uniform((0, 0, -5), (60, 40, 9), (300, 3))
    )
    assert len(near) == 300
    assert set(near.mesh) == {1}
    u, v, w = near.barycentric.T
    corners = mesh.vertices[mesh.triangles[near.triangle]]
    point = w[:, None] * corners[:, 0] + u[:, None] * corners[:, 1] + v[:, None] * corners[:, 2]
    np.testing.assert_allclose(point, near.point, atol=1e-13)
    assert near.barycentric.min() >= -1e-15
    for array in (near.distance, near.point, near.mesh, near.triangle, near.barycentric):
        assert not array.flags.writeable


def test_nearest_same_as_every_triangle_in_turn():
    mesh = seabed(15, 12)
    corners = mesh.vertices[mesh.triangles]
    points = np.random.default_rng(3).uniform((-9, -9, -9), (24, 21, 12), (60, 3))
    near = bathyal.Scene(mesh).nearest(points)
    for q, distance, triangle in zip(points, near.distance, near.triangle, strict=True):
        every = [distance_to_triangle(q, c) for c in corners]
        assert distance == pytest.approx(min(every), abs=1e-12)
        assert every[triangle] == pytest.approx(min(every), abs=1e-12)


def test_nearest_ties_give_the_lowest_triangle():
    mesh = seabed(12, 12)
    near = bathyal.Scene([mesh, mesh]).nearest(mesh.vertices)
    assert not near.mesh.any()
    assert not near.distance.any()
    np.testing.assert_array_equal(near.point, mesh.vertices)
    lowest = [np.flatnonzero((mesh.triangles == i).any(axis=1))[0] for i in range(144)]
    np.testing.assert_array_equal(near.triangle, lowest)


def test_nearest_takes_triangles_without_area_for_what_they_are():
    mesh = bathyal.TriangleMesh(
        [[0, 0, 0], [4, 0, 0], [1, 0, 0], [9, 9, 9]], [[0, 1, 2], [3, 3, 3]]
    )
    near = bathyal.Scene(mesh).nearest([[2, 3, 4], [9, 9, 14]])
    np.testing.assert_allclose(near.distance, 5.0)
    np.testing.assert_allclose(near.point, [[2, 0, 0], [9, 9, 9]])
    assert near.triangle.tolist() == [0, 1]


def test_nearest_at_survey_coordinates():
    points = np.random.default_rng(4).uniform((-9, -9, -9), (69, 49, 12), (500, 3))
    here = bathyal.Scene(seabed()).nearest(points)
    there = bathyal.Scene(seabed(offset=UTM)).nearest(points + UTM)
    np.testing.assert_allclose(there.distance, here.distance, atol=1e-8)
    far = bathyal.Scene(seabed(offset=UTM)).nearest([[0.0, 0.0, 0.0]])
    assert far.distance[0] == pytest.approx(np.linalg.norm(far.point[0]), rel=1e-15)


@settings(max_examples=25, deadline=None)
@given(quaternions, st.tuples(*[st.floats(-1e4, 1e4) for _ in range(3)]))
def test_nearest_moves_with_the_scene(quaternion, offset):
    rotation = rotation_from(quaternion)
    mesh = seabed(12, 9)
    points = np.random.default_rng(5).uniform((-9, -9, -9), (24, 21, 12), (50, 3))
    here = bathyal.Scene(mesh).nearest(points)
    there = bathyal.Scene(moved(mesh, rotation, offset)).nearest(points @ rotation.T + offset)
    np.testing.assert_allclose(there.distance, here.distance, atol=1e-10)


def test_nearest_of_an_empty_scene():
    empty = bathyal.TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    near = bathyal.Scene(empty).nearest([[0, 0, 0]])
    assert near.distance[0] == np.inf
    assert (near.mesh[0], near.triangle[0]) == (-1, -1)
    assert np.isnan(near.point).all()
    assert np.isnan(near.barycentric).all()


def test_nearest_same_as_open3d():
    o3d = pytest.importorskip("open3d")
    mesh = sphere(2.0)
    points = np.random.default_rng(6).uniform(-3, 3, (2000, 3)).astype(np.float32)
    peer = o3d.t.geometry.RaycastingScene()
    peer.add_triangles(
        o3d.core.Tensor(mesh.vertices.astype(np.float32)),
        o3d.core.Tensor(mesh.triangles.astype(np.uint32)),
    )
    theirs = peer.compute_closest_points(o3d.core.Tensor(points))["points"].numpy()
    ours = bathyal.Scene(mesh).nearest(points.astype(float))
    np.testing.assert_allclose(np.linalg.norm(theirs - points, axis=1), ours.distance, atol=2e-6)
