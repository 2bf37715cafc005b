# SPDX-License-Identifier: BSD-3-Clause
"""Shapes of a URDF's links: kept with their places, their meshes found only when asked for."""

from __future__ import annotations

import copy
import pickle
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import bathyal
from tests.support.urdf_cases import DATA, joint, links, read_text, robot, written

BOX = '<geometry><box size="0.1 0.2 0.3"/></geometry>'
MESH = '<geometry><mesh filename="{}" scale="0.001 0.001 -0.001"/></geometry>'
PLACE = '<origin xyz="0 0 0.5" rpy="0 0 1.5707963267948966"/>'


def shaped(collision: str | list[str], visual: str = "", *more: str) -> str:
    """foot, upper and hand, fixed to upper; shapes on hand."""
    collisions = [collision] if isinstance(collision, str) else collision
    hand = "".join(f"<collision>{shape}</collision>" for shape in collisions if shape)
    hand += f"<visual>{visual}</visual>" if visual else ""
    return robot(
        links("foot", "upper"),
        f'<link name="hand">{hand}</link>',
        joint("shoulder", "foot", "upper", more='<axis xyz="0 0 1"/><limit lower="-1" upper="1"/>'),
        joint("wrist", "upper", "hand", kind="fixed", xyz="1 0 0", more=""),
        *more,
    )


def test_shapes_keep_their_numbers_and_go_to_the_link_that_carries_them(tmp_path: Path) -> None:
    arm = read_text(tmp_path, shaped(PLACE + BOX, MESH.format("hand.stl")), tip="hand")
    assert [len(link.collision) for link in arm.links] == [0, 1]
    (box,), (mesh,) = arm.links[1].collision, arm.links[1].visual
    assert (box.kind, box.part, box.radius, box.file, box.scale) == ("box", "hand", *[None] * 3)
    np.testing.assert_array_equal(box.size, [0.1, 0.2, 0.3])
    np.testing.assert_allclose(box.pose @ [1, 0, 0, 1], [1, 1, 0.5, 1], atol=1e-15)
    assert (mesh.kind, mesh.file, mesh.folder) == ("mesh", "hand.stl", str(tmp_path))
    np.testing.assert_array_equal(mesh.scale, [0.001, 0.001, -0.001])
    np.testing.assert_array_equal(mesh.pose[:3, 3], [1, 0, 0])


def test_every_kind_is_read(tmp_path: Path) -> None:
    solids = ('<cylinder radius="0.1" length="0.4"/>', '<sphere radius="0.2"/>')
    arm = read_text(tmp_path, shaped([f"<geometry>{solid}</geometry>" for solid in solids]))
    cylinder, sphere = arm.links[1].collision
    assert (cylinder.kind, cylinder.radius, cylinder.length) == ("cylinder", 0.1, 0.4)
    assert (sphere.kind, sphere.radius, sphere.length) == ("sphere", 0.2, None)


def test_what_branches_off_brings_its_shapes(tmp_path: Path) -> None:
    finger = f'<link name="finger"><collision>{BOX}</collision></link>'
    text = shaped(BOX, "", finger, joint("grip", "hand", "finger", xyz="0 0.2 0"))
    arm = read_text(tmp_path, text, tip="hand")
    assert [shape.part for shape in arm.links[1].collision] == ["hand", "finger"]
    np.testing.assert_array_equal(arm.links[1].collision[1].pose[:3, 3], [1, 0.2, 0])


# Robots and how many shapes their files hold, counted by another reader.
REAL = {
    "arms/mukca/urdf/panda.urdf": "ball_link",
    "arms/mukca/urdf/gen3lite.urdf": "ball_link",
    "arms/mukca/urdf/iiwa14.urdf": None,
    "arms/mukca/urdf/vx300s.urdf": "ball_link",
    "uvms/urdf/alpha_seabotix.urdf": "r5m_jaw",
    "uvms/urdf/blue_rov_hardware.urdf": "r5m_wrist_link",
}


