# SPDX-License-Identifier: BSD-3-Clause
"""Arms in files of their own and for other programs: whole, exact, or refused."""

import configparser
import copy
import json
import pickle
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import bathyal
from bathyal._core import arm_from_parts, arm_parts
from bathyal.arm.exports import write_ros_kinematics

CATALOGUE = {name: getattr(bathyal.arms, name) for name in bathyal.arms.__all__}
RIGHT = np.pi / 2


def turned(angle: float, *, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, z], [0, 0, 0, 1]])


def identified_ur10e() -> bathyal.Arm:
    """The UR10e off its drawing by what touches find, with beta where axes are nearly parallel."""
    table = bathyal.arms.ur10e().to_dh()
    noise = np.random.default_rng(3).normal(0, 1e-3, (5, 6))
    arm = bathyal.Arm.from_dh(
        a=table.a + noise[0],
        alpha=table.alpha + noise[1],
        d=np.where([1, 0, 0, 1, 1, 1], table.d + noise[2], 0),
        theta=table.theta + noise[3],
        beta=np.where([0, 1, 1, 0, 0, 0], noise[4], 0),
        name="identified",
    )
    arm.tool = turned(0.3, x=0.01, z=0.2)
    return arm


def everything() -> bathyal.Arm:
    """An arm that has each thing a file could lose."""
    arm = arm_from_parts(
        {
            "name": "Ärmel",
            "source": "made up",
            "root": turned(0.3, z=0.1),
            "joints": [
                {"name": "slide", "type": "prismatic", "a": 0.1, "coordinate": 0,
                 "follows": "drive", "multiplier": 0.5, "offset": 0.01, "lower": 0.0,
                 "velocity": 0.2, "effort": 100.0},
                {"name": "bracket", "type": "fixed", "alpha": 0.2},
                {"name": "turn", "d": 1 / 3, "theta": 0.1, "beta": 1e-3, "coordinate": 1,
                 "lower": -1.0, "upper": 2.0},
            ],
            "links": [
                {"name": "foot", "frames": [{"name": "bolt", "pose": turned(0.1, x=1.0)}]},
                {"name": "sledge", "mass": 2.0, "volume": 1e-3,
                 "center_of_mass": [0.1, 0.2, 0.3], "center_of_buoyancy": [0.3, 0.2, 0.1],
                 "inertia": np.diag([0.1, 0.2, 0.3]), "frame": turned(0.7, y=0.4)},
                {"name": ""},
                {"name": "hand"},
            ],
            "flange": turned(-0.4, x=0.2),
        }
    )  # fmt: skip
    arm.base, arm.tool = turned(1.0, x=4e5), turned(2.0, z=0.05)
    return arm


def same_parts(one: Any, other: Any) -> bool:
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same_parts(one[k], other[k]) for k in one)
    if isinstance(one, list):
        return len(one) == len(other) and all(map(same_parts, one, other))
    if isinstance(one, bathyal.Shape):
        return same_parts(one.as_dict(), other.as_dict())
    return bool(np.array_equal(one, other))


@pytest.mark.parametrize("name", [*CATALOGUE, "everything"])
def test_json_keeps_all_to_the_last_digit(name: str, tmp_path: Path) -> None:
    arm = CATALOGUE[name]() if name in CATALOGUE else everything()
    path = tmp_path / "arm.json"
    arm.save(path)
    assert same_parts(arm_parts(bathyal.read_arm(path)), arm_parts(arm))
    assert json.loads(path.read_text(encoding="utf-8"))["format"] == "bathyal arm"


def test_copies_and_pickles_are_whole() -> None:
    arm = everything()
    for other in (pickle.loads(pickle.dumps(arm)), copy.deepcopy(arm), arm.copy()):
        assert same_parts(arm_parts(other), arm_parts(arm))


def test_a_part_that_differs_is_seen() -> None:
    parts = arm_parts(everything())
    changed = copy.deepcopy(parts)
    changed["links"][0]["frames"][0]["name"] = "nut"
    assert not same_parts(changed, parts)


