# SPDX-License-Identifier: BSD-3-Clause
"""Scene.winding_number and Scene.contains: truth, hulls, a peer, refusals."""

import numpy as np
import pytest

import bathyal
from tests.support.inside import winding_by_definition
from tests.support.scene_meshes import HULLS, UTM, box, seabed, sphere


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


@pytest.mark.parametrize("accuracy", [0.0, -1.0, np.nan])
def test_accuracy_is_above_nothing(accuracy):
    with pytest.raises(ValueError, match="`accuracy`"):
        bathyal.Scene(box()).winding_number([[0, 0, 0]], accuracy=accuracy)
