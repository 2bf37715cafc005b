# SPDX-License-Identifier: BSD-3-Clause
"""Meshes at poses: the answers of the merged mesh, the bytes of no poses, and what is refused."""

import numpy as np
import pytest

import bathyal
from bathyal.view import scene3d
from bathyal.view.relief import bounds
from tests.support.scene_meshes import box, rotation_from, seabed, sphere
from tests.support.scene_rays import same
from tests.support.scenes import aims, bottom

STONES = 1000


def placed(count=STONES, seed=5):
    """A bottom and stones of two kinds on it, with their poses and scales."""
    random = np.random.default_rng(seed)
    kinds = sphere(rings=6, sectors=9), box(half=(0.5, 0.8, 0.3), centre=(1.0, 0.0, 0.0))
    meshes = [seabed(), *(kinds[i % 2] for i in range(count))]
    poses = np.tile(np.eye(4), (count + 1, 1, 1))
    poses[1:, :3, :3] = [rotation_from(q) for q in random.normal(size=(count, 4))]
    poses[1:, :3, 3] = random.uniform((0, 0, -3), (59, 39, 3), (count, 3))
    return meshes, poses, np.concatenate([[1.0], random.uniform(0.1, 0.8, count)])


def merged(meshes, poses, scales):
    """All of them as one mesh in the world, and the first triangle of each."""
    rows = zip(meshes, poses, scales, strict=True)
    vertices = [s * m.vertices @ p[:3, :3].T + p[:3, 3] for m, p, s in rows]
    first = np.cumsum([0] + [len(v) for v in vertices])
    triangles = [m.triangles + f for m, f in zip(meshes, first[:-1], strict=True)]
    start = np.cumsum([0] + [len(t) for t in triangles])
    return bathyal.TriangleMesh(np.vstack(vertices), np.vstack(triangles)), start


def rays(count=4000, seed=1):
    random = np.random.default_rng(seed)
    origins = random.uniform((0, 0, -4), (59, 39, 8), (count, 3))
    return origins, random.normal(size=(count, 3))


def row_and_triangle(triangle, start):
    row = np.searchsorted(start, triangle, side="right") - 1
    return np.where(triangle < 0, -1, row), np.where(triangle < 0, -1, triangle - start[row])


def test_a_thousand_clones_are_the_merged_mesh():
    meshes, poses, scales = placed()
    scene = bathyal.Scene(meshes, poses=poses, scales=scales)
    mesh, start = merged(meshes, poses, scales)
    hits, truth = scene.cast(*rays()), bathyal.Scene(mesh).cast(*rays())
    met = truth.triangle >= 0
    row, triangle = row_and_triangle(truth.triangle, start)
    assert met.sum() > 1500
    assert np.mean(row[met] > 0) > 0.2
    np.testing.assert_array_equal(hits.triangle >= 0, met)
    np.testing.assert_allclose(hits.range, truth.range, rtol=1e-9, atol=1e-9)
    same_triangle = (hits.mesh == row) & (hits.triangle == triangle)
    assert same_triangle.mean() > 0.999
    np.testing.assert_allclose(hits.point, truth.point, atol=1e-9)
    alike = met & same_triangle
    np.testing.assert_allclose(hits.normal[alike], truth.normal[alike], atol=1e-9)


def test_clones_against_open3d():
    open3d = pytest.importorskip("open3d", reason="open3d is not installed")
    meshes, poses, scales = placed()
    scene = bathyal.Scene(meshes, poses=poses, scales=scales)
    mesh, _ = merged(meshes, poses, scales)
    peer = open3d.t.geometry.RaycastingScene()
    peer.add_triangles(
        open3d.core.Tensor(mesh.vertices.astype(np.float32)),
        open3d.core.Tensor(mesh.triangles.astype(np.uint32)),
    )
    origins, directions = rays()
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    query = open3d.core.Tensor(np.hstack([origins, directions]).astype(np.float32))
    found = peer.cast_rays(query)["t_hit"].numpy()
    ours = scene.cast(origins, directions).range
    close = np.isclose(ours, found, rtol=0, atol=1e-3)  # infinite for both, too
    assert close.mean() > 0.999
    points = open3d.core.Tensor(origins.astype(np.float32))
    distance = peer.compute_distance(points).numpy()
    np.testing.assert_allclose(scene.nearest(origins).distance, distance, atol=1e-4)


