# SPDX-License-Identifier: BSD-3-Clause
"""Clearances of a workspace against plain numpy, Coal and Pinocchio."""

import threading

import numpy as np
import pytest

import bathyal
from tests.support import capsule_truth as truth


def random_keepout(random, name, frames):
    """A convex keep-out and its distance as numpy has it: frame, frame_from_shape, distance."""
    kind = random.choice(["sphere", "box", "cylinder", "cone", "half_space"])
    frame = str(random.choice(frames))
    place, named = truth.random_pose(random), {"frame": frame, "name": name}
    if kind == "sphere":
        radius = random.uniform(0.05, 0.5)
        keepout, distance = (
            bathyal.KeepOut.sphere(radius, place[:3, 3], **named),
            truth.sphere(radius),
        )
    elif kind == "box":
        size = random.uniform(0.01, 1, 3)
        keepout, distance = bathyal.KeepOut.box(size, place, **named), truth.box(size)
    elif kind == "cylinder":
        radius, length = random.uniform(0.01, 0.6, 2)
        keepout = bathyal.KeepOut.cylinder(radius, length, place, **named)
        distance = truth.cylinder(radius, length)
    elif kind == "cone":
        radius, length = random.uniform(0.05, 1, 2)
        keepout = bathyal.KeepOut.cone(length, place, angle=2 * np.arctan2(radius, length), **named)
        distance = truth.cone(length, radius)
    else:
        keepout = bathyal.KeepOut.half_space(3 * place[:3, 2], point=place[:3, 3], **named)
        distance = truth.half_space()
    if frame != "hull" and random.random() < 0.3:
        moved = truth.random_pose(random, 0.5)
        keepout, place = keepout.moved(moved), moved @ place
    return keepout, (frame, place, distance)


@pytest.mark.parametrize("seed", range(60))
def test_random_arms_and_keepouts_agree_with_numpy(seed):
    random = np.random.default_rng(seed)
    rows = int(random.integers(2, 6))
    types = [
        str(t) for t in random.choice(["revolute", "prismatic", "fixed"], rows, p=[0.6, 0.2, 0.2])
    ]
    types[0] = "revolute"
    links = [bathyal.Link(f"link_{i}") for i in range(rows + 1)]
    a, d = random.uniform(-0.5, 0.5, (2, rows))
    alpha, theta = random.uniform(-2, 2, (2, rows))
    root, flange, base, tool, mount, vehicle = (truth.random_pose(random, 0.5) for _ in range(6))
    arm = bathyal.Arm.from_dh(
        a, alpha, d, theta, joint_types=types, root=root, flange=flange, links=links
    )
    arm.base, arm.tool = base, tool
    q = random.uniform(-1.5, 1.5, arm.size)
    frames, values = [mount @ root], iter(q)
    for row, kind in enumerate(types):
        value = 0.0 if kind == "fixed" else next(values)
        slide, turn = (value, 0.0) if kind == "prismatic" else (0.0, value)
        frames.append(
            frames[-1] @ truth.standard_row(a[row], alpha[row], d[row] + slide, theta[row] + turn)
        )
    capsules = {}
    for name in arm.link_names[1:]:
        ends = random.normal(size=(2, 2, 3)) * 0.2
        ends[0, 1] = ends[0, 0]  # a ball
        capsules[name] = [bathyal.Capsule(*end, random.uniform(0, 0.08)) for end in ends]
    made = [random_keepout(random, f"k{j}", ["hull", "world", *arm.link_names]) for j in range(3)]
    ws = bathyal.Workspace(
        arm, mount, keepouts=[k for k, _ in made], vehicle_pose=vehicle, capsules=capsules
    )
    want = np.inf
    excluded = {pair[:2] for pair in ws.excluded}
    for link, name in enumerate(arm.link_names):
        for capsule in capsules.get(name, []):
            for j, (frame, place, distance) in enumerate(known for _, known in made):
                if frame == name or (name, f"k{j}") in excluded:
                    continue
                fixed = {"hull": np.eye(4), "world": np.linalg.inv(vehicle)}
                shape = (
                    fixed[frame] if frame in fixed else frames[arm.link_names.index(frame)]
                ) @ place
                ends = [
                    truth.apply(np.linalg.inv(shape) @ frames[link], e)
                    for e in (capsule.start, capsule.end)
                ]
                want = min(want, truth.least_on_segment(distance, *ends) - capsule.radius)
    near = ws.clearance(q)
    assert near.distance == pytest.approx(want, abs=1e-9)
    if np.isfinite(want):
        frame, place, distance = made[int(near.against[1:])][1]
        if frame == "hull" and want > 0:
            assert distance(truth.apply(np.linalg.inv(place), near.point)) == pytest.approx(
                0, abs=1e-9
            )
            between = np.linalg.norm(near.point - near.link_point) - near.distance
            assert min(abs(between - c.radius) for c in capsules[near.link]) < 1e-9


