# SPDX-License-Identifier: BSD-3-Clause
"""KeepOut: distances by hand, by optimisation and by sampling; motion, copies, refusals."""

import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.optimize import minimize, minimize_scalar

import bathyal
from bathyal import KeepOut
from tests.support.scene_meshes import box, quaternions, rotation_from, sphere
from tests.support.vehicles import box_mesh

RANDOM = np.random.default_rng(2)


def pose_of(quaternion=(1.0, 0.4, -0.3, 0.2), offset=(0.3, -0.2, 0.5)):
    pose = np.eye(4)
    pose[:3, :3] = rotation_from(quaternion)
    pose[:3, 3] = offset
    return pose


def shapes(pose):
    return {
        "sphere": KeepOut.sphere(0.5, pose[:3, 3]),
        "box": KeepOut.box((1.0, 0.6, 0.3), pose),
        "cylinder": KeepOut.cylinder(0.3, 1.2, pose),
        "disc": KeepOut.cylinder(0.8, 0.1, pose),
        "cone": KeepOut.cone(1.0, pose, radius=0.4),
        "wide cone": KeepOut.cone(0.5, pose, angle=2.6),
        "half_space": KeepOut.half_space(pose[:3, 2], point=pose[:3, 3]),
    }


def local(pose, points):
    return (points - pose[:3, 3]) @ pose[:3, :3]


def inside_by_definition(name, shape, points):
    """`points` in the shape's own frame."""
    x, y, z = points.T
    rho = np.hypot(x, y)
    if name == "sphere":
        return np.linalg.norm(points, axis=1) <= shape.radius
    if name == "box":
        return (np.abs(points) <= 0.5 * shape.size).all(axis=1)
    if name in ("cylinder", "disc"):
        return (rho <= shape.radius) & (np.abs(z) <= 0.5 * shape.length)
    if name == "half_space":
        return z <= 0.0
    return (z >= 0) & (z <= shape.length) & (rho * shape.length <= shape.radius * z)


@pytest.mark.parametrize("name", shapes(np.eye(4)))
def test_contains_by_definition(name):
    pose = pose_of()
    shape = shapes(pose)[name]
    points = RANDOM.uniform(-1.5, 2.0, (20_000, 3))
    inside = inside_by_definition(name, shape, local(pose, points))
    np.testing.assert_array_equal(shape.contains(points), inside)
    np.testing.assert_array_equal(shape.distance(points) <= 0, inside)


@pytest.mark.parametrize("name", ["box", "cylinder", "disc"])
def test_distance_outside_is_to_the_nearest_point(name):
    """SLSQP over points of the shape, which is convex."""
    shape = shapes(np.eye(4))[name]
    if name == "box":
        limits = [{"type": "ineq", "fun": lambda p: 0.5 * shape.size - np.abs(p)}]
    else:
        limits = [
            {"type": "ineq", "fun": lambda p: shape.radius**2 - p[0] ** 2 - p[1] ** 2},
            {"type": "ineq", "fun": lambda p: (0.5 * shape.length) ** 2 - p[2] ** 2},
        ]
    checked = 0
    for query in RANDOM.uniform(-2.0, 2.0, (40, 3)):
        if shape.contains([query])[0]:
            continue
        nearest = minimize(lambda p, q: ((p - q) ** 2).sum(), np.zeros(3), args=(query,),
                           constraints=limits, method="SLSQP",
                           options={"ftol": 1e-14, "maxiter": 500})  # fmt: skip
        if nearest.success:
            found = shape.distance([query])[0]
            assert found == pytest.approx(np.sqrt(nearest.fun), abs=2e-5)
            checked += 1
    assert checked > 20


@pytest.mark.parametrize("name", ["cone", "wide cone"])
def test_distance_to_a_cone_is_to_its_nearest_border(name):
    """Points along the outline in the half-plane through the axis and the query."""
    shape = shapes(np.eye(4))[name]
    step = np.linspace(0.0, 1.0, 20_001)[:, None]
    rim, end = np.array([shape.radius, shape.length]), np.array([0.0, shape.length])
    outline = np.concatenate([step * rim, rim + step * (end - rim)])
    points = RANDOM.uniform(-2.0, 2.0, (300, 3))
    for query, found in zip(points, shape.distance(points), strict=True):
        across = np.array([np.hypot(query[0], query[1]), query[2]])
        assert abs(found) == pytest.approx(np.linalg.norm(outline - across, axis=1).min(), abs=1e-4)