def test_at_the_identity_the_bytes_are_those_without_poses():
    meshes = [seabed(), sphere(centre=(20, 20, 1)), box(centre=(30, 20, 1))]
    plain = bathyal.Scene(meshes)
    for scene in (
        bathyal.Scene(meshes, poses=np.tile(np.eye(4), (3, 1, 1))),
        bathyal.Scene(meshes, scales=np.ones(3)),
        plain.with_poses(np.tile(np.eye(4), (3, 1, 1))),
    ):
        assert same(scene.cast(*rays()), plain.cast(*rays()))
        near, truth = scene.nearest(rays()[0]), plain.nearest(rays()[0])
        np.testing.assert_array_equal(near.point, truth.point)
        np.testing.assert_array_equal(near.triangle, truth.triangle)


def test_threads_change_no_byte():
    meshes, poses, scales = placed()
    one = bathyal.Scene(meshes, poses=poses, scales=scales, num_threads=1)
    eight = bathyal.Scene(meshes, poses=poses, scales=scales, num_threads=8)
    assert same(one.cast(*rays(), num_threads=1), eight.cast(*rays(), num_threads=8))


def test_overlapping_clones_give_the_lowest_row():
    mesh = sphere()
    scene = bathyal.Scene([mesh] * 4, poses=np.tile(np.eye(4), (4, 1, 1)))
    hits = scene.cast((3, 0.1, 0.2), (-1, 0, 0))
    assert hits.mesh.tolist() == [0]
    assert scene.nearest([[3, 0.1, 0.2]]).mesh.tolist() == [0]


def test_arrays_that_a_caller_can_write_to_are_held_once():
    """Clones given as one object, or over the same arrays, share a hierarchy and a copy."""
    own = sphere()
    vertices, triangles = np.array(own.vertices), np.array(own.triangles)
    mesh = bathyal.TriangleMesh(vertices, triangles)
    poses = np.tile(np.eye(4), (500, 1, 1))
    scene = bathyal.Scene([mesh] * 500, poses=poses)
    assert scene.memory < bathyal.Scene(mesh).memory + 500 * 1000
    vertices += 100.0  # the scene keeps what it was given
    assert scene.cast((3, 0.1, 0.2), (-1, 0, 0)).mesh.tolist() == [0]


def test_moved_again_shares_and_leaves_the_first_alone():
    meshes, poses, scales = placed(50)
    first = bathyal.Scene(meshes, poses=poses, scales=scales)
    before = first.cast(*rays())
    moved = poses.copy()
    moved[1:, :3, 3] += (1.0, -2.0, 0.5)
    later = first.with_poses(moved)
    anew = bathyal.Scene(meshes, poses=moved, scales=scales)
    assert same(later.cast(*rays()), anew.cast(*rays()))
    assert same(first.cast(*rays()), before)
    np.testing.assert_array_equal(first.poses, poses)
    np.testing.assert_array_equal(later.poses, moved)
    np.testing.assert_array_equal(later.scales, scales)
    assert not later.poses.flags.writeable


def test_without_poses_they_are_the_identity():
    scene = bathyal.Scene([seabed(), box()])
    np.testing.assert_array_equal(scene.poses, np.tile(np.eye(4), (2, 1, 1)))
    np.testing.assert_array_equal(scene.scales, [1, 1])


def test_an_instance_without_triangles_is_never_met():
    empty = bathyal.TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    scene = bathyal.Scene([empty, box()], poses=np.tile(np.eye(4), (2, 1, 1)))
    assert scene.cast((0.1, 0.2, 9), (0, 0, -1)).mesh.tolist() == [1]
    nothing = bathyal.Scene(empty, poses=[np.eye(4)])
    assert np.isinf(nothing.cast((0, 0, 9), (0, 0, -1)).range).all()
    assert np.isinf(nothing.nearest([[0, 0, 9]]).distance).all()


def mirrored():
    pose = np.eye(4)
    pose[0, 0] = -1
    return pose


def with_nan():
    pose = np.eye(4)
    pose[0, 3] = np.nan
    return pose


@pytest.mark.parametrize("bad", [mirrored(), with_nan(), 2 * np.eye(4), np.zeros((4, 4))])
def test_a_pose_that_is_not_rigid_is_refused_by_its_row(bad):
    with pytest.raises(ValueError, match=r"`poses\[1\]`: expected a rigid motion"):
        bathyal.Scene([box(), box()], poses=[np.eye(4), bad])


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf, 1e-300])
def test_a_scale_that_is_none_is_refused_by_its_row(bad):
    with pytest.raises(ValueError, match=r"`scales\[1\]`: expected a number above 0"):
        bathyal.Scene([box(), box()], scales=[1.0, bad])