@pytest.mark.parametrize("name", REAL)
def test_real_files_keep_every_shape(name: str) -> None:
    path = DATA / name
    if not path.exists():
        pytest.skip(f"{path} is not there: the shared data are needed")
    arm = bathyal.Arm.from_urdf(path, tip=REAL[name])
    tree = ElementTree.parse(path)
    for tag in ("collision", "visual"):
        expected = Counter(
            part[0].tag for shape in tree.iter(tag) for part in shape.iter("geometry")
        )
        shapes = [shape for link in arm.links for shape in getattr(link, tag)]
        assert Counter(shape.kind for shape in shapes) == expected
        assert {s.file for s in shapes if s.file} == {
            mesh.get("filename") for shape in tree.iter(tag) for mesh in shape.iter("mesh")
        }


def dicts(arm: bathyal.Arm) -> list[list[dict[str, object]]]:
    return [
        [shape.as_dict() for shape in shapes]
        for link in arm.links
        for shapes in (link.collision, link.visual)
    ]


def same(one: bathyal.Arm, other: bathyal.Arm, *but: str) -> None:
    for shapes, others in zip(dicts(one), dicts(other), strict=True):
        assert len(shapes) == len(others)
        for a, b in zip(shapes, others, strict=True):
            assert a.keys() == b.keys()
            for key in a.keys() - set(but):
                np.testing.assert_array_equal(a[key], b[key], err_msg=key)


def test_copies_pickles_and_json_keep_shapes(tmp_path: Path) -> None:
    arm = read_text(tmp_path, shaped(PLACE + BOX, MESH.format("package://hand/hand.stl")))
    same(arm, arm.copy())
    same(arm, pickle.loads(pickle.dumps(arm)))
    same(arm, copy.deepcopy(arm))
    arm.save(tmp_path / "arm.json")
    again = bathyal.read_arm(tmp_path / "arm.json")
    same(arm, again, "folder")
    assert again.links[1].visual[0].folder == ""
    assert str(tmp_path) not in (tmp_path / "arm.json").read_text()


def test_an_arm_without_shapes_has_the_json_it_had(tmp_path: Path) -> None:
    arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    arm.save(tmp_path / "arm.json")
    text = (tmp_path / "arm.json").read_text()
    assert "collision" not in text
    assert "visual" not in text


def test_shapes_are_written_and_loaded_again(tmp_path: Path) -> None:
    arm = read_text(tmp_path, shaped(PLACE + BOX, MESH.format("hand.stl")))
    again = read_text(tmp_path, arm.to_urdf())
    for shapes, others in zip(dicts(arm), dicts(again), strict=True):
        for a, b in zip(shapes, others, strict=True):
            assert a["kind"] == b["kind"]
            for key in a.keys() - {"kind", "part", "file", "folder"}:
                np.testing.assert_allclose(a[key], b[key], rtol=0, atol=1e-12)


BROKEN = {
    "no_geometry": ("<origin/>", "expected a geometry with one of box, cylinder, sphere, mesh"),
    "empty": ("<geometry/>", "got nothing"),
    "unknown": ('<geometry><torus radius="1"/></geometry>', "got torus"),
    "two": ('<geometry><sphere radius="1"/><sphere radius="1"/></geometry>', "got sphere, sphere"),
    "no_size": ("<geometry><box/></geometry>", "link hand, collision: `size`: expected a value"),
    "half_size": ('<geometry><box size="1 1"/></geometry>', "box size: expected three finite"),
    "negative": ('<geometry><sphere radius="-1"/></geometry>', "`radius`: expected a finite"),
    "endless": ('<geometry><sphere radius="inf"/></geometry>', "`radius`: expected a finite"),
    "no_length": ('<geometry><cylinder radius="1"/></geometry>', "no cylinder length"),
    "no_file": ("<geometry><mesh/></geometry>", "it has no mesh filename"),
    "flat_scale": (
        '<geometry><mesh filename="a" scale="1 0 1"/></geometry>',
        "`scale`: expected numbers other than 0",
    ),
    "origin": ('<origin xyz="0 nan 0"/>' + BOX, "collision, origin xyz: expected three finite"),
}