@pytest.mark.parametrize("name", ["ur10e", "panda", "reach_bravo_7", "reach_alpha_5", "gen3_lite"])
def test_links_among_themselves_agree_with_numpy(name):
    arm = getattr(bathyal.arms, name)()
    ws = bathyal.Workspace(arm)
    excluded = {frozenset(pair[:2]) for pair in ws.excluded}
    random = np.random.default_rng(1)
    q = random.uniform(np.maximum(arm.lower, -3), np.minimum(arm.upper, 3), (25, arm.size))
    near, placed, links = ws.clearance(q), ws.place_capsules(q), ws.capsule_links
    assert np.isinf(near.distance).all()
    for row in range(len(q)):
        want = min(
            truth.between_segments(c[:3], c[3:6], e[:3], e[3:6]) - c[6] - e[6]
            for i, c in enumerate(placed[row])
            for j, e in enumerate(placed[row][:i])
            if links[i] != links[j] and frozenset((links[i], links[j])) not in excluded
        )
        assert near.self_distance[row] == pytest.approx(want, abs=1e-9)


def rough_floor(random, side=12):
    x, y = np.meshgrid(*[np.linspace(-3, 3, side)] * 2, indexing="ij")
    vertices = np.stack([x, y, random.normal(size=x.shape) * 0.15 - 0.8], -1).reshape(-1, 3)
    i = np.arange(side * side).reshape(side, side)
    one = np.stack([i[:-1, :-1], i[1:, :-1], i[1:, 1:]], -1).reshape(-1, 3)
    two = np.stack([i[:-1, :-1], i[1:, 1:], i[:-1, 1:]], -1).reshape(-1, 3)
    return vertices, np.concatenate([one, two])


def coal_distance(coal, mesh, start, end, radius):
    """Of a capsule that touches no triangle: the distance of its axis, less the radius."""
    thin, along = 1e-6, end - start
    length = np.linalg.norm(along)
    if length < 1e-9:
        shape, turn = coal.Sphere(thin), np.eye(3)
    else:
        z = along / length
        x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
        x /= np.linalg.norm(x)
        shape, turn = coal.Capsule(thin, length), np.stack([x, np.cross(z, x), z], 1)
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    place = coal.Transform3s(turn, (start + end) / 2)
    return (
        coal.distance(mesh, coal.Transform3s.Identity(), shape, place, request, result)
        + thin
        - radius
    )


@pytest.mark.parametrize("seed", range(12))
def test_bottom_agrees_with_coal_far_from_the_origin(seed):
    coal = pytest.importorskip("coal")
    random = np.random.default_rng(seed)
    vertices, triangles = rough_floor(random)
    survey = truth.pose(random.normal(size=3) * 100, (0, 0, 1), random.uniform(-3, 3))
    vertices = truth.apply(survey, vertices)
    scene = bathyal.Scene(bathyal.TriangleMesh(vertices, triangles))
    vehicle = survey @ truth.pose(random.normal(size=3) * 0.1, random.normal(size=3), 0.3)
    arm = bathyal.arms.ur10e() if seed % 2 else bathyal.arms.maevskiy_zanin()
    arm.base, arm.tool = truth.random_pose(random), truth.random_pose(random, 0.1)
    ws = bathyal.Workspace(arm, truth.random_pose(random, 0.2), scene=scene, vehicle_pose=vehicle)
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(triangles), len(vertices))
    for corners in triangles:
        mesh.addTriangle(*vertices[corners])
    mesh.endModel()
    q = random.uniform(-1.5, 1.5, (8, arm.size))
    near, placed = ws.clearance(q), ws.place_capsules(q)
    for row in range(len(q)):
        moving = [
            c for c, link in zip(placed[row], ws.capsule_links, strict=True) if link != "link_0"
        ]
        spots = [
            truth.apply(vehicle, c[:3] + t * (c[3:6] - c[:3]))
            for c in moving
            for t in (0, 0.25, 0.5, 0.75, 1)
        ]
        under = np.isfinite(scene.cast(np.array(spots), [[0, 0, 1.0]] * len(spots)).range).any()
        if under:
            assert near.distance[row] < 0
            continue
        want = min(
            coal_distance(coal, mesh, *truth.apply(vehicle, c[:6].reshape(2, 3)), c[6])
            for c in moving
        )
        if want > 0:
            assert near.distance[row] == pytest.approx(want, abs=2e-6)
            world = truth.apply(vehicle, near.point[row])
            assert scene.nearest(world[None]).distance[0] < 1e-9