def test_wrong_numbers_and_shapes_are_refused():
    two = [box(), box()]
    with pytest.raises(ValueError, match=r"`poses`: expected one a mesh \(2\), got 1"):
        bathyal.Scene(two, poses=[np.eye(4)])
    with pytest.raises(ValueError, match="`poses`: expected real numbers of shape"):
        bathyal.Scene(two, poses=np.eye(4))
    with pytest.raises(ValueError, match=r"`scales`: .*one a mesh \(2\), got 3"):
        bathyal.Scene(two, scales=[1, 1, 1])
    with pytest.raises(ValueError, match=r"`scales`: .*one a mesh \(2\), got 0"):
        bathyal.Scene(two, scales=[])
    with pytest.raises(ValueError, match=r"`poses`: expected one a mesh \(2\), got 0"):
        bathyal.Scene(two).with_poses(np.zeros((0, 4, 4)))
    with pytest.raises(ValueError, match="`meshes`: expected one mesh or more"):
        bathyal.Scene([], poses=np.zeros((0, 4, 4)))
    with pytest.raises(ValueError, match="`mesh`: expected a row from 0 to 1"):
        bathyal.Scene(two).mesh_in_world(2)


def turned_bottom():
    """A bottom in the world, and the same as a turned, halved mesh that its pose puts there."""
    world = bottom(hole=False)
    pose = np.eye(4)
    pose[:3, :3] = rotation_from((1.0, 0.4, -0.3, 0.8))
    pose[:3, 3] = (10.0, -20.0, 5.0)
    mesh = world.meshes[0]
    own = 0.5 * (mesh.vertices - pose[:3, 3]) @ pose[:3, :3]
    posed = bathyal.Scene(bathyal.TriangleMesh(own, mesh.triangles), poses=[pose], scales=[2.0])
    return world, posed


def from_line(points, line):
    """Largest distance of the points from a line of points [m]."""
    along = np.diff(line, axis=0)
    back = points[:, None] - line[:-1]
    share = np.sum(back * along, axis=2) / np.maximum(np.sum(along**2, axis=1), 1e-300)
    foot = np.clip(share, 0.0, 1.0)[..., None] * along
    return np.linalg.norm(back - foot, axis=2).min(axis=1).max()


@pytest.mark.parametrize(
    "options", [{}, {"standoff": 0.5}, {"standoff": 0.5, "normal_radius": 1.0}]
)
def test_a_tool_path_over_a_posed_bottom(options):
    """Where the ball rolls, samples depend on which side of a flat edge rounding puts it: their
    number differs between copies of a mesh that differ in a last digit, the line does not."""
    world, posed = turned_bottom()
    axes = aims(miss=False)
    plain, moved = (bathyal.plan_toolpath(s, axes, step=0.2, **options) for s in (world, posed))
    assert from_line(moved.position, plain.position) < 1e-6
    assert from_line(plain.position, moved.position) < 1e-6
    np.testing.assert_allclose(moved.targets.point, plain.targets.point, atol=1e-9)
    np.testing.assert_allclose(moved.approach[0], plain.approach[0], atol=1e-6)


def test_coverage_and_misses_over_a_posed_bottom():
    world, posed = turned_bottom()
    polygon = [[2, 2], [15, 2], [15, 9], [2, 9]]
    np.testing.assert_allclose(
        bathyal.cover_polygon(posed, polygon, 1.0),
        bathyal.cover_polygon(world, polygon, 1.0),
        atol=1e-9,
    )
    axes = aims(miss=True)
    plain, moved = (bathyal.find_targets(s, axes) for s in (world, posed))
    assert list(moved.status) == list(plain.status)


def test_pictures_see_a_posed_bottom_where_it_is():
    world, posed = turned_bottom()
    np.testing.assert_allclose(bounds(posed), bounds(world), atol=1e-9)
    axes = aims(miss=False)
    path = bathyal.plan_toolpath(posed, axes, step=0.2)
    figure = scene3d.show_plan(posed, axes, path)
    plain = scene3d.show_plan(world, axes, path)
    np.testing.assert_allclose(figure.data[0].z, plain.data[0].z, atol=1e-5)
