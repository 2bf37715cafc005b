# SPDX-License-Identifier: BSD-3-Clause
"""Hull: truth, the winding number, a peer, the report, refusals."""

import copy
import pickle
import re

import numpy as np
import pytest
from hypothesis import given, settings

import bathyal
from bathyal.view.voxels import voxels_figure
from tests.support.inside import explained_by_winding, occupancy, query_points
from tests.support.scene_meshes import HULLS, UTM, box, moved, quaternions, rotation_from, sphere
from tests.support.vehicles import box_mesh

NAMES = sorted(path.name for path in HULLS.glob("*.dae"))
CLOSED = 14  # of the 19


def unwelded(mesh):
    corners = mesh.vertices[mesh.triangles].reshape(-1, 3)
    return bathyal.TriangleMesh(corners, np.arange(len(corners)).reshape(-1, 3))


def test_contains_boxes_and_spheres():
    points = np.random.default_rng(1).uniform(-4, 4, (50_000, 3))
    inside = bathyal.Hull(box(half=(1.0, 2.0, 3.0))).contains(points)
    np.testing.assert_array_equal(inside, (np.abs(points) < (1, 2, 3)).all(axis=1))
    assert inside.dtype == bool
    assert not inside.flags.writeable
    radius = np.linalg.norm(points, axis=1)
    clear = np.abs(radius - 3.0) > 0.06  # facets lie a little inside the sphere
    found = bathyal.Hull(sphere(3.0)).contains(points)
    np.testing.assert_array_equal(found[clear], radius[clear] < 3.0)


def test_own_corners_change_nothing():
    """STL files repeat each corner of every triangle."""
    hull = bathyal.Hull(unwelded(sphere()))
    assert hull.report.closed
    assert hull.report.parts == 1
    points = query_points(sphere(), 20_000)
    np.testing.assert_array_equal(hull.contains(points), bathyal.Hull(sphere()).contains(points))


def test_same_for_any_number_of_threads():
    points = query_points(sphere(), 30_000)
    one, four = (bathyal.Hull(sphere()).contains(points, num_threads=n) for n in (1, 4))
    np.testing.assert_array_equal(one, four)


