# SPDX-License-Identifier: BSD-3-Clause
"""What changes no hit of Scene.cast, and others who find the same."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from bathyal._core import set_simd_level, simd_level
from tests.support.scene_rays import SURVEY, rays, same, seabed


@pytest.fixture(scope="module")
def scene():
    return bathyal.Scene(bathyal.TriangleMesh(*seabed()))


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