@pytest.mark.parametrize("case", BROKEN)
def test_broken_shapes_are_refused_by_name(case: str, tmp_path: Path) -> None:
    text, reason = BROKEN[case]
    with pytest.raises(bathyal.Error, match="link hand, collision") as caught:
        read_text(tmp_path, shaped(text))
    assert reason in str(caught.value)


@pytest.mark.parametrize(
    ("kind", "options", "says"),
    [
        ("ball", {}, '`kind`: expected "box" or "cylinder"'),
        ("box", {}, "`size`: expected a value, as a box has, got None"),
        ("box", {"size": [1, 1]}, "`size`"),
        ("box", {"size": [1, 1, 1], "radius": 1}, "`radius`: expected none, as a box has, got 1"),
        ("sphere", {"radius": np.nan}, "`radius`: expected a finite number"),
        ("sphere", {"radius": "wide"}, "`radius`: expected a number, got 'wide'"),
        ("sphere", {"radius": 1, "scale": [1, 1, 1]}, "`scale`: expected none"),
        ("mesh", {"file": ""}, "`file`: expected the name of a mesh's file"),
        ("mesh", {"file": "a.stl", "pose": np.diag([2, 1, 1, 1])}, "`pose`: expected a rigid"),
    ],
)
def test_shapes_that_are_none_are_refused(kind: str, options: dict, says: str) -> None:
    with pytest.raises(ValueError, match=says):
        bathyal.Shape(kind, **options)


@pytest.fixture
def robot_folder(tmp_path: Path) -> Path:
    for name in ("robot/urdf/hand.stl", "robot/meshes/arm.stl", "secret.stl"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(bytes(84))
    return tmp_path / "robot"


def named(folder: Path, file: str) -> bathyal.Shape:
    """The mesh of a URDF in the robot's folder that names this file."""
    path = written(folder / "urdf", shaped("", MESH.format(file)))
    return bathyal.Arm.from_urdf(path, tip="hand").links[1].visual[0]


def test_a_mesh_is_found_in_the_urdfs_folder(robot_folder: Path) -> None:
    expected = robot_folder / "urdf" / "hand.stl"
    for name in ("hand.stl", "./hand.stl", str(expected), f"file://{expected}"):
        assert bathyal.mesh_path(named(robot_folder, name)) == expected


def test_a_package_is_where_the_caller_says(robot_folder: Path) -> None:
    shape = named(robot_folder, "package://kit/meshes/arm.stl")
    found = bathyal.mesh_path(shape, packages={"kit": robot_folder})
    assert found == robot_folder / "meshes" / "arm.stl"
    with pytest.raises(ValueError, match="`packages`: expected the folder of 'kit'"):
        bathyal.mesh_path(shape)
    away = named(robot_folder, "package://kit/../secret.stl")
    with pytest.raises(bathyal.Error, match="lies outside"):
        bathyal.mesh_path(away, packages={"kit": robot_folder})


def test_nothing_outside_is_found_unasked(robot_folder: Path) -> None:
    (robot_folder / "urdf" / "link.stl").symlink_to(robot_folder.parent / "secret.stl")
    for name in ("../meshes/arm.stl", "/etc/passwd", "file:///etc/passwd", "link.stl"):
        with pytest.raises(bathyal.Error, match=r"it lies outside .*inside="):
            bathyal.mesh_path(named(robot_folder, name))
    shape = named(robot_folder, "../meshes/arm.stl")
    expected = robot_folder / "meshes" / "arm.stl"
    assert bathyal.mesh_path(shape, inside=robot_folder) == expected


def test_meshes_that_are_not_there(robot_folder: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"none\.stl"):
        bathyal.mesh_path(named(robot_folder, "none.stl"))
    with pytest.raises(bathyal.Error, match="expected a file or package"):
        bathyal.mesh_path(named(robot_folder, "http://example.org/a.stl"))
    with pytest.raises(ValueError, match="`folder`: expected where 'hand"):
        bathyal.mesh_path(bathyal.Shape("mesh", file="hand.stl"))
    with pytest.raises(ValueError, match="`shape`: expected a mesh, got a sphere"):
        bathyal.mesh_path(bathyal.Shape("sphere", radius=1))