@pytest.mark.skipif(not NAMES, reason="shared/data/hulls is not here")
@pytest.mark.parametrize("name", NAMES)
def test_hulls_agree_with_winding_and_open3d(name):
    """Every point equal to Scene.contains; every difference from Open3D's occupancy, which casts
    one ray in float32, is Open3D's: the solid angles of all triangles, one by one, say so."""
    mesh = bathyal.read_mesh(HULLS / name)
    hull = bathyal.Hull(mesh)
    points = query_points(mesh, 100_000)
    inside = hull.contains(points)
    near = points[1::20]
    np.testing.assert_array_equal(inside[1::20], bathyal.Scene(mesh).contains(near))
    differ = np.flatnonzero(inside != occupancy(mesh, points))
    checked = differ[:: max(1, len(differ) // 200)]
    assert explained_by_winding(mesh, points[checked], inside[checked]).all()
    if hull.report.closed and hull.report.intersecting_pairs == 0:
        assert len(differ) < 100  # within float32's digits of the surface


@pytest.mark.skipif(not NAMES, reason="shared/data/hulls is not here")
def test_reports_of_the_hulls():
    reports = {name: bathyal.Hull(bathyal.read_mesh(HULLS / name)).report for name in NAMES}
    assert sum(report.closed for report in reports.values()) == CLOSED
    for name, report in reports.items():
        assert report.closed == (report.open_edges == 0), name
        assert report.closed == np.isfinite(report.volume), name
        assert all(w.endswith((".", "?")) for w in report.warnings), name
        assert all(w in str(report) for w in report.warnings), name


def test_report_of_a_sound_hull_is_short():
    report = bathyal.Hull(box(half=(1.0, 0.5, 0.25))).report
    assert report.volume == pytest.approx(1.0)
    assert report.warnings == []
    assert str(report) == "12 triangles in 1 part, 2 x 1 x 0.5 m, closed, volume 1 m3"


def test_report_names_what_is_wrong():
    mesh = box()
    flipped = bathyal.TriangleMesh(mesh.vertices, mesh.triangles[:, ::-1])
    assert bathyal.Hull(flipped).report.inside_out
    lidless = bathyal.TriangleMesh(mesh.vertices, mesh.triangles[:-2])
    assert bathyal.Hull(lidless).report.boundary_edges == 4
    far = bathyal.Hull(box(centre=UTM)).report
    assert "vehicle's frame" in far.warnings[0]
    large = bathyal.Hull(box(half=(2000, 300, 300))).report
    assert "millimetres taken for metres" in large.warnings[0]


@given(quaternions)
@settings(max_examples=15, deadline=None)
def test_rigid_motion_changes_nothing(quaternion):
    rotation = rotation_from(quaternion)
    offset = np.array([3.0, -2.0, 7.0])
    mesh = sphere()
    points = query_points(mesh, 4000)
    clear = np.abs(bathyal.Hull(mesh).signed_distance(points)) > 1e-9
    here = bathyal.Hull(mesh).contains(points)
    there = bathyal.Hull(moved(mesh, rotation, offset)).contains(points @ rotation.T + offset)
    np.testing.assert_array_equal(here[clear], there[clear])


def test_signed_distance():
    hull = bathyal.Hull(box(half=(1.0, 2.0, 3.0)))
    found = hull.signed_distance([[0, 0, 0], [0.75, 0, 0], [4, 6, 0]])
    np.testing.assert_allclose(found, [-1.0, -0.25, 5.0], atol=1e-15)


def test_voxels_are_what_contains_says():
    hull = bathyal.Hull(sphere(0.5, centre=(1.0, 2.0, 3.0)))
    voxels = hull.voxels(0.03)
    nx, ny, nz = voxels.inside.shape
    index = np.stack(np.meshgrid(*map(np.arange, (nx, ny, nz)), indexing="ij"), axis=-1)
    middles = voxels.origin + voxels.size * (index + 0.5)
    expected = hull.contains(middles.reshape(-1, 3)).reshape(nx, ny, nz)
    np.testing.assert_array_equal(voxels.inside, expected)
    assert voxels.size**3 * voxels.inside.sum() == pytest.approx(hull.report.volume, rel=0.01)
    assert not voxels.inside.flags.writeable


def test_copies_and_repr():
    hull = bathyal.Hull(sphere())
    again = pickle.loads(pickle.dumps(hull))
    points = query_points(sphere(), 2000)
    np.testing.assert_array_equal(again.contains(points), hull.contains(points))
    np.testing.assert_array_equal(copy.deepcopy(hull).mesh.vertices, hull.mesh.vertices)
    assert repr(hull) == "Hull(2208 triangles, closed)"
    assert repr(bathyal.Hull(box()).voxels(1.0)) == "Voxels(2 x 4 x 6, size=1)"


def test_a_caller_who_writes_to_the_vertices_changes_no_hull():
    vertices = np.array(box().vertices)
    hull = bathyal.Hull(bathyal.TriangleMesh(vertices, box().triangles))
    vertices[:] = 0.0
    assert hull.contains([[0.5, 0.5, 0.5]])[0]


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: bathyal.Hull(bathyal.TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), int))),
         "`mesh`: expected a surface that encloses a volume, got no triangle"),
        (lambda: bathyal.Hull(bathyal.TriangleMesh(np.eye(3), [[0, 1, 2]])),
         "`mesh`: expected a surface that encloses a volume, got one triangle"),
        (lambda: bathyal.Hull(box(half=(1, 1, 0))),
         "`mesh`: expected a surface that encloses a volume, got a flat one of 12 triangles"),
        (lambda: bathyal.Hull(box()).voxels(-1.0), "`size`: expected a finite number above 0"),
        (lambda: bathyal.Hull(box()).voxels(1e-9), "`size`: expected a size of no more than"),
        (lambda: bathyal.Hull(box()).contains([[0, 0, np.nan]]), "`points`: expected"),
        (lambda: bathyal.Hull(box()).contains([0, 0, 1]), "`points`: expected"),
    ],
)  # fmt: skip
def test_refusals(make, text):
    with pytest.raises(ValueError, match="^" + re.escape(text)):
        make()


def test_a_hull_is_made_of_a_mesh():
    with pytest.raises(TypeError, match="`mesh`: expected"):
        bathyal.Hull(np.zeros((3, 3)))


def test_voxels_are_drawn(tmp_path) -> None:
    hull = bathyal.Hull(box_mesh([-0.8, -0.35, -0.25], [0.5, 0.35, 0.25]))
    voxels = hull.voxels(0.05)
    voxels.plot(tmp_path / "voxels.png")
    assert (tmp_path / "voxels.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    titles = [axes.get_title() for axes in voxels_figure(voxels).axes]
    assert [title[0] for title in titles] == ["z", "y", "x"]
    shown = voxels_figure(voxels).axes[0].images[0].get_array()
    assert shown.shape == voxels.inside.shape[:2][::-1]
    assert shown.all()
