# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of real arms; a test that asks for one that is not there is skipped."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]
ARMS = Path(__file__).resolve().parents[3] / "shared" / "data" / "arms"
SOCKETS_APART = 0.05  # of each pair that MUKCa's arms touched [m]


def _there(path: Path) -> Path:
    if not path.exists():
        pytest.skip(f"{path.name} of the shared data is not here")
    return path


def placements(robot: str) -> list[str]:
    """Where MUKCa's pair of sockets was: each of them is its own two points."""
    return sorted(folder.name for folder in _there(ARMS / "mukca" / "data" / robot).iterdir())


@cache
def _every_socket(robot: str) -> bathyal.Touches:
    folder = ARMS / "mukca" / "data" / robot
    names = placements(robot)
    files = {f"{name}/{k}": folder / name / f"hole_{k}.csv" for name in names for k in (0, 1)}
    return bathyal.read_touches(files, unit="rad")


def sockets(
    robot: str,
    with_distance: Callable[[str], bool] = lambda placement: True,
    used: Callable[[str], bool] = lambda placement: True,
) -> bathyal.Touches:
    """Touches of MUKCa's sockets at the placements `used`; `with_distance` says where one is given.

    Placement k's two sockets are points 2 k and 2 k + 1.
    """
    names = placements(robot)
    every = _every_socket(robot)
    rows = np.isin(every.point // 2, [k for k, name in enumerate(names) if used(name)])
    distances = {
        (2 * k, 2 * k + 1): SOCKETS_APART
        for k, name in enumerate(names)
        if used(name) and with_distance(name)
    }
    return bathyal.Touches(every.q[rows], every.point[rows], known_distances=distances or None)


def apart(points: Array) -> Array:
    """Of each pair of sockets, in the order of placements [m]."""
    return np.linalg.norm(points[0::2] - points[1::2], axis=1)


_SERIES = {
    "A": "measurements_grid.csv",
    "B": "measurements_joint_configurations.csv",
    "C": "measurements_random_poses.csv",
}


@cache
def ur10(series: str) -> bathyal.Tracked:
    """Positions that IPA's laser tracker saw of its UR10, in the order they were taken."""
    return bathyal.read_tracked(
        _there(ARMS / "ipa-ur10" / f"Series_{series}" / _SERIES[series]),
        joints=bathyal.arms.ur10().joint_names,
        unit="rad",
        position=[f"measurement_{axis}" for axis in "xyz"],
        position_unit="mm",
    )


def blocks(count: int, number: int = 10) -> NDArray[np.bool_]:
    """(count,) every other one of so many blocks of neighbours: poses taken one after the other lie
    close together, so that to leave out single ones would leave out nothing."""
    return np.arange(count) * number // count % 2 == 0


@cache
def _hilti_rows(site: str) -> list[tuple[dict[str, Any], str]]:
    yaml = pytest.importorskip("yaml")
    with _there(ARMS / "hilti-jaibot" / f"{site}.yaml").open() as file:
        content = yaml.load(file, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    return [
        (measured, kind)
        for height in content["column_heights"].values()
        for space in height["solution_spaces"].values()
        for kind, measurements in space.items()
        for measured in measurements
    ]


def hilti_tilts(site: str) -> dict[str, Array]:
    """What base and column lean by their own sensors: (N, 2) about y and x [rad], in the rows'
    order."""
    rows = [measured for measured, _ in _hilti_rows(site)]
    return {
        part: np.array([row[f"tilt_sensor_{part}_accel"] for row in rows])[:, :2] / 9.80665
        for part in ("base", "column")
    }


@cache
def hilti(site: str) -> tuple[bathyal.Tracked, NDArray[np.bool_]]:
    """Prism positions of Hilti's column and arm, and which of them the site was stationed by."""
    taken = [
        (measured["joint_states"], measured["prism_position"], measured["time"], kind)
        for measured, kind in _hilti_rows(site)
    ]
    q, position, time, kind = zip(*taken, strict=True)
    data = bathyal.Tracked(q, position, covariates={"time": np.array(time) - min(time)})
    return data, np.array(kind) == "stationing_measurements"


def trailblazer() -> bathyal.Arm:
    """Hilti's column and arm as its file has it: two stages slide by half the column's travel."""
    return bathyal.Arm.from_urdf(_there(ARMS / "hilti-jaibot" / "trailblazer.urdf"), tip="prism")


def trailblazer_with_one_slide() -> bathyal.Arm:
    """The same with both stages, which slide along one line, as one joint that is the column's."""
    arm = trailblazer()
    table = arm.to_dh()
    assert list(table.joint_types[:2]) == ["prismatic", "prismatic"]
    assert table.a[0] == table.alpha[0] == table.beta[0] == table.theta[0] == 0.0
    columns = {name: np.array(getattr(table, name)[1:]) for name in ("theta", "a", "alpha", "beta")}
    one = bathyal.Arm.from_dh(
        **columns,
        d=table.d[1:],
        joint_types=list(table.joint_types[1:]),
        root=table.root,
        flange=table.flange,
        tool=arm.tool,
    )
    q = np.zeros(arm.size)
    shift = np.linalg.inv(arm.forward(q)) @ one.forward(q)
    assert np.allclose(shift[:3, :3], np.eye(3))
    return one
