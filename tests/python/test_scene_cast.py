# SPDX-License-Identifier: BSD-3-Clause
"""Scene.cast, Scene.occluded and intersect_moller_trumbore through numpy."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from bathyal._core import set_simd_level, simd_level

SURVEY = np.array([620_000.0, 7_246_000.0, -52.0])  # an offset as survey coordinates have it


def seabed(side=40, offset=(0.0, 0.0, 0.0), seed=0):
    axis = np.arange(side, dtype=float)
    x, y = np.meshgrid(axis, axis)
    z = np.sin(0.4 * x) + np.cos(0.3 * y + 0.2 * x)
    z += np.random.default_rng(seed).normal(0.0, 0.05, z.shape)
    vertices = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) + offset
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    return vertices, np.concatenate(
        [
            np.column_stack([corner, corner + 1, corner + side + 1]),
            np.column_stack([corner, corner + side + 1, corner + side]),
        ]
    )


def rays(count=3000, side=40, offset=(0.0, 0.0, 0.0), seed=1):
    random = np.random.default_rng(seed)
    origins = random.uniform((0, 0, -3), (side - 1, side - 1, 6), (count, 3)) + offset
    return origins, random.normal(size=(count, 3))


@pytest.fixture(scope="module")
def scene():
    return bathyal.Scene(bathyal.TriangleMesh(*seabed()))


def same(a, b):
    return all(
        np.array_equal(getattr(a, name), getattr(b, name), equal_nan=True)
        for name in ("range", "mesh", "triangle", "point", "normal", "barycentric")
    )


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


# The same bytes


@pytest.mark.parametrize("offset", [np.zeros(3), SURVEY, np.full(3, 1e7)], ids=str)
def test_every_instruction_set_and_number_of_threads_gives_the_same_bytes(offset):
    scene = bathyal.Scene(bathyal.TriangleMesh(*seabed(offset=offset)))
    origins, directions = rays(9000, offset=offset)
    first = scene.cast(origins, directions, num_threads=1)
    best = simd_level()
    try:
        for level in ("baseline", "avx2", "avx512"):
            try:
                set_simd_level(level)
            except ValueError:
                continue
            for threads in (1, 8):
                assert same(first, scene.cast(origins, directions, num_threads=threads)), level
    finally:
        set_simd_level(best)


def test_threads_of_the_build_do_not_matter():
    mesh = bathyal.TriangleMesh(*seabed(120))
    origins, directions = rays(2000, side=120)
    one, eight = (bathyal.Scene(mesh, num_threads=n) for n in (1, 8))
    assert one.memory == eight.memory
    assert same(one.cast(origins, directions), eight.cast(origins, directions))


# Properties

angles = st.floats(-3.1, 3.1)
shifts = st.sampled_from([0.0, 1.0, 1234.5, 1e6, 1e7])


def rotation(a, b, c):
    (sa, sb, sc), (ca, cb, cc) = np.sin([a, b, c]), np.cos([a, b, c])
    about_z = np.array([[ca, -sa, 0], [sa, ca, 0], [0, 0, 1]])
    about_y = np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
    about_x = np.array([[1, 0, 0], [0, cc, -sc], [0, sc, cc]])
    return about_z @ about_y @ about_x


@settings(max_examples=25, deadline=None)
@given(angles, angles, angles, shifts)
def test_a_rigid_motion_changes_no_range(a, b, c, shift):
    vertices, triangles = seabed(20)
    origins, directions = rays(400, side=20)
    turn, move = rotation(a, b, c), shift * np.array([0.062, 0.7246, -0.09])
    plain = bathyal.Scene(bathyal.TriangleMesh(vertices, triangles)).cast(origins, directions)
    moved = bathyal.Scene(bathyal.TriangleMesh(vertices @ turn.T + move, triangles)).cast(
        origins @ turn.T + move, directions @ turn.T
    )
    # A ray within rounding of the sheet's rim may be met on one side only.
    both = np.isfinite(plain.range) & np.isfinite(moved.range)
    assert (np.isfinite(plain.range) == np.isfinite(moved.range)).mean() > 0.995
    far = np.abs(plain.range[both] - moved.range[both]) > 1e-6
    assert far.mean() < 0.005  # past a crest by rounding


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_the_order_of_triangles_and_rays_does_not_matter(seed):
    random = np.random.default_rng(seed)
    vertices, triangles = seabed(20)
    origins, directions = rays(400, side=20)
    plain = bathyal.Scene(bathyal.TriangleMesh(vertices, triangles)).cast(origins, directions)
    order, ray = random.permutation(len(triangles)), random.permutation(len(origins))
    shuffled = bathyal.Scene(bathyal.TriangleMesh(vertices, triangles[order])).cast(
        origins[ray], directions[ray]
    )
    assert np.array_equal(plain.range[ray], shuffled.range)
    met = shuffled.triangle >= 0
    assert np.array_equal(plain.triangle[ray][met], order[shuffled.triangle[met]])


@settings(max_examples=30, deadline=None)
@given(angles, angles, angles, shifts)
def test_nothing_slips_out_of_a_closed_mesh(a, b, c, shift):
    corner = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], float)
    faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
             [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]  # fmt: skip
    move = shift * np.array([0.062, 0.7246, -0.09])
    vertices = corner @ rotation(a, b, c).T + move
    first, second = np.array([[t[i], t[(i + 1) % 3]] for t in faces for i in range(3)]).T
    part = np.linspace(0.0, 1.0, 33)[:, None, None]
    aims = (vertices[first] + part * (vertices[second] - vertices[first])).reshape(-1, 3)
    scene = bathyal.Scene(bathyal.TriangleMesh(vertices, faces))
    assert (scene.cast(move, aims - move).triangle >= 0).all()
    assert (scene.cast(move + 50.0 * (aims - move), move - aims).triangle >= 0).all()


# Others' answers


@pytest.mark.parametrize("offset", [np.zeros(3), np.array([100.0, -200.0, 30.0])], ids=str)
def test_open3d_meets_the_same(offset):
    open3d = pytest.importorskip("open3d", reason="open3d-cpu is not installed")
    vertices, triangles = seabed(60, offset=offset)
    origins, directions = rays(20_000, side=60, offset=offset)
    unit = directions / np.linalg.norm(directions, axis=1)[:, None]
    peer = open3d.t.geometry.RaycastingScene()
    peer.add_triangles(vertices.astype(np.float32), triangles.astype(np.uint32))
    found = peer.cast_rays(np.concatenate([origins, unit], axis=1).astype(np.float32))
    theirs = found["t_hit"].numpy()
    ours = bathyal.Scene(bathyal.TriangleMesh(vertices, triangles)).cast(origins, directions)
    agree = np.isfinite(theirs) == np.isfinite(ours.range)
    both = np.isfinite(theirs) & np.isfinite(ours.range)
    assert agree.mean() > 0.9995  # they decide in float32
    assert both.sum() > 8000
    close = np.abs(theirs[both] - ours.range[both]) < 1e-3
    assert close.mean() > 0.9995
    same_triangle = found["primitive_ids"].numpy()[both].astype(np.int64) == ours.triangle[both]
    assert same_triangle.mean() > 0.999


def test_the_papers_own_way_meets_the_same(scene):
    origins, directions = rays(400)
    hits = scene.cast(origins, directions)
    paper = bathyal.intersect_moller_trumbore(scene.meshes[0], origins, directions)
    assert np.array_equal(hits.triangle, paper.triangle)
    assert np.allclose(hits.range, paper.range, rtol=1e-12)
    met = hits.triangle >= 0
    assert np.allclose(hits.barycentric[met], paper.barycentric[met], atol=1e-9)
    assert np.array_equal(hits.normal, paper.normal, equal_nan=True)


def test_the_papers_own_way_takes_the_nearest_in_front():
    """Eq 7–9 as printed know neither t ≥ 0 nor which of several triangles is met first."""
    sheets = bathyal.TriangleMesh(
        [[0, 0, z] for z in (9, -1, -4)]
        + [[4, 0, z] for z in (9, -1, -4)]
        + [[0, 4, z] for z in (9, -1, -4)],
        [[0, 3, 6], [2, 5, 8], [1, 4, 7]],
    )
    for hits in (
        bathyal.intersect_moller_trumbore(sheets, (1, 1, 3), [[0, 0, -2]]),
        bathyal.Scene(sheets).cast((1, 1, 3), [[0, 0, -2]]),
    ):
        assert hits.range.tolist() == [4.0]
        assert hits.triangle.tolist() == [2]


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
