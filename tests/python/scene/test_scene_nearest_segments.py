# SPDX-License-Identifier: BSD-3-Clause
"""Scene.nearest_segments: truth, properties, a peer."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.scene_meshes import UTM, box, moved, quaternions, rotation_from, seabed, sphere


def random_segments(count, low, high, length, seed):
    random = np.random.default_rng(seed)
    start = random.uniform(low, high, (count, 3))
    return start, start + random.uniform(-length, length, (count, 3))


def rotation_to(direction):
    """A rotation that takes the z axis to the direction."""
    z = direction / np.linalg.norm(direction)
    x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def columns(near):
    return (
        near.distance,
        near.point,
        near.mesh,
        near.triangle,
        near.barycentric,
        near.fraction,
        near.segment_point,
    )


def test_nearest_segments_outside_a_sphere():
    start, end = random_segments(1500, -1.2, 1.2, 0.6, 1)
    near = bathyal.Scene(sphere(rings=96, sectors=192)).nearest_segments(start, end)
    along = end - start
    t = np.clip(-(start * along).sum(1) / (along**2).sum(1), 0, 1)
    from_centre = np.linalg.norm(start + t[:, None] * along, axis=1)
    far_end = np.maximum(np.linalg.norm(start, axis=1), np.linalg.norm(end, axis=1))
    outside, inside = from_centre > 1.001, far_end < 0.999
    assert min(outside.sum(), inside.sum(), (~outside & ~inside).sum()) > 50
    np.testing.assert_allclose(near.distance[outside], from_centre[outside] - 1, atol=1e-3)
    np.testing.assert_allclose(near.distance[inside], 1 - far_end[inside], atol=1e-3)
    assert not near.distance[(from_centre < 0.999) & (far_end > 1.001)].any()


def test_nearest_segments_arrays_agree_with_each_other():
    mesh = seabed()
    start, end = random_segments(300, (0, 0, -5), (60, 40, 9), 4, 2)
    near = bathyal.Scene([box(centre=(1e3, 0, 0)), mesh]).nearest_segments(start, end)
    assert (len(near), repr(near)) == (300, "NearestSegments(300 segments)")
    assert set(near.mesh) == {1}
    u, v, w = near.barycentric.T
    corners = mesh.vertices[mesh.triangles[near.triangle]]
    point = w[:, None] * corners[:, 0] + u[:, None] * corners[:, 1] + v[:, None] * corners[:, 2]
    np.testing.assert_allclose(point, near.point, atol=1e-13)
    on_segment = start + near.fraction[:, None] * (end - start)
    np.testing.assert_allclose(on_segment, near.segment_point, atol=1e-13)
    apart = np.linalg.norm(near.point - near.segment_point, axis=1)
    np.testing.assert_allclose(apart, near.distance, atol=1e-13)
    meets = near.distance == 0.0
    assert 30 < meets.sum() < 270
    np.testing.assert_array_equal(near.point[meets], near.segment_point[meets])
    for array in columns(near):
        assert not array.flags.writeable


def test_nearest_segments_meet_what_is_occluded():
    scene = bathyal.Scene(seabed())
    start, end = random_segments(3000, (0, 0, -5), (60, 40, 9), 4, 3)
    near = scene.nearest_segments(start, end)
    np.testing.assert_array_equal(near.distance == 0.0, scene.occluded(start, end))


def test_nearest_segments_no_further_than_any_point_of_them():
    scene = bathyal.Scene(seabed())
    start, end = random_segments(200, (0, 0, -5), (60, 40, 9), 4, 4)
    near = scene.nearest_segments(start, end)
    fractions = np.linspace(0, 1, 101)[:, None, None]
    sampled = scene.nearest((start + fractions * (end - start)).reshape(-1, 3)).distance
    least = sampled.reshape(101, -1).min(axis=0)
    step = np.linalg.norm(end - start, axis=1) / 100
    assert (near.distance <= least + 1e-13).all()
    assert (near.distance >= least - 0.5 * step).all()


def test_nearest_segments_of_no_length_are_points():
    scene = bathyal.Scene(seabed(offset=UTM))
    points = np.random.default_rng(5).uniform((-9, -9, -9), (69, 49, 12), (300, 3)) + UTM
    near, to_points = scene.nearest_segments(points, points), scene.nearest(points)
    for name in ("distance", "point", "mesh", "triangle", "barycentric"):
        np.testing.assert_array_equal(getattr(near, name), getattr(to_points, name))
    np.testing.assert_array_equal(near.segment_point, points)


def test_nearest_segments_within():
    scene = bathyal.Scene(seabed())
    start, end = random_segments(400, (0, 0, -9), (60, 40, 15), 3, 6)
    every, close = (scene.nearest_segments(start, end, within=w) for w in (np.inf, 1.5))
    found = every.distance <= 1.5
    assert 40 < found.sum() < 360
    for whole, part in zip(columns(every), columns(close), strict=True):
        np.testing.assert_array_equal(whole[found], part[found])
    assert (close.distance[~found] == np.inf).all()
    assert (close.mesh[~found] == -1).all()
    assert (close.triangle[~found] == -1).all()
    for array in (close.point, close.segment_point, close.fraction, close.barycentric):
        assert np.isnan(array[~found]).all()


def test_nearest_segments_same_bytes_for_any_number_of_threads():
    scene = bathyal.Scene(seabed())
    start, end = random_segments(2000, (0, 0, -5), (60, 40, 9), 4, 7)
    one, four = (scene.nearest_segments(start, end, num_threads=n) for n in (1, 4))
    for a, b in zip(columns(one), columns(four), strict=True):
        assert a.tobytes() == b.tobytes()


@settings(max_examples=25, deadline=None)
@given(quaternions, st.tuples(*[st.floats(-1e7, 1e7) for _ in range(3)]))
def test_nearest_segments_move_with_the_scene(quaternion, offset):
    rotation = rotation_from(quaternion)
    mesh = seabed(12, 9)
    start, end = random_segments(50, (-3, -3, -5), (15, 12, 9), 4, 8)
    here = bathyal.Scene(mesh).nearest_segments(start, end)
    there = bathyal.Scene(moved(mesh, rotation, offset)).nearest_segments(
        start @ rotation.T + offset, end @ rotation.T + offset
    )
    np.testing.assert_allclose(there.distance, here.distance, atol=2e-8)


def test_nearest_segments_of_an_empty_scene_and_of_none():
    empty = bathyal.TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    near = bathyal.Scene(empty).nearest_segments([0, 0, 0], [[1, 0, 0]])
    assert near.distance[0] == np.inf
    assert (near.mesh[0], near.triangle[0]) == (-1, -1)
    assert np.isnan(near.point).all()
    none = bathyal.Scene(box()).nearest_segments(np.zeros((0, 3)), np.zeros((0, 3)))
    assert (len(none), none.point.shape) == (0, (0, 3))


def test_nearest_segments_one_start_serves_all():
    scene = bathyal.Scene(seabed())
    end = np.random.default_rng(9).uniform((0, 0, 3), (60, 40, 9), (20, 3))
    fan = scene.nearest_segments((30, 20, 9), end)
    each = scene.nearest_segments(np.tile((30.0, 20.0, 9.0), (20, 1)), end)
    np.testing.assert_array_equal(fan.distance, each.distance)


@pytest.mark.parametrize(
    ("start", "end", "options", "message"),
    [
        ([0, 0, np.nan], [[1, 0, 0]], {}, r"`start`: expected finite coordinates, got row 0"),
        (np.zeros((2, 3)), [[1, 0, 0], [np.inf, 0, 0]], {}, r"`end`: .*row 1"),
        ([[0, 0, 0]], [[1e26, 0, 0]], {}, r"`end`: expected coordinates up to 1e25 m, got row 0"),
        (np.zeros((2, 3)), np.zeros((3, 3)), {}, r"`start`: expected one row, or as many as `end`"),
        ([0, 0], [[1, 0, 0]], {}, r"`start`: expected real numbers of shape \(N, 3\)"),
        ([0, 0, 0], [[1, 0, 0]], {"within": -1}, r"`within`: expected a distance of 0 or more"),
        ([0, 0, 0], [[1, 0, 0]], {"within": np.nan}, r"`within`: expected a distance"),
    ],
)
def test_nearest_segments_refuses(start, end, options, message):
    with pytest.raises(ValueError, match=message):
        bathyal.Scene(box()).nearest_segments(start, end, **options)


@pytest.mark.parametrize("length", [0.2, 2.0, 20.0])
def test_nearest_segments_same_as_coal(length):
    coal = pytest.importorskip("coal")
    mesh = seabed()
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(mesh.triangles), len(mesh.vertices))
    model.addVertices(mesh.vertices)
    model.addTriangles(mesh.triangles.astype(np.int64))
    model.endModel()
    start, end = random_segments(300, (0, 0, -3), (60, 40, 9), length, 10)
    radius = 0.05
    near = bathyal.Scene(mesh).nearest_segments(start, end)
    for p, q, distance in zip(start, end, near.distance, strict=True):
        along = q - p
        pose = coal.Transform3s(rotation_to(along), 0.5 * (p + q))
        capsule = coal.Capsule(radius, float(np.linalg.norm(along)))
        theirs = coal.distance(
            capsule,
            pose,
            model,
            coal.Transform3s.Identity(),
            coal.DistanceRequest(),
            coal.DistanceResult(),
        )
        if distance > radius:
            assert theirs == pytest.approx(distance - radius, abs=1e-6)
        else:
            assert theirs < 1e-6
