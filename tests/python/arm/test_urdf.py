# SPDX-License-Identifier: BSD-3-Clause
"""Arms from URDF and back: the motion, the names, the limits and the masses of the file."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from bathyal._core import arm_from_chain, arm_parts
from bathyal.arm.urdf_writer import rpy_of
from tests.support.urdf_cases import (
    DATA,
    LIMIT,
    REAL,
    joint,
    joint_values,
    links,
    read_text,
    robot,
    two_joints,
    written,
)

pin = pytest.importorskip("pinocchio")

CATALOGUE = {name: getattr(bathyal.arms, name) for name in bathyal.arms.__all__}


def real_arm(name: str) -> tuple[bathyal.Arm, Path, str]:
    file, tip = REAL[name]
    path = DATA / file
    if not path.exists():
        pytest.skip(f"{path} is not there: the shared data are needed")
    arm = bathyal.Arm.from_urdf(path, tip=tip)
    return arm, path, tip or arm.source.split()[-1]


def poses(arm: bathyal.Arm, count: int = 20) -> np.ndarray:
    return np.random.default_rng(7).uniform(-3, 3, (count, arm.size))


def rpy_matrix(roll: float, pitch: float, yaw: float) -> np.ndarray:
    return np.array(pin.rpy.rpyToMatrix(roll, pitch, yaw))


def rigid(roll: float, pitch: float, yaw: float, x: float, y: float, z: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, :3] = rpy_matrix(roll, pitch, yaw)
    pose[:3, 3] = x, y, z
    return pose


def pinocchio_frame(path: Path, values: dict[str, float], frame: str) -> np.ndarray:
    """Where Pinocchio has a link of the file, joints at `values`, the others at 0."""
    model = pin.buildModelFromUrdf(str(path))
    data = model.createData()
    q = pin.neutral(model)
    for name, value in values.items():
        joint = model.joints[model.getJointId(name)]
        if joint.nq == 2:  # continuous: cosine and sine
            q[joint.idx_q : joint.idx_q + 2] = np.cos(value), np.sin(value)
        else:
            q[joint.idx_q] = value
    pin.framesForwardKinematics(model, data, q)
    return np.array(data.oMf[model.getFrameId(frame, pin.FrameType.BODY)].homogeneous)


@pytest.mark.parametrize("name", REAL)
def test_real_files_move_as_in_pinocchio(name: str) -> None:
    arm, path, tip = real_arm(name)
    for q in poses(arm, 5):
        expected = pinocchio_frame(path, joint_values(arm, q), tip)
        np.testing.assert_allclose(arm.forward(q), expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", REAL)
def test_links_of_real_files_lie_as_in_pinocchio(name: str) -> None:
    arm, path, _ = real_arm(name)
    q = poses(arm, 1)[0]
    for link, pose in zip(arm.link_names, arm.forward(q, links=True), strict=True):
        expected = pinocchio_frame(path, joint_values(arm, q), link)
        np.testing.assert_allclose(pose, expected, rtol=0, atol=1e-12, err_msg=link)


@pytest.mark.parametrize("name", ["gen3lite", "trailblazer", "alpha_seabotix"])
def test_masses_of_real_files_weigh_as_in_pinocchio(name: str) -> None:
    """Gravity torques, what leaves the path and what is fixed to it included."""
    arm, path, _ = real_arm(name)
    model = pin.buildModelFromUrdf(str(path))
    data = model.createData()
    for q in poses(arm, 3):
        at = pin.neutral(model)
        for joint_name, value in joint_values(arm, q).items():
            at[model.joints[model.getJointId(joint_name)].idx_q] = value
        gravity = pin.computeGeneralizedGravity(model, data, at)
        expected = np.zeros(arm.size)
        for part in arm_parts(arm)["joints"]:
            index = model.joints[model.getJointId(part["name"])].idx_v
            expected[part["coordinate"]] += part["multiplier"] * gravity[index]
        np.testing.assert_allclose(
            arm.statics(q, gravity=(0, 0, -9.81)), expected, rtol=1e-9, atol=1e-9
        )


def test_a_joint_without_limits_matters_only_on_the_path() -> None:
    path = DATA / "uvms/urdf/blue_rov_hardware.urdf"
    if not path.exists():
        pytest.skip(f"{path} is not there: the shared data are needed")
    assert bathyal.Arm.from_urdf(path, tip="r5m_wrist_link").size == 4
    with pytest.raises(bathyal.Error, match="joint r5m_joint_jaw: a revolute joint needs a limit"):
        bathyal.Arm.from_urdf(path, tip="r5m_jaw1")


def test_panda_has_the_makers_table() -> None:
    arm, _, _ = real_arm("panda")
    table = arm.to_dh()
    right = np.pi / 2
    np.testing.assert_allclose(table.a, [0, 0, 0.0825, -0.0825, 0, 0.088, 0], atol=1e-15)
    np.testing.assert_allclose(
        table.alpha, [-right, right, right, -right, right, right, 0], atol=1e-15
    )
    np.testing.assert_allclose(table.d, [0.333, 0, 0.316, 0, 0.384, 0, 0], atol=1e-15)
    np.testing.assert_array_equal(table.beta, 0)
    np.testing.assert_allclose(table.theta, 0, atol=1e-15)


def test_column_follows_its_drive_though_that_is_off_the_path() -> None:
    arm, _, _ = real_arm("trailblazer")
    assert arm.joint_names[0] == "column_prismatic_joint"
    assert (arm.lower[0], arm.upper[0]) == (pytest.approx(1.48), pytest.approx(3.972))
    low, high = np.zeros((2, arm.size))
    low[0], high[0] = 1.5, 3.5
    np.testing.assert_allclose(
        (arm.forward(high) - arm.forward(low))[:3, 3], [0, 0, 2.0], atol=1e-12
    )


@pytest.mark.parametrize("name", [*CATALOGUE, *REAL])
@pytest.mark.parametrize("moved", [False, True], ids=["plain", "base_and_tool"])
def test_what_is_written_loads_again(name: str, moved: bool, tmp_path: Path) -> None:
    arm = CATALOGUE[name]() if name in CATALOGUE else real_arm(name)[0]
    if moved:
        arm.base = rigid(0.3, -1.0, 2.0, 400.0, -2.0, -30.0)
        arm.tool = rigid(-0.2, np.pi / 2, 0.4, 0.1, 0.0, 0.05)
    path = tmp_path / "arm.urdf"
    text = arm.to_urdf(path)
    assert path.read_text(encoding="utf-8") == text
    again = bathyal.Arm.from_urdf(path)
    q = poses(arm)
    np.testing.assert_allclose(again.forward(q), arm.forward(q), rtol=0, atol=1e-12)
    np.testing.assert_allclose(again.base, arm.base, rtol=0, atol=1e-12)
    np.testing.assert_allclose(again.tool, arm.tool, rtol=0, atol=1e-12)
    np.testing.assert_allclose(again.statics(q), arm.statics(q, water_density=0.0), atol=1e-9)
    for field in ("name", "joint_names", "joint_types"):
        assert getattr(again, field) == (getattr(arm, field) or "arm")
    for field in ("lower", "upper", "velocity", "effort"):
        np.testing.assert_allclose(getattr(again, field), getattr(arm, field), rtol=1e-15)
    np.testing.assert_allclose(
        pinocchio_frame(path, joint_values(again, q[0]), "tool"), arm.forward(q[0]), atol=1e-12
    )


def test_writing_twice_changes_nothing(tmp_path: Path) -> None:
    arm, _, _ = real_arm("trailblazer")
    once = arm.to_urdf().splitlines()[2:]
    again = read_text(tmp_path, arm.to_urdf(), name="trailblazer")
    names = [line for line in again.to_urdf().splitlines()[2:] if "name=" in line]
    assert names == [line for line in once if "name=" in line]


@given(
    st.tuples(*[st.floats(-4, 4)] * 3)
    | st.tuples(st.floats(-4, 4), st.sampled_from([np.pi / 2, -np.pi / 2]), st.floats(-4, 4))
    | st.tuples(st.floats(-4, 4), st.floats(np.pi / 2 - 1e-7, np.pi / 2), st.floats(-4, 4))
)
def test_angles_tell_the_turn_to_rounding_also_at_a_right_angle(angles: tuple[float, ...]) -> None:
    turn = rpy_matrix(*angles)
    np.testing.assert_allclose(rpy_matrix(*rpy_of(turn)), turn, rtol=0, atol=1e-15 * 4)


vectors = st.tuples(*[st.floats(-1, 1)] * 3)


@settings(max_examples=60, deadline=None)
@given(
    drawn=st.lists(
        st.tuples(
            vectors,
            st.tuples(*[st.sampled_from([0.0, np.pi / 2, -np.pi / 2, np.pi, 0.7, 1e-4])] * 3),
            vectors.filter(lambda axis: np.linalg.norm(axis) > 0.1)
            | st.sampled_from([(0, 0, 1), (1, 0, 0), (0, -1, 0)]),
            st.sampled_from(["revolute", "prismatic", "fixed", "continuous"]),
        ),
        min_size=1,
        max_size=8,
    ).filter(lambda drawn: any(kind != "fixed" for *_, kind in drawn))
)
def test_any_chain_moves_as_in_pinocchio_and_loads_again(drawn: list, tmp_path_factory) -> None:
    folder = tmp_path_factory.mktemp("chain")
    names = [f"l{k}" for k in range(len(drawn) + 1)]
    joints = []
    for k, (xyz, rpy, axis, kind) in enumerate(drawn):
        words = [" ".join(map(str, numbers)) for numbers in (xyz, rpy, axis)]
        more = f'<axis xyz="{words[2]}"/>{LIMIT}'
        joints.append(
            joint(f"j{k}", names[k], names[k + 1], kind=kind, xyz=words[0], rpy=words[1], more=more)
        )
    path = written(folder, robot(links(*names), *joints))
    arm = bathyal.Arm.from_urdf(path)
    q = poses(arm, 3)
    for row in q:
        expected = pinocchio_frame(path, joint_values(arm, row), names[-1])
        np.testing.assert_allclose(arm.forward(row), expected, rtol=0, atol=1e-11)
    again = read_text(folder, arm.to_urdf())
    np.testing.assert_allclose(again.forward(q), arm.forward(q), rtol=0, atol=1e-12)


def test_mimic_joints_share_a_coordinate_and_its_limits(tmp_path: Path) -> None:
    text = robot(
        links("a", "b", "c", "d"),
        joint("lead", "a", "b"),
        joint(
            "half", "b", "c", more=LIMIT + '<mimic joint="lead" multiplier="-0.5" offset="0.1"/>'
        ),
        joint("last", "c", "d", more=LIMIT + '<mimic joint="half" multiplier="3" offset="0.5"/>'),
    )
    arm = read_text(tmp_path, text)
    assert arm.joint_names == ["lead"]
    values = joint_values(arm, np.array([0.4]))
    assert values == pytest.approx({"lead": 0.4, "half": -0.1, "last": 0.2})
    # last = -1.5 lead + 0.8 keeps within 2 for less of the lead than its own limits.
    assert (arm.lower[0], arm.upper[0]) == (pytest.approx(-0.8), pytest.approx(2.8 / 1.5))


def test_continuous_joints_have_no_limits(tmp_path: Path) -> None:
    text = two_joints().replace('"elbow" type="revolute"', '"elbow" type="continuous"')
    arm = read_text(tmp_path, text)
    assert arm.lower.tolist() == [-2, -math.inf]
    again = read_text(tmp_path, arm.to_urdf())
    assert again.upper.tolist() == [2, math.inf]
    assert 'type="continuous"' in arm.to_urdf()


def test_sliding_without_limits_is_written_and_read_again(tmp_path: Path) -> None:
    arm = bathyal.Arm.from_dh(
        a=[0.1], alpha=[0.2], d=[0.3], theta=[0.4], joint_types=["prismatic"], lower=[0.0]
    )
    again = read_text(tmp_path, arm.to_urdf())
    assert (again.lower[0], again.upper[0]) == (0.0, math.inf)
    assert again.velocity[0] == math.inf


def test_a_lone_limit_is_paired_with_zero(tmp_path: Path) -> None:
    text = two_joints().replace('lower="-2" ', "")
    assert read_text(tmp_path, text).lower.tolist() == [0, 0]


def test_tip_may_be_any_link_or_joint(tmp_path: Path) -> None:
    text = two_joints(links("hand", "eye"), joint("wrist", "lower", "hand", kind="fixed"),
                      joint("look", "upper", "eye", kind="fixed", xyz="0.2 0 0"))  # fmt: skip
    q = [0.3, -0.5]
    hand = read_text(tmp_path, text, tip="hand")
    assert hand.forward(q)[:3, 3] == pytest.approx(
        [0.5 * math.sin(0.3) + 0.5 * math.sin(-0.2), 0,
         0.5 + 0.5 * math.cos(0.3) + 0.5 * math.cos(-0.2)]
    )  # fmt: skip
    np.testing.assert_array_equal(
        read_text(tmp_path, text, tip="wrist").forward(q), hand.forward(q)
    )
    eye = read_text(tmp_path, text, tip="eye")
    assert eye.size == 1
    assert eye.forward(q[:1])[:3, 3] == pytest.approx(
        [0.2 * math.cos(0.3), 0, 0.5 - 0.2 * math.sin(0.3)]
    )
    assert read_text(tmp_path, text, tip="hand", root="upper").joint_names == ["elbow"]
    assert read_text(tmp_path, text, tip="hand", name="mine").name == "mine"


def test_names_of_links_that_fixed_joints_join_are_kept(tmp_path: Path) -> None:
    text = robot(
        links("world", "foot", "upper", "clamp", "lower", "lamp", "hand"),
        joint("stand", "world", "foot", kind="fixed"),
        joint("shoulder", "foot", "upper"),
        joint("bolted", "upper", "clamp", kind="fixed"),
        joint("elbow", "clamp", "lower"),
        joint("lamp_mount", "lower", "lamp", kind="fixed", xyz="0.1 0 0"),
        joint("wrist", "lower", "hand", kind="fixed"),
    )
    arm = read_text(tmp_path, text, tip="hand")
    frames = [[frame["name"] for frame in link["frames"]] for link in arm_parts(arm)["links"]]
    assert arm.link_names == ["world", "upper", "lower"]
    assert frames == [["foot"], ["clamp"], ["lamp", "hand"]]
    again = read_text(tmp_path, arm.to_urdf(), tip="lamp")
    np.testing.assert_allclose(
        again.forward([0.3, 0.4]), read_text(tmp_path, text, tip="lamp").forward([0.3, 0.4]),
        atol=1e-15,
    )  # fmt: skip


def test_one_name_for_several_things_is_made_several() -> None:
    parts = {"name": "", "type": "revolute", "axis": [0, 0, 1]}
    joints = [parts | {"coordinate": k} for k in range(2)]
    arm = arm_from_chain({"joints": joints, "links": [{"name": "tool"}] * 3})
    text = arm.to_urdf()
    for name in ("tool", "tool_2", "tool_3", "tool_4", "joint_1", "joint_2", "flange"):
        assert text.count(f'name="{name}"') == 1, name


def test_text_that_xml_must_escape_survives(tmp_path: Path) -> None:
    arm = bathyal.Arm.from_dh(
        a=[1], alpha=[0], d=[0], theta=[0], names=['a<&">'], name="Ö & <b>", source="x -- y"
    )
    again = read_text(tmp_path, arm.to_urdf())
    assert (again.name, again.joint_names) == ("Ö & <b>", ['a<&">'])