MIMIC = """<robot name="r"><link name="base"/>
<link name="l1"><collision><origin xyz=".25 0 0" rpy="0 1.5707963267948966 0"/>
 <geometry><cylinder radius=".04" length=".5"/></geometry></collision></link>
<link name="l2"><collision><origin xyz=".2 .1 0" rpy="0 0 .3"/>
 <geometry><box size=".4 .1 .06"/></geometry></collision></link>
<link name="l3"><collision><origin xyz="0 0 .1"/>
 <geometry><sphere radius=".07"/></geometry></collision></link>
<joint name="j1" type="revolute"><parent link="base"/><child link="l1"/>
 <origin xyz="0 0 .1" rpy=".1 .2 .3"/><axis xyz="0 0 1"/>
 <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/>
 <origin xyz=".5 0 0"/><axis xyz="0 1 0"/>
 <limit lower="-2" upper="2" effort="1" velocity="1"/>
 <mimic joint="j1" multiplier="-.5" offset=".2"/></joint>
<joint name="j3" type="prismatic"><parent link="l2"/><child link="l3"/>
 <origin xyz=".4 0 0" rpy="0 .4 0"/><axis xyz="1 0 0"/>
 <limit lower="0" upper=".3" effort="1" velocity="1"/></joint></robot>"""


def test_capsules_of_a_urdf_enclose_its_shapes_where_pinocchio_puts_them(tmp_path):
    pinocchio = pytest.importorskip("pinocchio")
    path = tmp_path / "mimic.urdf"
    path.write_text(MIMIC)
    arm = bathyal.Arm.from_urdf(path)
    random = np.random.default_rng(2)
    mount = truth.random_pose(random, 0.3)
    ws = bathyal.Workspace(arm, mount)
    model = pinocchio.buildModelFromUrdf(str(path))
    data = model.createData()
    for turn, slide in random.uniform([-2, 0], [2, 0.3], (10, 2)):
        pinocchio.forwardKinematics(model, data, np.array([turn, -0.5 * turn + 0.2, slide]))
        pinocchio.updateFramePlacements(model, data)
        placed = ws.place_capsules([turn, slide])
        places = {
            name: mount @ data.oMf[model.getFrameId(name)].homogeneous
            for name in ("l1", "l2", "l3")
        }
        box = np.array(
            [[x, y, z] for x in (-0.2, 0.2) for y in (-0.05, 0.05) for z in (-0.03, 0.03)]
        )
        points = {
            "l1": np.array([[x, y, 0] for x in (0, 0.25, 0.5) for y in (-0.04, 0.04)]),
            "l2": truth.apply(truth.pose((0.2, 0.1, 0), (0, 0, 1), 0.3), box),
            "l3": np.array([[0, 0, 0.1]]) + 0.07 * np.vstack([np.eye(3), -np.eye(3)]),
        }
        for name, corners in points.items():
            capsules = [c for c, link in zip(placed, ws.capsule_links, strict=True) if link == name]
            for corner in truth.apply(places[name], corners):
                assert (
                    min(
                        truth.between_segments(corner, corner, c[:3], c[3:6]) - c[6]
                        for c in capsules
                    )
                    < 1e-9
                )
            loosest = max(c[6] for c in capsules)
            assert loosest < 0.075


def test_fourteen_degrees_of_pitch_at_three_sigma_take_the_tip_22_centimetres():
    arm = bathyal.Arm.from_dh(a=[0.9], alpha=[0], d=[0], theta=[0])
    std = [0, 0, 0, 0, np.radians(14) / 3, 0]

    def height(frame, **known):
        floor = bathyal.KeepOut.half_space((0, 0, 1), point=(0, 0, -1), frame=frame)
        return bathyal.Workspace(arm, radii=0, keepouts=[floor], **known).clearance([0.0]).distance

    assert height("world") == pytest.approx(1)
    assert height("world", vehicle_pose_std=std) == pytest.approx(
        1 - 0.9 * np.radians(14), abs=1e-3
    )
    assert height("hull", vehicle_pose_std=std) == pytest.approx(1)


