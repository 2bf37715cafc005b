# SPDX-License-Identifier: BSD-3-Clause
"""Scene.section: truth, properties, a peer, refusals."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.scene_meshes import UTM, box, moved, quaternions, rotation_from, seabed, sphere


def total_length(lines):
    return sum(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum() for line in lines)


def cut_lengths(mesh, r, anchor):
    """Length of the cut by brute force, for planes that meet no vertex."""
    p = (mesh.vertices - anchor) @ r
    length = 0.0
    for triangle in mesh.triangles:
        ends = []
        for i in range(3):
            v0, v1 = triangle[i], triangle[(i + 1) % 3]
            if p[v0] * p[v1] < 0.0:
                t = r @ (anchor - mesh.vertices[v0]) / (r @ (mesh.vertices[v1] - mesh.vertices[v0]))
                ends.append(mesh.vertices[v0] + t * (mesh.vertices[v1] - mesh.vertices[v0]))
        if ends:
            length += np.linalg.norm(ends[1] - ends[0])
    return length


def test_section_of_a_sphere_is_its_circle():
    (line,) = bathyal.Scene(sphere(2.0, rings=60, sectors=120)).section(
        bathyal.Plane((0.3, -0.2, 0.9), 0.731)
    )
    assert line.closed
    np.testing.assert_array_equal(line.points[0], line.points[-1])
    offset = 0.731 / np.linalg.norm((0.3, -0.2, 0.9))
    assert total_length([line]) == pytest.approx(2 * np.pi * np.sqrt(4 - offset**2), rel=2e-3)


def test_section_points_lie_on_their_triangles_and_in_the_plane():
    mesh = seabed()
    scene = bathyal.Scene([box(centre=(9e3, 0, 0)), mesh])
    a, b = np.array([2.2, 3.3, 0.0]), np.array([57.1, 35.9, 0.0])
    r = np.cross(b - a, (0, 0, 1))
    (line,) = scene.section(a, b)
    assert set(line.mesh) == {1}
    assert len(line.points) == len(line.triangle) + 1 == len(line.mesh) + 1
    np.testing.assert_allclose((line.points - a) @ r / np.linalg.norm(r), 0.0, atol=1e-13)
    corners = mesh.vertices[mesh.triangles[line.triangle]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    for ends in (line.points[:-1], line.points[1:]):
        np.testing.assert_allclose(
            np.einsum("ij,ij->i", normal, ends - corners[:, 0]), 0.0, atol=1e-12
        )
    along = (line.points - a) @ (b - a)
    assert (np.diff(along) > 0).all()


@settings(max_examples=40, deadline=None)
@given(st.tuples(*[st.floats(-1, 1) for _ in range(3)]), st.floats(-1.5, 1.5))
def test_section_as_long_as_every_triangles_cut(normal, offset):
    if np.linalg.norm(normal) < 0.1:
        return
    mesh = sphere(rings=10, sectors=14)
    plane = bathyal.Plane(normal, offset)
    height = plane.distance(mesh.vertices)
    if np.abs(height).min() < 1e-9:
        return  # the reference below knows no vertex in the plane
    lines = bathyal.Scene(mesh).section(plane)
    anchor = plane.normal * plane.offset
    assert total_length(lines) == pytest.approx(cut_lengths(mesh, plane.normal, anchor), abs=1e-9)
    assert all(line.closed for line in lines)


def test_edge_cut_is_not_the_printed_one():
    """Errata: the paper prints t = |OA · r| / (edge / |edge| · r), which misses the plane."""
    v0, v1, v2 = np.array([[0.0, -1, 0], [0, 3, 2], [4, 3, 1]])
    a, b = np.array([-1.0, 1, 9]), np.array([5.0, 1, -3])
    scene = bathyal.Scene(bathyal.TriangleMesh([v0, v1, v2], [[0, 1, 2]]))
    (line,) = scene.section(a, b)
    np.testing.assert_allclose(line.points[0], [0, 1, 1], atol=1e-15)
    r = np.cross(b - a, (0, 0, 1))
    r /= np.linalg.norm(r)
    edge = (v1 - v0) / np.linalg.norm(v1 - v0)
    printed = v0 + np.abs(a @ r) / (edge @ r) * (v1 - v0)
    assert abs(r @ (line.points[0] - a)) < 1e-15
    assert abs(r @ (printed - a)) > 0.5


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_edge_cut_is_right_on_both_sides_of_the_origin(side):
    """With |OA · r| in place of r · (A − V0) half of all planes are cut on the wrong side."""
    mesh = seabed(20, 20, offset=(-9.5, -9.5, 0))
    a, b = np.array([-9.0, 3.3 * side, 0]), np.array([9.0, 4.1 * side, 0])
    (line,) = bathyal.Scene(mesh).section(a, b)
    r = np.cross(b - a, (0, 0, 1))
    np.testing.assert_allclose((line.points - a) @ r, 0.0, atol=1e-12)
    edges = np.concatenate([mesh.triangles[:, [0, 1]], mesh.triangles[:, [1, 2]]])
    p = (mesh.vertices - a) @ r
    v0, v1 = mesh.vertices[edges[p[edges[:, 0]] * p[edges[:, 1]] < 0]].transpose(1, 0, 2)
    unit = (v1 - v0) / np.linalg.norm(v1 - v0, axis=1)[:, None]
    printed = v0 + (abs(a @ r) / (unit @ r))[:, None] * (v1 - v0)
    assert np.abs((printed - a) @ r / np.linalg.norm(r)).max() > 1.0


def flat_grid(columns=6, rows=5):
    mesh = seabed(columns, rows)
    return bathyal.TriangleMesh(mesh.vertices * (1, 1, 0), mesh.triangles)


def test_vertices_in_the_plane_are_cut_points():
    mesh = bathyal.TriangleMesh(
        [[0, 0, 0], [2, -1, 1], [2, 1, 1], [3, 0, 0]], [[0, 1, 2], [1, 3, 2]]
    )
    (line,) = bathyal.Scene(mesh).section((0, 0, 5), (3, 0, 5))
    assert line.points.tolist() == [[0, 0, 0], [2, 0, 1], [3, 0, 0]]
    assert line.triangle.tolist() == [0, 1]


@pytest.mark.parametrize("y", [0.0, 1.0, 4.0])  # the border, a row of edges, the other border
@pytest.mark.parametrize("back", [False, True])
def test_edges_in_the_plane_appear_once_from_both_sides(y, back):
    ends = [(0.0, y, 3.0), (5.0, y, -3.0)][:: -1 if back else 1]
    (line,) = bathyal.Scene(flat_grid()).section(*ends)
    x = np.arange(6.0)[:: -1 if back else 1]
    np.testing.assert_array_equal(line.points, np.column_stack([x, np.full(6, y), np.zeros(6)]))


def test_triangles_in_the_plane_give_their_outline():
    scene = bathyal.Scene(flat_grid())
    (line,) = scene.section(bathyal.Plane((0, 0, 1), 0.0))
    assert line.closed
    assert total_length([line]) == 18.0
    (face,) = bathyal.Scene(box()).section(bathyal.Plane((1, 0, 0), 1.0))
    assert total_length([face]) == 20.0


def test_section_clipped_exactly_at_points_of_the_surface():
    mesh = seabed()
    scene = bathyal.Scene(mesh)
    rng = np.random.default_rng(14)
    corners = mesh.vertices[mesh.triangles]
    for weights in ((0.5, 0.3, 0.2), (0.0, 0.4, 0.6), (0.0, 0.0, 1.0)):  # inside, edge, corner
        for i, j in rng.integers(0, len(corners), (40, 2)):
            a, b = weights @ corners[i], weights @ corners[j]
            if np.linalg.norm((b - a)[:2]) < 0.1:
                continue
            (line,) = scene.section(a, b)
            np.testing.assert_array_equal(line.points[0], a)
            np.testing.assert_array_equal(line.points[-1], b)
            assert np.linalg.norm(np.diff(line.points, axis=0), axis=1).min() > 1e-9


def test_section_runs_between_targets_that_rays_found():
    scene = bathyal.Scene(seabed(offset=UTM))
    rng = np.random.default_rng(15)
    origins = UTM + rng.uniform((20, 15, 20), (40, 25, 30), (60, 3))
    hits = scene.cast(origins, rng.uniform((-0.5, -0.5, -1), (0.5, 0.5, -1), (60, 3)))
    assert np.isfinite(hits.range).all()
    for a, b in zip(hits.point[::2], hits.point[1::2], strict=True):
        (line,) = scene.section(a, b)
        np.testing.assert_array_equal(line.points[[0, -1]], [a, b])


def test_lines_of_several_meshes_are_never_joined():
    grid = flat_grid()
    shifted = moved(grid, np.eye(3), (5.0, 0.0, 0.0))
    lines = bathyal.Scene([grid, shifted]).section((0, 1.5, 0), (10, 1.5, 0))
    assert [set(line.mesh) for line in lines] == [{0}, {1}]
    np.testing.assert_array_equal(lines[0].points[-1], lines[1].points[0])


def test_section_does_not_depend_on_the_order_of_triangles():
    mesh = sphere()
    order = np.random.default_rng(16).permutation(len(mesh.triangles))
    shuffled = bathyal.TriangleMesh(mesh.vertices, mesh.triangles[order])
    for plane in (bathyal.Plane((1, 2, 3), 0.4), bathyal.Plane((0, 0, 1), 0.0)):
        here = bathyal.Scene(mesh).section(plane)
        there = bathyal.Scene(shuffled).section(plane)
        assert len(here) == len(there) == 1
        np.testing.assert_array_equal(here[0].points, there[0].points)


@settings(max_examples=25, deadline=None)
@given(quaternions, st.tuples(*[st.floats(-1e4, 1e4) for _ in range(3)]))
def test_section_moves_with_the_scene(quaternion, offset):
    rotation = rotation_from(quaternion)
    a, b, up = np.array([0.0, 4.0, 0.0]), np.array([19.0, 4.0, 0.0]), np.array([0.0, 0.0, 1.0])
    mesh = seabed(20, 10)  # cut along a row of its vertices, which no rotation keeps exactly
    (here,) = bathyal.Scene(mesh).section(a, b, up)
    (there,) = bathyal.Scene(moved(mesh, rotation, offset)).section(
        rotation @ a + offset, rotation @ b + offset, rotation @ up
    )
    assert len(here.points) == len(there.points)
    np.testing.assert_allclose(here.points @ rotation.T + offset, there.points, atol=1e-9)


def test_section_same_as_vtk():
    vtk = pytest.importorskip("vtk")
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    mesh = seabed()
    data, points, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetData(numpy_to_vtk(mesh.vertices, deep=True))
    for triangle in mesh.triangles.tolist():
        cells.InsertNextCell(3, triangle)
    data.SetPoints(points)
    data.SetPolys(cells)
    plane, cutter = vtk.vtkPlane(), vtk.vtkCutter()
    plane.SetOrigin(20.3, 17.7, 0.1)
    plane.SetNormal(0.3, -0.9, 0.2)
    cutter.SetCutFunction(plane)
    cutter.SetInputData(data)
    cutter.Update()
    cut = cutter.GetOutput()
    ends = vtk_to_numpy(cut.GetLines().GetConnectivityArray()).reshape(-1, 2)
    theirs = vtk_to_numpy(cut.GetPoints().GetData())[ends]
    normal = np.array([0.3, -0.9, 0.2])
    lines = bathyal.Scene(mesh).section(bathyal.Plane(normal, normal @ (20.3, 17.7, 0.1)))
    assert sum(len(line.triangle) for line in lines) == len(theirs)
    expected = np.linalg.norm(theirs[:, 1] - theirs[:, 0], axis=1).sum()
    assert total_length(lines) == pytest.approx(expected, rel=1e-6)


def test_section_refusals():
    scene = bathyal.Scene(flat_grid())
    for b in ((1, 1, 5), (1, 1, 0), (1, np.nan, 0), (1, 2), "there", None):
        with pytest.raises(ValueError, match="`b`"):
            scene.section((1, 1, 0), b)
    with pytest.raises(ValueError, match="`a`"):
        scene.section((1, 1), (2, 2, 0))
    for up in ((0, 0, 0), (np.inf, 0, 0), (1, 0)):
        with pytest.raises(ValueError, match="`up`"):
            scene.section((1, 1, 0), (2, 2, 0), up=up)
    with pytest.raises(ValueError, match="`b`"):
        scene.section((1, 1, 0), (3, 1, 0), up=(2, 0, 0))


def test_section_of_nothing_is_no_line():
    assert bathyal.Scene(flat_grid()).section((0, 0, 9), (5, 5, 9)) != []
    assert bathyal.Scene(flat_grid()).section((20, 0, 0), (30, 1, 0)) == []
    empty = bathyal.TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    assert bathyal.Scene(empty).section(bathyal.Plane((0, 0, 1), 0.0)) == []