@pytest.mark.parametrize("name", shapes(np.eye(4)))
def test_distance_inside_is_to_the_border(name):
    """The ball of that radius is inside, and one a little larger is not."""
    shape = shapes(np.eye(4))[name]
    points = RANDOM.uniform(-0.6, 0.9, (4000, 3))
    points = points[shape.contains(points)][:50]
    around = RANDOM.normal(size=(20_000, 3))
    around /= np.linalg.norm(around, axis=1)[:, None]
    assert len(points) > 5
    for point, depth in zip(points, -shape.distance(points), strict=True):
        assert shape.contains(point + (1 - 1e-9) * depth * around).all()
        assert not shape.contains(point + (1.02 * depth + 1e-3) * around).all()


@pytest.mark.parametrize("name", shapes(np.eye(4)))
def test_capsules_against_bounded_minimisation(name):
    shape = shapes(pose_of())[name]
    a, b = RANDOM.uniform(-1.5, 2.0, (2, 60, 3))
    radius = RANDOM.uniform(0.0, 0.2, 60)
    found = shape.capsule_distance(a, b, radius)
    for i in range(60):

        def along(t, i=i):
            return shape.distance([a[i] + t * (b[i] - a[i])])[0]

        best = minimize_scalar(along, bounds=(0, 1), method="bounded", options={"xatol": 1e-12})
        least = min(best.fun, along(0.0), along(1.0)) - radius[i]
        assert found[i] == pytest.approx(least, abs=1e-7)  # SciPy's digits at a kink
        assert found[i] <= least + 1e-12
    np.testing.assert_array_equal(
        shape.capsule_distance(a, b, 0.0), shape.capsule_distance(a, b, np.zeros(60))
    )
    np.testing.assert_allclose(shape.capsule_distance(a, a, 0.1), shape.distance(a) - 0.1,
                               atol=1e-15)  # fmt: skip


@given(quaternions)
@settings(max_examples=20, deadline=None)
def test_rigid_motion_changes_nothing(quaternion):
    pose = pose_of(quaternion, (2.0, -1.0, 3.0))
    a, b = RANDOM.uniform(-1.0, 1.5, (2, 50, 3))
    moved_a, moved_b = a @ pose[:3, :3].T + pose[:3, 3], b @ pose[:3, :3].T + pose[:3, 3]
    for here, there in zip(shapes(np.eye(4)).values(), shapes(pose).values(), strict=True):
        np.testing.assert_allclose(there.distance(moved_a), here.distance(a), atol=1e-13)
        np.testing.assert_allclose(
            there.capsule_distance(moved_a, moved_b, 0.1),
            here.capsule_distance(a, b, 0.1),
            atol=1e-11,
        )


def test_mesh_is_a_hull():
    crate = KeepOut.mesh(box(half=(1, 2, 3)), frame="world", name="crate")
    assert (crate.kind, crate.frame, crate.name) == ("mesh", "world", "crate")
    np.testing.assert_allclose(crate.distance([[0, 0, 0], [4, 6, 0]]), [-1, 5], atol=1e-15)
    assert crate.contains([[0.9, 0, 0], [1.1, 0, 0]]).tolist() == [True, False]
    hull = bathyal.Hull(sphere())
    np.testing.assert_array_equal(KeepOut.mesh(hull).hull.mesh.vertices, hull.mesh.vertices)


def test_angle_is_the_full_opening():
    assert KeepOut.cone(2.0, angle=np.pi / 2).radius == pytest.approx(2.0)


def test_half_space_by_point_or_offset():
    by_point = KeepOut.half_space((0, 0, 2), point=(5, 5, -1))
    by_offset = KeepOut.half_space((0, 0, 2), -2.0)
    assert by_point.distance([[0, 0, 1]])[0] == by_offset.distance([[0, 0, 1]])[0] == 2.0
    assert by_offset.border.offset == -1.0


