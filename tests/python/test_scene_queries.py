# SPDX-License-Identifier: BSD-3-Clause
"""Scene.nearest, winding_number, contains and section: truth, properties, peers, refusals."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal

HULLS = Path(__file__).resolve().parents[3] / "shared" / "data" / "hulls"
UTM = np.array([512345.25, 7212345.5, -52.0])


# ---------------------------------------------------------------- meshes with a known shape


def seabed(columns=60, rows=40, offset=(0.0, 0.0, 0.0)):
    x, y = np.meshgrid(np.arange(columns, dtype=float), np.arange(rows, dtype=float))
    z = np.sin(0.3 * x) + 2.0 * np.cos(0.05 * y + 0.11 * x)
    vertices = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) + offset
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    triangles = np.concatenate(
        [
            np.column_stack([corner, corner + 1, corner + columns + 1]),
            np.column_stack([corner, corner + columns + 1, corner + columns]),
        ]
    )
    return bathyal.TriangleMesh(vertices, triangles)


def box(half=(1.0, 2.0, 3.0), centre=(0.0, 0.0, 0.0)):
    signs = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2.0 - 1.0
    triangles = [
        (0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
        (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5),
    ]  # fmt: skip
    return bathyal.TriangleMesh(signs * half + centre, triangles)


def sphere(radius=1.0, centre=(0.0, 0.0, 0.0), rings=24, sectors=48):
    polar = np.linspace(0.0, np.pi, rings + 1)[1:-1]
    around = 2.0 * np.pi * np.arange(sectors) / sectors
    p, a = np.meshgrid(polar, around, indexing="ij")
    body = np.stack([np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)], axis=-1)
    vertices = np.concatenate([body.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    north, south = len(vertices) - 2, len(vertices) - 1
    triangles = []
    for j in range(sectors):
        k = (j + 1) % sectors
        triangles.append((north, j, k))
        for i in range(rings - 2):
            upper, lower = i * sectors, (i + 1) * sectors
            triangles += [(upper + j, lower + j, lower + k), (upper + j, lower + k, upper + k)]
        last = (rings - 2) * sectors
        triangles.append((last + j, south, last + k))
    return bathyal.TriangleMesh(radius * vertices + centre, triangles)


def moved(mesh, rotation, offset):
    return bathyal.TriangleMesh(mesh.vertices @ rotation.T + offset, mesh.triangles)


def rotation_from(quaternion):
    w, x, y, z = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


quaternions = st.tuples(*[st.floats(-1.0, 1.0) for _ in range(4)]).filter(
    lambda q: np.linalg.norm(q) > 0.1
)


def total_length(lines):
    return sum(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum() for line in lines)


# ---------------------------------------------------------------- slow references


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


def winding_by_definition(mesh, points):
    """Van Oosterom and Strackee's solid angle of every triangle."""
    corners = mesh.vertices[mesh.triangles]
    numbers = []
    for q in points:
        a, b, c = (corners[:, i] - q for i in range(3))
        la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c))
        cosines = la * lb * lc
        for u, v, length in ((a, b, lc), (b, c, la), (c, a, lb)):
            cosines = cosines + np.einsum("ij,ij->i", u, v) * length
        numbers.append(np.arctan2(volume, cosines).sum())
    return np.array(numbers) / (2.0 * np.pi)


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


# ---------------------------------------------------------------- nearest


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


# ---------------------------------------------------------------- inside


def test_contains_a_sphere():
    points = np.random.default_rng(7).uniform(-2, 2, (5000, 3))
    radius = np.linalg.norm(points, axis=1)
    clear = np.abs(radius - 1.0) > 0.02  # the facets lie a little inside the sphere
    scene = bathyal.Scene(sphere())
    np.testing.assert_array_equal(scene.contains(points)[clear], radius[clear] < 1.0)
    np.testing.assert_allclose(
        scene.winding_number(points)[clear], (radius < 1.0)[clear], atol=0.02
    )


def test_winding_number_is_the_sum_of_solid_angles():
    mesh = seabed(30, 20)
    points = np.random.default_rng(8).uniform((-9, -9, -9), (40, 30, 12), (80, 3))
    exact = winding_by_definition(mesh, points)
    scene = bathyal.Scene(mesh)
    corners = mesh.vertices[mesh.triangles]
    area = 0.5 * np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    for accuracy in (1.0, 0.1, 1e-3):
        found = scene.winding_number(points, accuracy=accuracy)
        for q, ours, truth in zip(points, found, exact, strict=True):
            seen = (area / ((corners.mean(axis=1) - q) ** 2).sum(axis=1)).sum() / (4 * np.pi)
            assert abs(ours - truth) <= accuracy * seen
    np.testing.assert_allclose(scene.winding_number(points, accuracy=1e-9), exact, atol=1e-12)


