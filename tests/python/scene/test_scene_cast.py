# SPDX-License-Identifier: BSD-3-Clause
"""Scene.cast and Scene.occluded through numpy: what they give, take and refuse."""

import numpy as np
import pytest

import bathyal
from tests.support.scene_rays import SURVEY, rays, same, seabed


@pytest.fixture(scope="module")
def scene():
    return bathyal.Scene(bathyal.TriangleMesh(*seabed()))


# What a cast gives


def test_result_has_the_agreed_shapes_and_kinds(scene):
    origins, directions = rays(100)
    hits = scene.cast(origins, directions)
    assert len(hits) == 100
    assert hits.range.shape == (100,)
    assert hits.range.dtype == np.float64
    assert hits.mesh.dtype == hits.triangle.dtype == np.int32
    for name in ("point", "normal", "barycentric"):
        assert getattr(hits, name).shape == (100, 3)
        assert getattr(hits, name).dtype == np.float64
    for name in ("range", "mesh", "triangle", "point", "normal", "barycentric"):
        assert not getattr(hits, name).flags.writeable
    missed = np.isinf(hits.range)
    assert missed.any()
    assert not missed.all()
    assert (hits.triangle[missed] == -1).all()
    assert (hits.mesh[missed] == -1).all()
    assert np.isnan(hits.point[missed]).all()
    assert np.isnan(hits.normal[missed]).all()
    assert np.isnan(hits.barycentric[missed]).all()
    assert repr(hits) == f"Hits({100 - missed.sum()} of 100 rays)"


def test_a_flat_bottom_is_met_where_arithmetic_says():
    floor = bathyal.TriangleMesh([[0, 0, -5], [16, 0, -5], [0, 16, -5]], [[0, 1, 2]])
    hits = bathyal.Scene(floor).cast([1.0, 2.0, 3.0], [[0, 0, -7], [0.75, 0, -1], [0, 0, 1]])
    assert hits.range.tolist() == [8.0, 10.0, np.inf]
    assert hits.point[:2].tolist() == [[1, 2, -5], [7, 2, -5]]
    assert hits.normal[:2].tolist() == [[0, 0, 1], [0, 0, 1]]
    assert hits.barycentric[0].tolist() == [0.0625, 0.125, 0.8125]


def test_a_sphere_is_met_within_its_facets():
    trimesh = pytest.importorskip("trimesh")
    ball = trimesh.creation.icosphere(subdivisions=5, radius=2.0)
    scene = bathyal.Scene(bathyal.TriangleMesh(ball.vertices + SURVEY, ball.faces))
    direction = np.random.default_rng(2).normal(size=(2000, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    hits = scene.cast(SURVEY, direction)
    assert (hits.triangle >= 0).all()
    assert (np.abs(hits.range - 2.0) < 2e-3).all()
    assert (np.einsum("ij,ij->i", hits.normal, direction) > 0.999).all()


def test_point_normal_and_weights_belong_to_the_triangle(scene):
    origins, directions = rays()
    hits = scene.cast(origins, directions)
    met = hits.triangle >= 0
    vertices, triangles = scene.meshes[0].vertices, scene.meshes[0].triangles
    a, b, c = np.moveaxis(vertices[triangles[hits.triangle[met]]], 1, 0)
    u, v, w = hits.barycentric[met].T[:, :, None]
    assert np.allclose(w * a + u * b + v * c, hits.point[met], atol=1e-12)
    unit = directions / np.linalg.norm(directions, axis=1)[:, None]
    assert np.allclose((origins + hits.range[:, None] * unit)[met], hits.point[met], atol=1e-10)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    assert np.allclose(normal, hits.normal[met], atol=1e-12)


def test_answers_do_not_change_with_the_callers_arrays(scene):
    origins, directions = rays(200)
    expected = scene.cast(origins, directions).point
    hits = scene.cast(origins, directions)
    origins[:] = 0.0
    directions[:] = 1.0
    assert np.array_equal(hits.point, expected, equal_nan=True)


# What else goes in


def test_one_origin_or_direction_serves(scene):
    _, directions = rays(50)
    single = scene.cast(np.array([20.0, 20.0, 9.0]), directions)
    assert same(single, scene.cast([[20.0, 20.0, 9.0]], directions))
    assert same(single, scene.cast(np.tile([20.0, 20.0, 9.0], (50, 1)), directions))
    assert scene.cast((20, 20, 9), (0, 0, -1)).range.shape == (1,)


def test_strided_readonly_float32_and_whole_numbers_work(scene):
    origins, directions = rays(64)
    expected = scene.cast(origins, directions)
    wide = np.repeat(origins, 2, axis=0)
    frozen = directions.copy()
    frozen.setflags(write=False)
    assert same(expected, scene.cast(wide[::2], frozen))
    assert same(expected, scene.cast(np.asfortranarray(origins), directions[::-1][::-1]))
    narrow = scene.cast(origins.astype(np.float32), directions.astype(np.float32))
    assert same(
        narrow,
        scene.cast(
            origins.astype(np.float32).astype(float), directions.astype(np.float32).astype(float)
        ),
    )
    assert scene.cast(np.array([[5, 5, 40]]), np.array([[0, 0, -1]])).triangle[0] >= 0


def test_nothing_to_cast_and_nothing_to_meet(scene):
    none = np.empty((0, 3))
    assert len(scene.cast(none, none)) == 0
    assert scene.cast(none, none).point.shape == (0, 3)
    assert scene.cast(none, none).range.shape == (0,)
    empty = bathyal.Scene(bathyal.TriangleMesh(none, np.empty((0, 3), int)))
    assert empty.memory == 0
    assert np.isinf(empty.cast(*rays(10)).range).all()


def test_several_meshes_are_named(scene):
    far = bathyal.TriangleMesh([[0, 0, -9], [40, 0, -9], [0, 40, -9]], [[0, 1, 2]])
    both = bathyal.Scene([far, scene.meshes[0]])
    assert repr(both) == f"Scene(2 meshes, {1 + len(scene.meshes[0].triangles)} triangles)"
    assert [len(m.triangles) for m in both.meshes] == [1, len(scene.meshes[0].triangles)]
    hits = both.cast([[5.2, 5.3, 20.0], [5.2, 5.3, -20.0]], [[0, 0, -1], [0, 0, 1]])
    assert hits.mesh.tolist() == [1, 0]
    assert 0 < both.memory < 70 * (1 + len(scene.meshes[0].triangles))


def test_equal_ranges_go_to_the_lowest():
    vertices, triangles = seabed(8)
    vertices[:, 2] = 0.0
    mesh = bathyal.TriangleMesh(vertices, triangles)
    hits = bathyal.Scene([mesh, mesh]).cast(
        vertices + np.array([0.5, -0.25, 2.0]), np.tile([-0.5, 0.25, -2.0], (64, 1))
    )
    lowest = [np.flatnonzero((triangles == v).any(axis=1))[0] for v in range(64)]
    assert (hits.mesh == 0).all()
    assert hits.triangle.tolist() == lowest


def test_a_triangle_without_area_gives_a_normal_and_no_nan():
    vertices = [[0, 0, 0], [3, 1, 0.3], [1.5, 0.5, 0.15], [0, 4, 0], [2, -3, 0]]
    cap = bathyal.TriangleMesh(vertices, [[0, 1, 3], [0, 2, 1], [2, 0, 4], [1, 2, 4]])
    at = np.linspace(0.01, 0.99, 500)[:, None] * vertices[1]
    lift = np.array([0.3, 0.1, 5.0])
    hits = bathyal.Scene(cap).cast(at + lift, np.tile(-lift, (500, 1)))
    assert (hits.triangle >= 0).all()
    assert np.isfinite(hits.range).all()
    assert np.allclose(np.linalg.norm(hits.normal, axis=1), 1.0)


# Occluded


def test_occluded_agrees_with_cast(scene):
    origins, directions = rays(2000)
    ends = origins + 6.0 * directions
    reach = np.linalg.norm(ends - origins, axis=1)
    blocked = scene.occluded(origins, ends)
    assert blocked.dtype == np.bool_
    assert not blocked.flags.writeable
    clear = np.abs(scene.cast(origins, directions).range - reach) > 1e-9
    assert np.array_equal(blocked[clear], (scene.cast(origins, directions).range < reach)[clear])
    assert 0 < blocked.sum() < 2000


def test_occluded_counts_its_ends():
    floor = bathyal.Scene(bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]]))
    assert floor.occluded((1, 1, 3), [[1, 1, 0], [1, 1, 1e-9], [3, 2, 0], [1, 1, 3]]).tolist() == [
        True,
        False,
        False,
        False,
    ]
    assert floor.occluded((1, 1, 0), (1, 1, 5)).tolist() == [True]