def test_values_and_copies():
    pose = pose_of()
    points = RANDOM.uniform(-1.0, 1.0, (100, 3))
    everything = [*shapes(pose).values(), KeepOut.mesh(box(), frame="wrist", name="tool")]
    for shape in everything:
        again = pickle.loads(pickle.dumps(shape))
        assert repr(again) == repr(shape)
        np.testing.assert_array_equal(again.distance(points), shape.distance(points))
    cone = shapes(pose)["cone"]
    assert (cone.kind, cone.radius, cone.length, cone.size) == ("cone", 0.4, 1.0, None)
    np.testing.assert_array_equal(cone.pose, pose)
    assert (cone.border, cone.hull) == (None, None)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: KeepOut.sphere(0.0), "radius"),
        (lambda: KeepOut.sphere(np.nan), "radius"),
        (lambda: KeepOut.sphere(np.inf), "radius"),
        (lambda: KeepOut.sphere(1.0, (0, np.nan, 0)), "center"),
        (lambda: KeepOut.sphere(1.0, (0, 0)), "center"),
        (lambda: KeepOut.sphere(1.0, name=""), "name"),
        (lambda: KeepOut.sphere(1.0, frame=" "), "frame"),
        (lambda: KeepOut.box((1, -1, 1)), "size"),
        (lambda: KeepOut.box((1, 1, 1), 2 * np.eye(4)), "pose"),
        (lambda: KeepOut.cylinder(1.0, -2.0), "length"),
        (lambda: KeepOut.cone(1.0), "radius"),
        (lambda: KeepOut.cone(1.0, radius=1.0, angle=1.0), "radius"),
        (lambda: KeepOut.cone(1.0, angle=3.2), "angle"),
        (lambda: KeepOut.cone(-1.0, angle=1.0), "length"),
        (lambda: KeepOut.half_space((0, 0, 0), 1.0), "normal"),
        (lambda: KeepOut.half_space((0, 0, 1)), "offset"),
        (lambda: KeepOut.half_space((0, 0, 1), np.nan), "offset"),
        (lambda: KeepOut.half_space((0, 0, 1), point=(0, 0, np.inf)), "point"),
        (lambda: KeepOut.mesh(bathyal.TriangleMesh(np.eye(3), [[0, 1, 2]])), "mesh"),
        (lambda: KeepOut.sphere(1.0).distance([[0, 0, np.nan]]), "points"),
        (lambda: KeepOut.sphere(1.0).contains([[0, 0, np.nan]]), "points"),
        (lambda: KeepOut.sphere(1.0).capsule_distance([[0, 0, 0]], [[0, 0, 1]], -0.1), "radius"),
        (lambda: KeepOut.sphere(1.0).capsule_distance([[0, 0, 0]], [[0, 0, np.nan]], 0.1), "b"),
        (lambda: KeepOut.sphere(1.0).capsule_distance([[0, 0, 0]], np.zeros((2, 3)), 0.1), "b"),
    ],
)
def test_refusals(make, name):
    with pytest.raises(ValueError, match=f"^`{name}`: expected .*, got "):
        make()


def test_a_mesh_keepout_is_made_of_a_mesh():
    with pytest.raises(TypeError, match="`mesh`: expected"):
        KeepOut.mesh(3.0)


def test_capsules_against_a_mesh_are_those_against_the_box_it_draws() -> None:
    rng = np.random.default_rng(8)
    mesh = KeepOut.mesh(box_mesh([-1] * 3, [1] * 3))
    exact = KeepOut.box((2, 2, 2))
    a, b = rng.uniform(-4, 4, (2, 200, 3))
    found, true = mesh.capsule_distance(a, b, 0.1), exact.capsule_distance(a, b, 0.1)
    apart = true > -0.1
    np.testing.assert_allclose(found[apart], true[apart], atol=1e-9)
    assert (found[~apart] <= -0.1).all()
    assert (~apart).sum() > 20