def test_contains_turned_inside_out():
    mesh = sphere()
    flipped = bathyal.TriangleMesh(mesh.vertices, mesh.triangles[:, ::-1])
    points = np.random.default_rng(9).uniform(-2, 2, (1000, 3))
    scene = bathyal.Scene(flipped)
    np.testing.assert_array_equal(scene.contains(points), bathyal.Scene(mesh).contains(points))
    assert scene.winding_number([[0, 0, 0]])[0] == pytest.approx(-1.0, abs=0.02)


def test_contains_where_bodies_overlap():
    scene = bathyal.Scene([box(), box(centre=(0.5, 0, 0))])
    inside = [[0.25, 0.1, 0.2], [-0.9, 0.1, 0.2], [1.4, 0.1, 0.2]]
    np.testing.assert_allclose(scene.winding_number(inside), [2, 1, 1], atol=5e-3)
    assert scene.contains(inside).all()
    assert not scene.contains([[1.6, 0, 0]])[0]


def test_contains_degrades_gracefully_as_a_hole_opens():
    mesh = sphere()
    numbers = []
    for kept in (1.0, 0.95, 0.8, 0.6):
        triangles = mesh.triangles[: int(kept * len(mesh.triangles))]
        scene = bathyal.Scene(bathyal.TriangleMesh(mesh.vertices, triangles))
        numbers.append(scene.winding_number([[0, 0, 0]])[0])
        assert not scene.contains([[3.0, 0.1, 0.2]])[0]
    np.testing.assert_allclose(numbers, (1.0, 0.95, 0.8, 0.6), atol=0.02)


def test_points_on_the_surface_are_contained():
    scene = bathyal.Scene(box())
    on_it = [[1, 0.3, 0.2], [1, 2, 0.4], [1, 2, 3], [-0.4, -2, 1.1]]
    assert scene.contains(on_it).all()
    assert scene.winding_number([[1, 0.3, 0.2]])[0] == pytest.approx(0.5)
    assert not scene.contains([[1, 2.1, 0], [1.0000001, 0, 0]]).any()
    assert bathyal.Scene(box(centre=UTM)).contains(np.array(on_it) + UTM).all()


def test_contains_same_as_open3d():
    o3d = pytest.importorskip("open3d")
    mesh = sphere(2.0)
    peer = o3d.t.geometry.RaycastingScene()
    peer.add_triangles(
        o3d.core.Tensor(mesh.vertices.astype(np.float32)),
        o3d.core.Tensor(mesh.triangles.astype(np.uint32)),
    )
    points = np.random.default_rng(10).uniform(-2.5, 2.5, (3000, 3)).astype(np.float32)
    theirs = peer.compute_occupancy(o3d.core.Tensor(points), nsamples=3).numpy() > 0.5
    scene = bathyal.Scene(mesh)
    clear = scene.nearest(points.astype(float)).distance > 1e-4
    np.testing.assert_array_equal(scene.contains(points.astype(float))[clear], theirs[clear])


def read_hull(path):
    if not path.exists():
        pytest.skip(f"{path} is not there: the hulls' data set is missing")
    return bathyal.read_mesh(path)


def volume_by_contains(mesh, count=20_000):
    """Volume and its standard error, by points drawn at random in the bounding box."""
    used = mesh.vertices[np.unique(mesh.triangles)]
    low, high = used.min(axis=0), used.max(axis=0)
    points = np.random.default_rng(11).uniform(low, high, (count, 3))
    inside = bathyal.Scene(mesh).contains(points).mean()
    size = np.prod(high - low)
    return inside * size, size * np.sqrt(inside * (1 - inside) / count)


@pytest.mark.parametrize(
    ("name", "volume"),
    [  # as its SOURCE.txt states them
        ("COLLISION-Slocum-Glider", 0.453234),
        ("Slocum-Glider-Propeller", 8.1604e-5),
        ("caldus_collision", 7.48856),
        ("caracara_collision", 2.19599),
        ("torpedo_mk48_collision", 1.24303),
        ("uxo_a_collision", 0.0560857),
        ("uxo_b_collision", 0.163788),
        ("uxo_c_collision", 0.501132),
        ("smilodon_collision", 18.9497),
        ("COLLISION-Wave_Glider-umbilical", 0.0070979),  # normals point inward
        ("uxo_b", 0.1496),  # cuts itself
    ],
)
def test_hull_holds_its_stated_volume(name, volume):
    found, error = volume_by_contains(read_hull(HULLS / f"{name}.dae"))
    assert abs(found - volume) <= 4.0 * error + 1e-3 * volume


def signed_volume(mesh):
    a, b, c = np.moveaxis(mesh.vertices[mesh.triangles], 1, 0)
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0