@pytest.mark.parametrize("seed", range(8))
def test_uncertain_pose_takes_no_less_than_three_sigma_towards_the_obstacle(seed):
    random = np.random.default_rng(seed)
    arm, std = bathyal.arms.maevskiy_zanin(), np.abs(random.normal(size=6)) * 0.02
    vehicle, mount = truth.random_pose(random, 2), truth.random_pose(random, 0.3)
    toward = random.normal(size=3)
    center = truth.apply(vehicle, 2.2 * toward / np.linalg.norm(toward))
    ball = bathyal.KeepOut.sphere(0.1, center, frame="world")
    q = random.uniform(-1, 1, 3)
    known = bathyal.Workspace(arm, mount, keepouts=[ball], vehicle_pose=vehicle)
    near = known.clearance(q)
    less = bathyal.Workspace(
        arm, mount, keepouts=[ball], vehicle_pose=vehicle, vehicle_pose_std=std
    )
    normal = (near.point - near.link_point) / np.linalg.norm(near.point - near.link_point)
    sensitivity = np.r_[normal, np.cross(near.link_point, normal)]
    assert near.distance - less.clearance(q).distance > 3 * np.linalg.norm(sensitivity * std) - 1e-9


def test_base_of_the_arm_plays_no_part_and_its_tool_is_the_tip():
    arm = bathyal.Arm.from_dh(
        a=[0.6, 0.5], alpha=[0, 0], d=[0, 0], theta=[0, 0], lower=[-2, -2], upper=[2, 2]
    )
    placed = bathyal.Workspace(arm, radii=0.01).place_capsules([0.2, 0.3])
    arm.base = truth.pose((5, 5, 5), (1, 2, 3), 1.0)
    ws = bathyal.Workspace(arm, radii=0.01)
    arm.tool = truth.pose((0.3, 0, 0.2))
    longer = bathyal.Workspace(arm, radii=0.01)
    assert np.array_equal(ws.place_capsules([0.2, 0.3]), placed)
    points = [[1.4, 0, 0.2], [1.1, 0, 0]]
    assert ws.check_target(points).status.tolist() == ["unreachable", "free"]
    assert longer.check_target(points).status.tolist() == ["free", "unreachable"]


def test_what_is_attached_counts_from_the_tip_until_it_is_detached():
    arm = bathyal.Arm.from_dh(
        a=[0.6, 0.5], alpha=[0, 0], d=[0, 0], theta=[0, 0], tool=truth.pose((0.3, 0, 0.2))
    )
    ws = bathyal.Workspace(arm, radii=0.01, keepouts=[bathyal.KeepOut.sphere(0.1, (2, 0, 0.2))])
    holding = ws.attach(
        [bathyal.Capsule([0, 0, 0], [0.4, 0, 0], 0.05)], bathyal.RigidBody(2, volume=0.001)
    )
    assert ws.clearance([0, 0]).distance == pytest.approx(0.6 - 0.11)
    assert holding.clearance([0, 0]).distance == pytest.approx(0.2 - 0.15)
    assert holding.detach().clearance([0, 0]).distance == pytest.approx(0.6 - 0.11)
    assert (holding.attached.mass, ws.attached.mass) == (2, 0)
    with pytest.raises(ValueError, match="detach"):
        ws.detach()


def test_rows_do_not_depend_on_each_other_nor_on_threads_and_are_read_only():
    random = np.random.default_rng(3)
    arm = bathyal.arms.panda()
    scene = bathyal.Scene(bathyal.TriangleMesh(*rough_floor(random, 40)))
    beam = bathyal.KeepOut.cone(2, truth.random_pose(random, 0.5), angle=0.5, frame="world")
    ws = bathyal.Workspace(arm, truth.pose((0, 0, 0.3)), scene=scene, keepouts=[beam])
    q = random.uniform(arm.lower, arm.upper, (4000, 7))
    one, many = ws.clearance(q, num_threads=1), ws.clearance(q, num_threads=3)
    for name in ("distance", "self_distance", "link", "against", "point", "link_point"):
        values = getattr(one, name)
        assert values.tobytes() == getattr(many, name).tobytes()
        assert not values.flags.writeable
    for row in range(0, 4000, 400):
        assert ws.clearance(q[row]).distance == one.distance[row]
    found = []
    workers = [
        threading.Thread(target=lambda: found.append(ws.clearance(q).distance)) for _ in range(4)
    ]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert {values.tobytes() for values in found} == {one.distance.tobytes()}
