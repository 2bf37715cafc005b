# SPDX-License-Identifier: BSD-3-Clause
"""An arm on a vehicle: targets, clearances, motions; the paper's figures 7, 7′ and 7″."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support import vehicles
from tests.support.vehicles import HULL, MOUNT, Q_START, pose, sampler


def planar(**around) -> bathyal.Workspace:
    arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    return bathyal.Workspace(arm, radii=around.pop("radii", 0.05), **around)


def test_targets_of_the_papers_figures() -> None:
    """Maevskiy, Zanin (2020), figures 7, 7′ and 7″: ahead, to port, inside the hull."""
    ws = sampler()
    found = ws.check_target([[1.6, 0.0, -0.8], [0.7, 0.9, -0.7], [0.1, 0.05, 0.0]])
    assert found.status.tolist() == ["free", "free", "hull"]
    assert found.distance[2] == pytest.approx(-0.25)  # to the top or bottom
    assert found.keepout.tolist() == [-1, -1, -1]
    tips = ws.arm.forward(found.q[:2])[:, :3, 3]
    np.testing.assert_allclose(tips, [[1.6, 0.0, -0.8], [0.7, 0.9, -0.7]], atol=1e-5)
    assert (ws.clearance(found.q[:2]).distance > 0).all()
    assert ws.clearance(Q_START).distance > 0


def test_indicators_in_their_order() -> None:
    beam = bathyal.KeepOut.cone(1.5, pose(0.6, 0, -0.2), angle=0.6, name="beam")
    ws = sampler(keepouts=[beam], scene=vehicles.flat_bottom(-1.1))
    targets = {
        "hull": [0.0, 0.0, 0.0],
        "keepout": [0.6, 0.1, 0.8],
        "ground": [1.2, 0.0, -1.15],
        "unreachable": [3.5, 0.0, -0.5],
        "free": [1.4, 0.2, -1.1],  # on the bottom, where samples are taken
    }
    found = ws.check_target(np.array(list(targets.values())))
    assert found.status.tolist() == list(targets)
    assert found.keepout.tolist() == [-1, 0, -1, -1, -1]
    assert found.distance[2] == pytest.approx(-0.05)
    assert found.distance[4] == pytest.approx(0.0, abs=1e-9)
    assert np.isnan(found.q[3]).all()


def test_only_in_collision_and_only_at_a_limit() -> None:
    plate = bathyal.KeepOut.box((0.02, 4, 4), pose(0.7), name="plate")
    behind = planar(keepouts=[plate]).check_target([[0.85, 0.0, 0.0]])
    assert behind.status.tolist() == ["collision"]
    arm = bathyal.Arm.from_dh(
        a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0], lower=[-3, 0], upper=[3, 3]
    )
    straight = bathyal.Workspace(arm, radii=0.0).check_target([[0.9 - 1e-6, 0.0, 0.0]])
    assert straight.status.tolist() == ["limit"]


def test_clearance_says_which_link_against_what_and_where() -> None:
    ball = bathyal.KeepOut.sphere(0.2, (0.9, 0.6, 0), name="ball")
    near = planar(keepouts=[ball]).clearance([[0, 0], [np.pi / 2, 0]])
    np.testing.assert_allclose(near.distance, [0.35, 0.65], atol=1e-9)
    assert near.link.tolist() == ["link_2", "link_2"]
    assert near.against.tolist() == ["ball", "ball"]
    np.testing.assert_allclose(near.point[0], [0.9, 0.4, 0], atol=1e-9)
    np.testing.assert_allclose(near.link_point[0], [0.9, 0, 0], atol=1e-9)
    nothing = planar().clearance([0, 0])
    assert nothing.distance == np.inf
    assert nothing.against == ""
    assert np.isnan(nothing.point).all()


@settings(max_examples=15, deadline=None)
@given(st.tuples(*[st.floats(-3, 3)] * 3), st.floats(-3.1, 3.1), st.integers(0, 1000))
def test_moving_everything_changes_nothing(shift, yaw, seed) -> None:
    world = pose(*shift, yaw)
    rng = np.random.default_rng(seed)
    scene = vehicles.flat_bottom(-1.0)
    mesh = scene.meshes[0]
    moved = bathyal.TriangleMesh(mesh.vertices @ world[:3, :3].T + world[:3, 3], mesh.triangles)
    ball = bathyal.KeepOut.sphere(0.1, (1.2, 0.2, -0.5), frame="world")
    there = bathyal.KeepOut.sphere(
        0.1, world[:3, :3] @ [1.2, 0.2, -0.5] + world[:3, 3], frame="world"
    )
    here = sampler(scene=scene, keepouts=[ball])
    other = sampler(scene=bathyal.Scene(moved), keepouts=[there], vehicle_pose=world)
    arm = here.arm
    q = rng.uniform(arm.lower, arm.upper, (5, 3))
    np.testing.assert_allclose(here.clearance(q).distance, other.clearance(q).distance, atol=1e-9)
    one, two = here.check_motion(q), other.check_motion(q)
    assert one.free == two.free
    targets = rng.uniform([0.6, -0.5, -1.2], [1.6, 0.5, 0.2], (3, 3))
    assert (
        here.check_target(targets).status.tolist()
        == other.check_target(targets @ world[:3, :3].T + world[:3, 3]).status.tolist()
    )


def test_pitch_that_is_not_known_takes_clearance_away() -> None:
    """14° of pitch move a tip at 0.9 m by 0.22 m."""
    scene = vehicles.flat_bottom(-0.5)
    q = [0.0, 0.0]
    sure = planar(scene=scene).clearance(q)
    third = np.radians(14.0) / 3.0
    unsure = planar(scene=scene, vehicle_pose_std=[0, 0, 0, 0, third, 0])
    assert sure.distance == pytest.approx(0.45)
    assert unsure.clearance(q).distance == pytest.approx(
        0.45 - 0.22 - 0.05 * np.radians(14), abs=2e-3
    )
    shifted = planar(scene=scene, vehicle_pose_std=[0, 0, 0.02, 0, 0, 0])
    assert shifted.clearance(q).distance == pytest.approx(0.45 - 0.06)
    on_hull = bathyal.KeepOut.sphere(0.1, (0.9, 0.5, 0))
    assert planar(keepouts=[on_hull], vehicle_pose_std=[0.1] * 6).clearance(q).distance == (
        pytest.approx(planar(keepouts=[on_hull]).clearance(q).distance)
    )


def test_a_vehicle_that_sinks_onto_the_bottom() -> None:
    scene = vehicles.flat_bottom(-0.5)

    def sinking(t: float) -> np.ndarray:
        return pose(z=-0.1 * t)

    for motion in (sinking, bathyal.Trajectory([0, 10], [sinking(0), sinking(10)])):
        ws = planar(scene=scene, vehicle_pose=motion)
        assert ws.moves
        near = ws.clearance([[0, 0], [0, 0]], time=[0, 2])
        np.testing.assert_allclose(near.distance, [0.45, 0.25], atol=1e-9)
        held = ws.check_motion([[0, 0], [0, 0]], time=[0, 9])
        assert not held
        assert held.time == pytest.approx(4.5, abs=0.01)
        assert held.contact == pytest.approx(0.5, abs=2e-3)
        assert ws.check_motion([[0, 0], [0.1, 0]], time=[0, 4.4])
    with pytest.raises(ValueError, match="`time`: expected the time of each row"):
        ws.check_motion([[0, 0], [0.1, 0]])


def test_an_obstacle_that_passes_between_two_rows() -> None:
    """At both rows it is far away."""
    ball = bathyal.KeepOut.sphere(0.05, (0.7, 0, 0), name="fish")
    swims = bathyal.Trajectory([0, 10], [pose(y=-3), pose(y=3)])
    ws = planar(keepouts=[ball.moved(swims)])
    assert (ws.clearance([[0, 0], [0, 0]], time=[0, 10]).distance > 2).all()
    met = ws.check_motion([[0, 0], [0, 0]], time=[0, 10])
    assert met.against == "fish"
    assert met.time == pytest.approx(5 - 0.1 / 0.6, abs=0.02)
    fast = ws.check_motion([[0, 0], [2, 0]], time=[0, 2])
    assert fast.free


def test_stopping_distance_is_counted() -> None:
    wall = bathyal.KeepOut.half_space((0, -1, 0), -0.6, name="wall")  # y above 0.6
    ws = planar(keepouts=[wall])
    reach = np.arcsin(0.55 / 0.9)
    path, time = [[0, 0], [reach - 0.1, 0]], [0, 1.0]
    assert ws.check_motion(path, time=time)
    assert ws.check_motion(path, time=time, stopping=True, acceleration=10.0)
    weak = ws.check_motion(path, time=time, stopping=True, acceleration=0.5)
    assert not weak
    assert weak.against == "wall"
    with pytest.raises(ValueError, match="`time`"):
        ws.check_motion(path, stopping=True)


def test_the_tip_may_touch_only_when_it_is_meant_to() -> None:
    ws = sampler(scene=vehicles.flat_bottom(-1.1))
    q = ws.check_target([[1.4, 0.2, -1.1]]).q
    assert ws.clearance(q).distance[0] < 0
    assert ws.clearance(q, tip_contact=True).distance[0] > 0
    assert not ws.check_motion(q)
    assert ws.check_motion(q, tip_contact=True)
    lower = ws.check_target([[1.2, 0.0, -1.2]]).q  # the arm itself in the bottom
    assert ws.clearance(lower, tip_contact=True).distance[0] < 0


def test_what_is_held_can_hit() -> None:
    plate = bathyal.KeepOut.half_space((-1, 0, 0), point=(1.2, 0, 0), name="plate")
    ws = planar(keepouts=[plate])
    body = bathyal.RigidBody(2.0, volume=1e-3)
    rod = bathyal.Capsule((0, 0, 0), (0.4, 0, 0), 0.02)
    held = ws.attach([rod], body)
    assert ws.clearance([0, 0]).distance == pytest.approx(0.25)
    assert held.clearance([0, 0]).distance == pytest.approx(-0.12)
    assert held.attached.mass == 2.0
    assert held.detach().clearance([0, 0]).distance == pytest.approx(0.25)
    assert ws.attached.mass == 0
    with pytest.raises(ValueError, match="detach"):
        ws.detach()


def test_excluded_pairs_are_listed() -> None:
    arm = bathyal.arms.panda()
    ws = bathyal.Workspace(arm, allowed=[("link_7", "link_4")])
    reasons = {(one, other): why for one, other, why in ws.excluded}
    assert reasons["link_1", "link_0"] == "neighbours"
    assert reasons["link_7", "link_4"] == "allowed"
    boxed = bathyal.Workspace(
        arm, hull=bathyal.Hull(vehicles.box_mesh([-0.3] * 3, [0.3, 0.3, 0.4]))
    )
    assert ("link_1", "hull", "touch in every posture") in boxed.excluded
    assert "hull" in [other for _, other, _ in boxed.excluded]


def test_capsules_come_from_shapes_radii_or_lists() -> None:
    arm = bathyal.arms.panda()
    assert set(bathyal.Workspace(arm).place_capsules(np.zeros(7))[:, 6]) > {0.06}
    assert set(bathyal.Workspace(arm, radii=0.01).place_capsules(np.zeros(7))[:, 6]) == {0.01}
    ball = bathyal.Capsule((0, 0, 0), (0, 0, 0), 0.2)
    ws = bathyal.Workspace(arm, capsules={"link_5": [ball]})
    assert ws.capsule_links == ["link_5"]
    assert ws.place_capsules(np.zeros((4, 7))).shape == (4, 1, 7)
    bare = bathyal.Arm.from_dh(a=[0.5], alpha=[0], d=[0], theta=[0])
    with pytest.warns(UserWarning, match="bare segments"):
        bathyal.Workspace(bare)


def test_distances_agree_with_coal() -> None:
    coal = pytest.importorskip("coal")
    rng = np.random.default_rng(5)
    ws = bathyal.Workspace(bathyal.arms.panda(), MOUNT, hull=HULL)
    arm = ws.arm
    q = rng.uniform(arm.lower, arm.upper, (200, 7))
    near = ws.clearance(q)
    skip = {link for link, other, _ in ws.excluded if other == "hull"} | {"link_0"}
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(HULL.mesh.triangles), len(HULL.mesh.vertices))
    vertices = coal.StdVec_Vec3s()
    for vertex in HULL.mesh.vertices:
        vertices.append(vertex)
    triangles = coal.StdVec_Triangle()
    for a, b, c in HULL.mesh.triangles:
        triangles.append(coal.Triangle(int(a), int(b), int(c)))
    mesh.addSubModel(vertices, triangles)
    mesh.endModel()
    compared = 0
    for row, capsules in enumerate(ws.place_capsules(q)):
        least = np.inf
        for link, (*ends, radius) in zip(ws.capsule_links, capsules, strict=True):
            if link in skip:
                continue
            start, end = np.array(ends[:3]), np.array(ends[3:])
            length = np.linalg.norm(end - start)
            along = (end - start) / length if length > 0 else np.array([0, 0, 1.0])
            turn = coal.Transform3s(_turn_to(along), 0.5 * (start + end))
            result = coal.DistanceResult()
            coal.distance(
                mesh, coal.Transform3s.Identity(), coal.Capsule(radius, length), turn,
                coal.DistanceRequest(), result,
            )  # fmt: skip
            least = min(least, result.min_distance)
        if least > 0:
            compared += 1
            assert near.distance[row] == pytest.approx(least, abs=1e-6)
        else:
            assert near.distance[row] <= 1e-6
    assert compared > 80


def _turn_to(z: np.ndarray) -> np.ndarray:
    x = np.cross([0, 1, 0] if abs(z[1]) < 0.9 else [1, 0, 0], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda ws: ws.check_target([[np.nan, 0, 0]]), "points"),
        (lambda ws: ws.check_target([[np.inf, 0, 0]]), "points"),
        (lambda ws: ws.clearance([0, 0]), "q"),
        (lambda ws: ws.clearance([[0, 0, np.nan]]), "q"),
        (lambda ws: ws.check_motion(np.zeros((0, 3))), "q"),
        (lambda ws: ws.check_motion(np.zeros((2, 3)), time=[1, 1]), "time"),
        (lambda ws: ws.check_motion(np.zeros((2, 3)), time=[0]), "time"),
        (
            lambda ws: ws.check_motion(
                np.zeros((2, 3)), time=[0, 1], stopping=True, acceleration=0
            ),
            "acceleration",
        ),
        (lambda ws: ws.clearance(np.zeros((2, 3)), time=[0, 1, 2]), "time"),
        (lambda _: sampler(vehicle_pose=np.ones((4, 4))), "vehicle_pose"),
        (lambda _: sampler(vehicle_pose_std=[-1] * 6), "vehicle_pose_std"),
        (lambda _: sampler(vehicle_pose_std=[0.1]), "vehicle_pose_std"),
        (lambda _: sampler(radii=-0.1), "radii"),
        (lambda _: sampler(capsules={"hand": []}), "capsules"),
        (lambda _: sampler(allowed=[("link_1", "x")]), "allowed"),
        (lambda _: sampler(keepouts=[bathyal.KeepOut.sphere(1, frame="moon")]), "keepouts"),
        (lambda _: bathyal.Trajectory([0, 0], np.stack([np.eye(4)] * 2)), "time"),
        (lambda _: bathyal.Trajectory([], np.zeros((0, 4, 4))), "time"),
        (lambda _: bathyal.Trajectory([0], np.zeros((1, 4, 4))), "pose"),
    ],
)
def test_bad_input_is_named(call, message: str) -> None:
    with pytest.raises(ValueError, match=f"`{message}"):
        call(sampler())


def test_an_unreachable_target_in_the_base_of_the_arm() -> None:
    found = sampler().check_target([MOUNT[:3, 3]])
    assert found.status[0] in ("hull", "unreachable", "collision")


def test_trajectories() -> None:
    turn = bathyal.Trajectory([0, 2], [pose(), pose(1, 0, 0, np.pi / 2)])
    np.testing.assert_allclose(turn.at(1.0), pose(0.5, 0, 0, np.pi / 4), atol=1e-12)
    np.testing.assert_array_equal(turn.at(-1.0), pose())
    assert turn.at([0.0, 1.0]).shape == (2, 4, 4)
    circle = bathyal.Trajectory.sampled(lambda t: pose(yaw=t), end=1.0, step=0.01)
    assert len(circle) == 101
    np.testing.assert_allclose(circle.at(0.505), pose(yaw=0.505), atol=1e-9)


@pytest.mark.parametrize(
    ("around", "words"),
    [
        ({"hull": bathyal.Hull(vehicles.box_mesh([-800, -350, -250], [500, 350, 250]))}, "millim"),
        ({"hull": bathyal.Hull(vehicles.box_mesh([-8e-4] * 3, [5e-4] * 3))}, "scale"),
        ({"hull": bathyal.Hull(vehicles.box_mesh([1e7] * 3, [1e7 + 1] * 3))}, "vehicle's frame"),
        ({"keepouts": [bathyal.KeepOut.sphere(1.0, name="all")]}, "all holds the arm's base"),
    ],
)
def test_what_looks_like_a_mistake_is_warned_of(around, words: str) -> None:
    with pytest.warns(UserWarning, match=words):
        bathyal.Workspace(bathyal.arms.maevskiy_zanin(), MOUNT, **around)
    assert sampler().warnings == []