@pytest.mark.parametrize("name", ["COLLISION-Wave_Glider", "glider_hybrid_whoi_collision"])
def test_overlapping_parts_are_all_contained(name):
    """The union of the parts: what lies in any of them, each asked for itself."""
    mesh = read_hull(HULLS / f"{name}.dae")
    parts = split(mesh)
    assert len(parts) > 1
    used = mesh.vertices[np.unique(mesh.triangles)]
    points = np.random.default_rng(12).uniform(used.min(axis=0), used.max(axis=0), (20_000, 3))
    each = np.array([bathyal.Scene(part).winding_number(points) for part in parts])
    together = bathyal.Scene(mesh).winding_number(points)
    np.testing.assert_allclose(together, each.sum(axis=0), atol=1e-2)
    inside = (np.abs(each) > 0.5).any(axis=0)
    # Parts that are wound against each other cancel where they overlap, as the docs say.
    cancelled = inside & (np.abs(np.round(each).sum(axis=0)) < 0.5)
    found = bathyal.Scene(mesh).contains(points)
    np.testing.assert_array_equal(found[~cancelled], inside[~cancelled])
    assert cancelled.mean() < 0.01
    if name == "glider_hybrid_whoi_collision":
        assert together.max() > 1.9
        assert found.mean() * np.prod(np.ptp(used, axis=0)) < signed_volume(mesh)


def split(mesh):
    """Connected parts, vertices joined by position."""
    _, merged = np.unique(mesh.vertices, axis=0, return_inverse=True)
    corners = merged[mesh.triangles]
    label = np.arange(merged.max() + 1)
    while True:
        lowest = label[corners].min(axis=1)
        before = label.copy()
        for i in range(3):
            np.minimum.at(label, corners[:, i], lowest)
        if (label == before).all():
            break
    part = label[corners[:, 0]]
    return [bathyal.TriangleMesh(mesh.vertices, mesh.triangles[part == k]) for k in np.unique(part)]


@pytest.mark.parametrize(
    "name",
    ["Slocum-Glider", "caldus", "glider_hybrid_whoi_body", "mbari_mars", "sunkenship_distort",
     "torpedo_mk48"],
)  # fmt: skip
def test_open_hulls_answer_by_the_exact_sum(name):
    mesh = read_hull(HULLS / f"{name}.dae")
    used = mesh.vertices[np.unique(mesh.triangles)]
    low, high = used.min(axis=0), used.max(axis=0)
    points = np.random.default_rng(13).uniform(low, high, (200, 3))
    exact = winding_by_definition(mesh, points)
    scene = bathyal.Scene(mesh)
    np.testing.assert_allclose(scene.winding_number(points), exact, atol=5e-3)
    clear = np.abs(np.abs(exact) - 0.5) > 5e-3
    np.testing.assert_array_equal(scene.contains(points)[clear], np.abs(exact[clear]) > 0.5)
    outside = (low + high) / 2 + 3 * (high - low)
    assert not scene.contains([outside])[0]


# ---------------------------------------------------------------- section


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


# ---------------------------------------------------------------- any number of threads, refusals


def test_one_thread_equals_eight():
    points = np.random.default_rng(17).uniform((-9, -9, -9), (69, 49, 12), (3000, 3))
    one, eight = (bathyal.Scene(seabed(), num_threads=n) for n in (1, 8))
    a, b = one.nearest(points, num_threads=1), eight.nearest(points, num_threads=8)
    for name in ("distance", "point", "mesh", "triangle", "barycentric"):
        assert getattr(a, name).tobytes() == getattr(b, name).tobytes()
    numbers = one.winding_number(points, num_threads=1), eight.winding_number(points, num_threads=8)
    assert numbers[0].tobytes() == numbers[1].tobytes()
    assert (one.contains(points, num_threads=1) == eight.contains(points, num_threads=8)).all()


@pytest.mark.parametrize("query", ["nearest", "winding_number", "contains"])
def test_points_of_every_layout_are_taken_and_others_refused(query):
    scene = bathyal.Scene(box())
    ask = getattr(scene, query)
    points = np.random.default_rng(18).uniform(-3, 3, (20, 3)).astype(np.float32)
    read_only = points.astype(float)
    read_only.flags.writeable = False
    column = {"nearest": lambda n: n.distance}.get(query, lambda n: n)
    expected = column(ask(read_only))
    for same in (points, np.asfortranarray(read_only), np.repeat(read_only, 2, axis=0)[::2]):
        np.testing.assert_array_equal(column(ask(same)), expected)
    assert len(column(ask(np.zeros((0, 3))))) == 0
    for bad in ([[0, 0]], [0, 0, 0], [["a", "b", "c"]], [[0, np.nan, 0]], [[0, np.inf, 0]], None):
        with pytest.raises(ValueError, match="points"):
            ask(bad)


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
    for accuracy in (0.0, -1.0, np.nan):
        with pytest.raises(ValueError, match="`accuracy`"):
            scene.winding_number([[0, 0, 0]], accuracy=accuracy)


def test_section_of_nothing_is_no_line():
    assert bathyal.Scene(flat_grid()).section((0, 0, 9), (5, 5, 9)) != []
    assert bathyal.Scene(flat_grid()).section((20, 0, 0), (30, 1, 0)) == []
    empty = bathyal.TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    assert bathyal.Scene(empty).section(bathyal.Plane((0, 0, 1), 0.0)) == []
