# SPDX-License-Identifier: BSD-3-Clause
"""Maps of an arm's reach: arrays, agreement with inverse kinematics, files, pictures."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest

import bathyal
from tests.support.reach import differences

RING = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
FIELDS = (
    "origin",
    "approach",
    "reached_along",
    "reached",
    "free",
    "directions",
    "manipulability",
    "clearance",
)


@pytest.fixture(scope="module")
def hulled() -> bathyal.ReachMap:
    """The three-joint arm in front of a box."""
    corners = np.array([[x, y, z] for x in (-1, 0) for y in (-0.3, 0.3) for z in (-0.3, 0.3)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
    faces += [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    hull = bathyal.Hull(bathyal.TriangleMesh(corners.astype(float), faces))
    mount = np.eye(4)
    mount[0, 3] = 0.05
    arm = bathyal.arms.maevskiy_zanin()
    return bathyal.Workspace(arm, mount, hull=hull, radii=0.03).reach_map(voxel=0.06)


def middles(reach: bathyal.ReachMap) -> np.ndarray:
    grid = np.stack(np.indices(reach.reached.shape), axis=-1)
    return reach.origin + reach.voxel * (grid + 0.5)


def test_reach_of_a_planar_arm_is_a_ring() -> None:
    reach = bathyal.Workspace(RING, radii=0.02).reach_map(voxel=0.03, directions=6)
    middle = middles(reach)
    radius = np.linalg.norm(middle[..., :2], axis=-1)
    ring = (np.abs(middle[..., 2]) < 1e-9) & (radius > 0.1) & (radius < 0.9)
    near = np.minimum(np.abs(radius - 0.1), np.abs(radius - 0.9)) < 1e-3
    np.testing.assert_array_equal(reach.reached[~near], ring[~near])
    np.testing.assert_array_equal(reach.free, reach.reached)
    np.testing.assert_array_equal(reach.directions, reach.reached_along.sum(axis=-1))
    assert reach.directions.dtype == np.uint8
    up = np.argmax(reach.approach[:, 2])
    np.testing.assert_array_equal(reach.reached_along[..., up], reach.reached)
    assert np.isnan(reach.manipulability[~reach.reached]).all()


def test_arrays_cannot_be_written_to(hulled: bathyal.ReachMap) -> None:
    for name in FIELDS:
        assert not getattr(hulled, name).flags.writeable


def test_agrees_with_inverse_kinematics() -> None:
    arm = bathyal.arms.panda()
    reach = bathyal.Workspace(arm, radii=0.05).reach_map(voxel=0.08, check_clearance=False)
    found = differences(reach, arm, 1500, seed=3)
    assert found.reached.mean() < 0.01
    assert found.along.mean() < 0.01


def test_hull_is_not_free_and_yet_reached(hulled: bathyal.ReachMap) -> None:
    middle = middles(hulled)
    inside = (
        (middle[..., 0] < -0.05) & (middle[..., 0] > -0.95)
        & (np.abs(middle[..., 1:]) < 0.25).all(axis=-1)
    )  # fmt: skip
    assert hulled.reached[inside].any()
    assert not hulled.free[inside].any()
    assert (hulled.clearance[inside & hulled.reached] < 0).all()
    assert hulled.free.sum() > 0.5 * hulled.reached.sum()
    assert (hulled.clearance[hulled.free] > 0).all()


def test_file_gives_the_map_back_and_is_the_same_twice(
    hulled: bathyal.ReachMap, tmp_path: Path
) -> None:
    hulled.save(tmp_path / "a.npz")
    found = bathyal.read_reach_map(tmp_path / "a.npz")
    assert found.voxel == hulled.voxel
    for name in FIELDS:
        np.testing.assert_array_equal(getattr(found, name), getattr(hulled, name))
    found.save(tmp_path / "b.npz")
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


@pytest.fixture
def saved(hulled: bathyal.ReachMap, tmp_path: Path) -> tuple[Path, dict[str, np.ndarray]]:
    path = tmp_path / "reach.npz"
    hulled.save(path)
    with np.load(path) as archive:
        return path, dict(archive)


@pytest.mark.parametrize("kept", [0, 10, 1000, -30])
def test_truncated_file_is_refused(saved: tuple[Path, dict[str, np.ndarray]], kept: int) -> None:
    path, _ = saved
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(bathyal.Error, match=r"reach\.npz"):
        bathyal.read_reach_map(path)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("format", np.array("bathyal reach map 9")),
        ("voxel", np.array(-1.0)),
        ("voxel", np.array([0.1, 0.2])),
        ("approach", np.zeros((26, 3))),
        ("approach", np.array([{}] * 26, dtype=object)),
        ("reached", np.zeros((2, 2, 2), dtype=bool)),
        ("reached", np.zeros((2, 2, 2), dtype=float)),
        ("origin", np.array([np.nan, 0.0, 0.0])),
        ("free", None),
        ("more", np.zeros(3)),
    ],
)
def test_other_contents_are_refused(
    saved: tuple[Path, dict[str, np.ndarray]], name: str, value: np.ndarray | None
) -> None:
    path, fields = saved
    if value is None:
        del fields[name]
    else:
        fields[name] = value
    np.savez(path, **fields)
    with pytest.raises(bathyal.Error, match=r"reach\.npz"):
        bathyal.read_reach_map(path)


def test_array_larger_than_its_file_is_refused(
    saved: tuple[Path, dict[str, np.ndarray]],
) -> None:
    path, _ = saved
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    huge = members["reached.npy"].replace(b"'shape': (", b"'shape': (99999999, ")
    members["reached.npy"] = huge[:128].replace(b"          \n", b"\n") + huge[128:]
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    with pytest.raises(bathyal.Error, match=r"reach\.npz"):
        bathyal.read_reach_map(path)


def test_missing_file_is_the_systems_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        bathyal.read_reach_map(tmp_path / "none.npz")


def test_picture_and_cloud_are_drawn(hulled: bathyal.ReachMap, tmp_path: Path) -> None:
    hulled.plot(tmp_path / "reach.png")
    assert (tmp_path / "reach.png").read_bytes().startswith(b"\x89PNG")
    figure = hulled.show()
    free, blocked = figure.data
    assert len(free.x) > 100
    assert len(blocked.x) > 10
    bare = bathyal.Workspace(RING, radii=0.02).reach_map(voxel=0.1, check_clearance=False)
    bare.plot(tmp_path / "bare.png")
    assert len(bare.show().data[1].x) == 0


@pytest.mark.parametrize(
    ("options", "name"),
    [
        ({"voxel": 0.0}, "voxel"),
        ({"voxel": float("nan")}, "voxel"),
        ({"voxel": 1e-4}, "voxel"),
        ({"directions": 12}, "directions"),
        ({"samples": -5}, "samples"),
    ],
)
def test_bad_options_are_refused(options: dict[str, float], name: str) -> None:
    with pytest.raises(ValueError, match=f"`{name}`"):
        bathyal.Workspace(RING, radii=0.02).reach_map(**options)
