# SPDX-License-Identifier: BSD-3-Clause
"""URDFs that are none: each refused with the file's name and what is wrong, nothing guessed."""

from pathlib import Path

import pytest

import bathyal
from tests.support.urdf_cases import LIMIT, joint, links, read_text, robot, two_joints, written

INERTIAL = '<mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
BOMB = (
    '<?xml version="1.0"?><!DOCTYPE robot [<!ENTITY a "ha">'
    + "".join(
        f'<!ENTITY {b} "{f"&{a};" * 20}">' for a, b in zip("abcdefgh", "bcdefghi", strict=True)
    )
    + ']><robot name="&i;"/>'
)
OUTSIDE = (
    '<?xml version="1.0"?><!DOCTYPE robot [<!ENTITY x SYSTEM "file:///etc/passwd">]>'
    '<robot name="&x;"/>'
)

BROKEN = {
    "empty": (b"", "the file is empty"),
    "not_xml": (b"x" * 100, "not well-formed"),
    "binary": (bytes(range(256)) * 10, "not well-formed"),
    "truncated": (two_joints()[:-40], "not well-formed"),
    "bomb": (BOMB, "document type"),
    "outside": (OUTSIDE, "document type"),
    "another_root": ("<sdf/>", "root element is sdf"),
    "xacro": (
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="a"/></robot>',
        "xacro",
    ),
    "no_links": (robot(), "no links"),
    "nameless_link": (robot("<link/>"), "a link has no name"),
    "nameless_joint": (robot('<joint type="fixed"/>'), "a joint has no name"),
    "missing_link": (robot(links("a"), joint("j", "a", "b")), "joint j: its link b is missing"),
    "no_parent": (
        robot(links("a"), '<joint name="j" type="fixed"><child link="a"/></joint>'),
        "joint j: it has no parent link",
    ),
    "two_parents": (
        robot(links("a", "b"), joint("j", "a", "b", more='<parent link="b"/>')),
        "joint j: it has 2 elements parent",
    ),
    "link_twice": (robot(links("a", "a")), "link a: it is defined twice"),
    "joint_twice": (
        robot(links("a", "b", "c"), joint("j", "a", "b"), joint("j", "b", "c")),
        "joint j: it is defined twice",
    ),
    "loop": (
        robot(links("a", "b"), joint("j", "a", "b"), joint("k", "b", "a")),
        "loop through a, b",
    ),
    "loop_beside": (
        two_joints(links("x", "y"), joint("j", "x", "y"), joint("k", "y", "x")),
        "loop through x, y",
    ),
    "closed_chain": (
        two_joints(joint("strut", "foot", "lower")),
        "link lower: joints elbow and strut both end in it",
    ),
    "own_child": (robot(links("a"), joint("j", "a", "a")), "loop through a"),
    "two_trees": (two_joints(links("island")), "foot, island have no joint above them"),
    "unknown_type": (robot(links("a", "b"), joint("j", "a", "b", kind="ball")), "got ball"),
    "no_type": (robot(links("a", "b"), joint("j", "a", "b", kind="")), "joint j: expected type"),
    "planar": (robot(links("a", "b"), joint("j", "a", "b", kind="planar")), "a planar joint"),
    "floating": (robot(links("a", "b"), joint("j", "a", "b", kind="floating")), "a floating"),
    "no_axis": (
        robot(links("a", "b"), joint("j", "a", "b", more='<axis xyz="0 0 0"/>' + LIMIT)),
        "`joint j axis`: expected a direction",
    ),
    "half_axis": (
        robot(links("a", "b"), joint("j", "a", "b", more='<axis xyz="0 1"/>' + LIMIT)),
        "joint j, axis xyz: expected three finite numbers, got '0 1'",
    ),
    "nan_origin": (
        robot(links("a", "b"), joint("j", "a", "b", xyz="0 nan 0")),
        "joint j, origin xyz: expected three finite numbers",
    ),
    "comma": (
        robot(links("a", "b"), joint("j", "a", "b", rpy="0,5 0 0")),
        "joint j, origin rpy: expected three finite numbers",
    ),
    "no_limit": (
        robot(links("a", "b"), joint("j", "a", "b", more="")),
        "joint j: a revolute joint needs a limit",
    ),
    "empty_limit": (
        robot(links("a", "b"), joint("j", "a", "b", more='<limit velocity="1" effort="1"/>')),
        "joint j: a revolute joint needs a limit",
    ),
    "crossed_limits": (
        robot(links("a", "b"), joint("j", "a", "b", more='<limit lower="1" upper="-1"/>')),
        "its lower limit 1.0 is above",
    ),
    "nan_limit": (
        robot(links("a", "b"), joint("j", "a", "b", more='<limit lower="nan" upper="1"/>')),
        "joint j, limit lower: expected a number",
    ),
    "mimics_nobody": (
        two_joints().replace(
            LIMIT + "</joint></robot>", LIMIT + '<mimic joint="knee"/></joint></robot>'
        ),
        "joint elbow: it mimics knee, which is missing",
    ),
    "mimics_itself": (
        robot(
            links("a", "b", "c"),
            joint("j", "a", "b", more=LIMIT + '<mimic joint="k"/>'),
            joint("k", "b", "c", more=LIMIT + '<mimic joint="j"/>'),
        ),
        "it mimics itself",
    ),
    "mimics_fixed": (
        robot(
            links("a", "b", "c"),
            joint("j", "a", "b", kind="fixed"),
            joint("k", "b", "c", more=LIMIT + '<mimic joint="j"/>'),
        ),
        "a fixed joint",
    ),
    "mimics_by_nothing": (
        robot(
            links("a", "b", "c"),
            joint("j", "a", "b"),
            joint("k", "b", "c", more=LIMIT + '<mimic joint="j" multiplier="0"/>'),
        ),
        "multiplier 0",
    ),
    "no_mass": (
        robot('<link name="a"><inertial/></link>', links("b"), joint("j", "a", "b")),
        "link a, inertial: it has no mass value",
    ),
    "half_inertia": (
        robot(
            '<link name="a"><inertial><mass value="1"/><inertia ixx="1"/></inertial></link>',
            links("b"),
            joint("j", "a", "b"),
        ),
        "link a, inertial: it has no inertia ixy",
    ),
    "mass_below_zero": (
        robot(
            f'<link name="a"><inertial>{INERTIAL}</inertial></link>'.replace("1", "-1", 1),
            links("b"),
            joint("j", "a", "b"),
        ),
        "link a mass",
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_broken_file_is_reported_by_name_and_reason(case: str, tmp_path: Path) -> None:
    text, reason = BROKEN[case]
    with pytest.raises(bathyal.Error) as caught:
        read_text(tmp_path, text)
    assert str(tmp_path / "arm.urdf") in str(caught.value)
    assert reason in str(caught.value)


def test_nothing_is_logged_or_mended(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    for text, _ in BROKEN.values():
        with pytest.raises(bathyal.Error):
            read_text(tmp_path, text)
    assert capfd.readouterr() == ("", "")


def test_missing_file_is_an_os_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        bathyal.Arm.from_urdf(tmp_path / "none.urdf")


def test_file_beyond_all_measure_is_refused_before_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / "huge.urdf"
    with open(path, "wb") as stream:
        stream.truncate(1 << 34)  # sparse
    with pytest.raises(bathyal.Error, match="more than BATHYAL_MOST_BYTES"):
        bathyal.Arm.from_urdf(path)


def test_ten_thousand_links_are_an_arm_like_any_other(tmp_path: Path) -> None:
    count = 10_000
    names = [f"link{k}" for k in range(count)]
    text = robot(
        links(*names),
        *(
            joint(f"j{k}", names[k], names[k + 1], kind="fixed" if k % 10 else "revolute")
            for k in range(count - 1)
        ),
    )
    arm = read_text(tmp_path, text)
    assert arm.size == 1000
    assert arm.forward([0.0] * 1000)[2, 3] == pytest.approx(0.5 * (count - 1))


def test_meshes_are_never_opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = "<visual><geometry><mesh filename='{}'/></geometry></visual>"
    text = two_joints().replace(
        '<link name="upper"/>',
        '<link name="upper">'
        + mesh.format("/etc/passwd")
        + mesh.format("package://arm/upper.dae")
        + mesh.format(r"C:\\arm\\upper.obj")
        + "</link>",
    )
    written(tmp_path, text)
    opened: list[str] = []
    real = open

    def noting(file: object, *arguments: object, **options: object) -> object:
        opened.append(str(file))
        return real(file, *arguments, **options)  # type: ignore[call-overload]

    monkeypatch.setattr("builtins.open", noting)
    bathyal.Arm.from_urdf(tmp_path / "arm.urdf")
    assert not [file for file in opened if "passwd" in file or "upper" in file]


def test_an_end_must_be_named_where_there_are_several(tmp_path: Path) -> None:
    text = two_joints(
        links("left", "right"),
        joint("grip_left", "lower", "left", kind="fixed"),
        joint("grip_right", "lower", "right"),
    )
    with pytest.raises(
        ValueError, match=r"`tip`: expected one of 'left' \(2 joints\), 'right' \(3"
    ):
        read_text(tmp_path, text)
    assert read_text(tmp_path, text, tip="left").size == 2
    assert read_text(tmp_path, text, tip="grip_right").size == 3


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"tip": "hand"}, "`tip`: expected the name of a link or joint, for instance lower, got"),
        ({"root": "hull"}, "`root`: expected one of the links foot, upper, lower, got 'hull'"),
        ({"root": "lower", "tip": "upper"}, "`root`: expected a link that carries 'upper'"),
        ({"tip": "foot"}, "`tip`: expected a link behind moving joints, got 'foot'"),
    ],
)
def test_ends_that_are_not_there(options: dict[str, str], message: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=message):
        read_text(tmp_path, two_joints(), **options)