# Refusals


@pytest.mark.parametrize(
    ("origins", "directions", "message"),
    [
        ([[0, 0, 0]], [[0, 0, 0]], r"`directions`.*zero.*row 0"),
        ([[0, 0, 0]] * 3, [[0, 0, 1], [0, np.nan, 1], [0, 0, 1]], r"`directions`.*row 1"),
        ([[0, 0, 0]] * 3, [[0, 0, 1], [0, 0, 1], [0, 0, np.inf]], r"`directions`.*row 2"),
        ([[0, 0, np.nan]], [[0, 0, 1]], r"`origins`.*row 0"),
        ((0, np.inf, 0), [[0, 0, 1]] * 20, r"`origins`.*row 0"),
        (
            [[0, 0, 0]] * 2,
            [[0, 0, 1]] * 3,
            r"`origins`.*one row, or as many as `directions`.*2 rows",
        ),
        ([[0, 0]], [[0, 0, 1]], r"`origins`.*\(N, 3\)"),
        ([[0, 0, 0]], [0, 1], r"`directions`.*\(N, 3\)"),
        ("here", [[0, 0, 1]], r"`origins`"),
        (None, [[0, 0, 1]], r"`origins`"),
        ([[0, 0, 0]], [[1j, 0, 0]], r"`directions`"),
    ],
)
def test_refusals_name_the_argument_and_the_row(scene, origins, directions, message):
    with pytest.raises(ValueError, match=message):
        scene.cast(origins, directions)
    with pytest.raises(ValueError, match=message):
        bathyal.intersect_moller_trumbore(scene.meshes[0], origins, directions)


def test_refusals_of_scene_and_occluded(scene):
    with pytest.raises(ValueError, match="`meshes`: expected one mesh or more"):
        bathyal.Scene([])
    with pytest.raises(ValueError, match="num_threads"):
        bathyal.Scene(scene.meshes, num_threads=-1)
    with pytest.raises(ValueError, match="num_threads"):
        scene.cast([[0, 0, 0]], [[0, 0, 1]], num_threads=-1)
    with pytest.raises(ValueError, match=r"`to`.*row 1"):
        scene.occluded((0, 0, 0), [[0, 0, 1], [0, 0, np.nan]])
    with pytest.raises(ValueError, match=r"`from`"):
        scene.occluded((0, np.inf, 0), [[0, 0, 1]])
    far = bathyal.TriangleMesh([[0, 0, 0], [1, 0, 0], [0, 1, 1e13]], [[0, 1, 2]])
    with pytest.raises(ValueError, match="within 1e12 m"):
        bathyal.Scene(far)