def test_an_arm_is_read_by_suffix(tmp_path: Path) -> None:
    arm = bathyal.arms.panda()
    for suffix in (".json", ".urdf", ".URDF"):
        arm.write(tmp_path / f"arm{suffix}")
        again = bathyal.read_arm(tmp_path / f"arm{suffix}")
        np.testing.assert_allclose(again.forward([0.1] * 7), arm.forward([0.1] * 7), atol=1e-14)
    assert bathyal.read_arm(tmp_path / "arm.urdf", tip=arm.joint_names[2]).size == 3


TOLD = {"format": "bathyal arm", "version": 1, "joints": [{"coordinate": 0}]}
BROKEN = {
    "empty": (b"", "the file is empty"),
    "not_json": (b"{", "not a readable arm file"),
    "truncated": (json.dumps(TOLD)[:-5], "not a readable arm file"),
    "binary": (bytes(range(256)), "not a readable arm file"),
    "a_list": ("[1]", 'does not say "format"'),
    "another_format": ('{"format": "robot"}', 'does not say "format"'),
    "later_version": (json.dumps(TOLD | {"version": 2}), "expected version 1, got 2"),
    "nan": (json.dumps(TOLD).replace("0}", '0, "a_m": NaN}'), "the number NaN is none"),
    "no_joints": (json.dumps(TOLD | {"joints": []}), "joints"),
    "unknown_key": (json.dumps(TOLD | {"colour": 1}), "its key 'colour' is not known"),
    "no_unit": (json.dumps(TOLD).replace("0}", '0, "a": 1}'), "its key 'a' is not known"),
    "wrong_unit": (json.dumps(TOLD).replace("0}", '0, "lower_m": 1}'), "its key 'lower_m' is not"),
    "text": (json.dumps(TOLD).replace("0}", '0, "a_m": "1"}'), "expected a number, got '1'"),
    "type": (json.dumps(TOLD).replace("0}", '0, "type": "ball"}'), "got 'ball'"),
    "joints_text": (json.dumps(TOLD | {"joints": "six"}), "joints: expected a list"),
    "joint_text": (json.dumps(TOLD | {"joints": ["six"]}), "a joint: expected an object"),
    "skewed": (
        json.dumps(TOLD | {"flange_from_tool_m": [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}),
        "tool",
    ),
    "deep": ("[" * 100_000, "not a readable arm file"),
}


@pytest.mark.parametrize("case", BROKEN)
def test_broken_json_is_reported_by_name_and_reason(case: str, tmp_path: Path) -> None:
    text, reason = BROKEN[case]
    path = tmp_path / "arm.json"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(bathyal.Error) as caught:
        bathyal.read_arm(path)
    assert str(path) in str(caught.value)
    assert reason in str(caught.value)


def test_the_least_json_is_an_arm(tmp_path: Path) -> None:
    path = tmp_path / "arm.json"
    path.write_text(json.dumps(TOLD))
    assert bathyal.read_arm(path).size == 1


def test_what_is_asked_wrongly(tmp_path: Path) -> None:
    arm = bathyal.arms.ur10e()
    with pytest.raises(ValueError, match="`path`: expected a robot file"):
        arm.write(tmp_path / "arm.dae")
    with pytest.raises(ValueError, match="`path`: expected a"):
        arm.save(tmp_path / "arm.urdf")
    with pytest.raises(ValueError, match="`path`: expected a"):
        bathyal.read_arm(tmp_path / "arm.xml")
    arm.save(tmp_path / "arm.json")
    with pytest.raises(ValueError, match=r"`tip`: expected only for a \.urdf file"):
        bathyal.read_arm(tmp_path / "arm.json", tip="flange")
    with pytest.raises(ValueError, match="`nominal`: expected the maker's arm"):
        arm.write(tmp_path / "calibration.conf")
    with pytest.raises(ValueError, match=r"`nominal`: expected only for a \.conf"):
        arm.write(tmp_path / "arm.urdf", nominal=arm)
    with pytest.raises(OSError, match="none"):
        arm.write(tmp_path / "none" / "arm.urdf")
    assert [file.name for file in tmp_path.iterdir()] == ["arm.json"]


@pytest.mark.parametrize("suffix", [".json", ".urdf", ".yaml", ".conf"])
def test_a_file_appears_whole_or_not_at_all(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"arm{suffix}"
    path.write_text("before")
    options = {"nominal": bathyal.arms.ur10e()} if suffix == ".conf" else {}
    path.chmod(0o444)
    arm = bathyal.arms.ur10e()
    try:
        arm.write(path, **options)
    except PermissionError:
        assert path.read_text() == "before"
    else:  # root may write anything
        assert path.read_text() != "before"
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


def rpy_matrix(roll: float, pitch: float, yaw: float) -> np.ndarray:
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (np.cos, np.sin))
    x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return z @ y @ x


def beyond(text: str, what: str) -> np.ndarray:
    """A transform that a comment tells."""
    lines = [line for line in text.splitlines() if line.startswith(f"# {what}")]
    if not lines:
        return np.eye(4)
    x, y, z, *angles = map(float, lines[0].split("[rad] ")[1].split())
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rpy_matrix(*angles), (x, y, z)
    return pose


@pytest.mark.parametrize("make", [bathyal.arms.ur10, bathyal.arms.ur10e, identified_ur10e])
def test_ros_kinematics_move_as_the_arm(make: Any, tmp_path: Path) -> None:
    """Read as ur_description's macro does: joint origins, each joint about its own z."""
    arm = make()
    arm.base = turned(0.5, x=1.0, y=2.0)
    path = tmp_path / "kinematics.yaml"
    arm.write(path)
    text = path.read_text(encoding="utf-8")
    content = yaml.safe_load(text)["kinematics"]
    assert list(content) == [
        "shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3", "hash"
    ]  # fmt: skip
    for q in np.random.default_rng(1).uniform(-3, 3, (5, 6)):
        pose = beyond(text, "before base_link_inertia")
        for link, angle in zip(list(content.values())[:6], q, strict=True):
            origin = np.eye(4)
            origin[:3, :3] = rpy_matrix(link["roll"], link["pitch"], link["yaw"])
            origin[:3, 3] = link["x"], link["y"], link["z"]
            pose = pose @ origin @ turned(angle)
        pose = pose @ beyond(text, "behind wrist_3")
        np.testing.assert_allclose(pose, arm.forward(q), rtol=0, atol=1e-13)


def test_ros_kinematics_of_the_drawing_are_the_makers(tmp_path: Path) -> None:
    write_ros_kinematics(bathyal.arms.ur10e(), tmp_path / "k.yaml", hash="calib_1")
    content = yaml.safe_load((tmp_path / "k.yaml").read_text())["kinematics"]
    assert content["hash"] == "calib_1"
    numbers = {link: list(values.values()) for link, values in content.items() if link != "hash"}
    expected = {
        "shoulder": [0, 0, 0.1807, 0, 0, 0],
        "upper_arm": [0, 0, 0, RIGHT, 0, 0],
        "forearm": [-0.6127, 0, 0, 0, 0, 0],
        "wrist_1": [-0.57155, 0, 0.17415, 0, 0, 0],
        "wrist_2": [0, -0.11985, 0, RIGHT, 0, 0],
        "wrist_3": [0, 0.11655, 0, -RIGHT, 0, 0],
    }
    for link, values in expected.items():
        np.testing.assert_allclose(numbers[link], values, atol=1e-4)


def read_conf(path: Path) -> np.ndarray:
    conf = configparser.ConfigParser()
    conf.read(path)
    names = ("delta_theta", "delta_a", "delta_d", "delta_alpha")
    return np.array([json.loads(conf["mounting"][name]) for name in names])


@pytest.mark.parametrize("make", [bathyal.arms.ur10e, identified_ur10e])
def test_ur_calibration_moves_as_the_arm(make: Any, tmp_path: Path) -> None:
    """Added to the maker's table, without beta, as the controller does."""
    arm, nominal = make(), bathyal.arms.ur10e()
    path = tmp_path / "calibration.conf"
    arm.write(path, nominal=nominal)
    theta, a, d, alpha = read_conf(path)
    table = nominal.to_dh()
    controller = bathyal.Arm.from_dh(
        a=table.a + a, alpha=table.alpha + alpha, d=table.d + d, theta=table.theta + theta
    )
    behind = beyond(path.read_text(encoding="utf-8"), "behind the last row")
    q = np.random.default_rng(1).uniform(-3, 3, (20, 6))
    # The long d of the common normal costs digits: 1e3 m have an ulp of 1e-13.
    np.testing.assert_allclose(controller.forward(q) @ behind, arm.forward(q), rtol=0, atol=1e-9)


def test_ur_calibration_of_the_drawing_is_nothing(tmp_path: Path) -> None:
    arm = bathyal.arms.ur10e()
    arm.write(tmp_path / "c.conf", nominal=arm)
    np.testing.assert_array_equal(read_conf(tmp_path / "c.conf"), np.zeros((4, 6)))


def test_nearly_parallel_axes_have_the_long_d_of_the_makers_own_files(tmp_path: Path) -> None:
    identified_ur10e().write(tmp_path / "c.conf", nominal=bathyal.arms.ur10e())
    assert np.abs(read_conf(tmp_path / "c.conf")[2]).max() > 10


def test_calibration_files_are_refused_where_they_would_not_be_true(tmp_path: Path) -> None:
    ur = bathyal.arms.ur10e()
    with pytest.raises(ValueError, match="`arm`: expected six turning joints"):
        bathyal.arms.panda().write(tmp_path / "k.yaml")
    with pytest.raises(ValueError, match="`nominal`: expected six turning joints"):
        ur.write(tmp_path / "c.conf", nominal=bathyal.arms.panda())
    table = ur.to_dh()
    tilted = [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]]
    columns = {"a": table.a, "alpha": table.alpha, "d": table.d, "theta": table.theta}
    with pytest.raises(ValueError, match="expected a first joint about z of the base"):
        bathyal.Arm.from_dh(**columns, root=tilted).write(tmp_path / "c.conf", nominal=ur)
    hair = bathyal.Arm.from_dh(**columns, beta=[0, 1e-9, 0, 0, 0, 0])
    with pytest.raises(ValueError, match=r"axes 2 and 3 that are parallel but for 1\.0e-09 rad"):
        hair.write(tmp_path / "c.conf", nominal=ur)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("where", "old", "new"),
    [
        ("joints[0].a_m", '"a_m": 0.0', '"a_m": true'),
        ("links[1].mass_kg", '"mass_kg": 0.0', '"mass_kg": false'),
        ("world_from_base_m[0][0]", "[1.0, 0.0, 0.0, 0.0]", "[true, 0.0, 0.0, 0.0]"),
    ],
)
def test_true_is_no_number(tmp_path: Path, where: str, old: str, new: str) -> None:
    path = tmp_path / "arm.json"
    bathyal.Arm.from_dh(a=[0.0, 0.5], alpha=[0, 0], d=[0, 0], theta=[0, 0]).save(path)
    text = path.read_text()
    places = [i for i in range(len(text)) if text.startswith(old, i)]
    assert places, text
    at = places[1] if where == "links[1].mass_kg" else places[0]
    path.write_text(text[:at] + new + text[at + len(old) :])
    word = "false" if "false" in new else "true"
    with pytest.raises(
        bathyal.Error, match=re.escape(f"`{where}`: expected a number") + f".*{word}"
    ):
        bathyal.read_arm(path)


def test_true_is_no_number_of_an_effect_either(tmp_path: Path) -> None:
    path = tmp_path / "model.json"
    arm = bathyal.Arm.from_dh(a=[0.5], alpha=[0], d=[0], theta=[0])
    arm.save(path)
    content = json.loads(path.read_text())
    content["effects"] = [{"name": "joint_scale", "joint": 0, "parameters": [
        {"name": "scale", "unit": "", "scale": 1e-3, "value": True}]}]  # fmt: skip
    content["support"] = {"joints": {"low": [0], "high": [1]}, "gravity_m_s2": {"low": [0, 0, 0],
                       "high": [0, 0, 0]}, "sessions": []}  # fmt: skip
    path.write_text(json.dumps(content))
    with pytest.raises(bathyal.Error, match=r"`effects\[0\]\.parameters\[0\]\.value`: expected"):
        bathyal.read_arm(path)
