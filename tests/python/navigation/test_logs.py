# SPDX-License-Identifier: BSD-3-Clause
"""Logs of real vehicles: dead reckoning, and the smoother between fixes a minute apart."""

import warnings
from pathlib import Path

import numpy as np
import pytest

import bathyal

LOGS = Path(__file__).parents[3] / "../shared/data/auvlogs"
needs_logs = pytest.mark.skipif(not LOGS.is_dir(), reason="../shared/data/auvlogs is not there")


def read(name: str) -> bathyal.NavigationLog:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bathyal.NavigationLogWarning)
        return bathyal.read_navigation_log(LOGS / f"{name}.csv")


def fix_rows(time: np.ndarray) -> list[int]:
    """One a minute, and the last."""
    return [*np.searchsorted(time, np.arange(0.0, time[-1], 60.0) - 1e-9), len(time) - 1]


def rms(error: np.ndarray) -> float:
    return float(np.sqrt((error**2).sum(axis=1).mean()))


@needs_logs
@pytest.mark.parametrize(
    ("name", "reckoned", "line", "bridged", "goal"),
    [
        ("20220719_6_1", 7.1, 6.1, 1.03, 1.0),
        ("20230517_0_0", 12.1, 5.6, 1.95, 1.5),
        ("20220712_0_1", 10.4, 12.5, 1.61, 1.3),
    ],
)
def test_the_smoother_against_the_logged_positions(
    name: str, reckoned: float, line: float, bridged: float, goal: float
) -> None:
    log = read(name)
    truth = log.position
    off = truth - truth[0] - log.dead_reckon()
    assert np.linalg.norm(off[-1]) == pytest.approx(reckoned, abs=0.05)
    rows = fix_rows(log.time)
    between = [np.interp(log.time, log.time[rows], truth[rows, axis]) for axis in (0, 1)]
    assert rms(truth - np.column_stack(between)) == pytest.approx(line, abs=0.06)
    bridge = [np.interp(log.time, log.time[rows], off[rows, axis]) for axis in (0, 1)]
    assert rms(off - np.column_stack(bridge)) == pytest.approx(bridged, abs=0.01)
    track = log.smooth(log.time[rows], truth[rows])
    assert track.accepted("fix").all()
    assert rms(track.fix_point[:, :2] - truth) <= goal


@needs_logs
@pytest.mark.parametrize("name", ["20220719_6_1", "20230517_0_0", "20220712_0_1"])
def test_positions_between_the_fixes_change_nothing(name: str) -> None:
    log = read(name)
    rows = fix_rows(log.time)
    fixes = log.position[rows]
    given = log.smooth(log.time[rows], fixes).fix_point
    log.position[:] = np.nan
    assert np.array_equal(log.smooth(log.time[rows], fixes).fix_point, given)


@needs_logs
def test_accelerations_that_are_differences_are_found() -> None:
    found = [read(name).accelerations_are_differences
             for name in ("20220719_6_1", "20220712_0_1", "20230517_0_0")]  # fmt: skip
    assert found == [True, True, False]


@needs_logs
def test_held_values_are_found() -> None:
    log = read("20230517_0_0")
    new = log.time[log.fresh]
    assert np.diff(np.append(new, log.time[-1])).max() == pytest.approx(16.085, abs=1e-3)


@needs_logs
def test_marks_are_masked_counted_and_warned_of() -> None:
    with pytest.warns(bathyal.NavigationLogWarning, match="3,847 of 8,476"):
        log = bathyal.read_navigation_log(LOGS / "20220625_0_0.csv")
    assert log.marked == 3847
    assert np.isnan(log.velocity).all(axis=1).sum() == 3847
    assert np.nanmin(log.velocity) > -20.0
    with pytest.raises(bathyal.Error, match="3847 marked invalid of 8476"):
        log.dead_reckon()


HEADER = "time,lat,lon,roll,pitch,yaw,vf,vl,vu"


def written(tmp_path: Path, *rows: str, header: str = HEADER) -> Path:
    path = tmp_path / "log.csv"
    path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    return path


def test_degrees_become_metres(tmp_path: Path) -> None:
    """By radii of curvature of WGS 84 at 49.5° N: 6 372.4 km along the meridian, 6 390.5 across."""
    path = written(tmp_path, "0,49.5,8,0,0,0,1,0,0",
                   f"1,{49.5 + 1 / 60!r},{8 + 1 / 60!r},0,0,0,1,0,0")  # fmt: skip
    position = bathyal.read_navigation_log(path).position
    assert position[1] == pytest.approx([1206.87, 1853.78], abs=0.05)


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        (["0,49,8,0,0,0,1,0,0", "0,49,8,0,0,0,1,0,0"], "time"),
        (["0,49,8,0,0,0,1,0,0"], "time"),
        (["0,49,8,0,0,0,1,0,0", "1,49,8,0,0,0,x,0,0"], "vf"),
        (["0,49,8,0,0,0,1,0,0", "1,49,8,0,0,nan,1,0,0"], "yaw"),
    ],
)
def test_broken_logs_are_refused(tmp_path: Path, rows: list[str], said: str) -> None:
    with pytest.raises(bathyal.Error, match=said):
        bathyal.read_navigation_log(written(tmp_path, *rows))


def test_a_column_that_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(bathyal.Error, match="lat"):
        bathyal.read_navigation_log(written(tmp_path, "0,1", "1,1", header="time,lon"))


def test_the_smoother_refuses_bad_input() -> None:
    time, yaw, log = [0.0, 1.0], [0.0, 0.0], np.zeros((2, 3))
    with pytest.raises(ValueError, match="fix_time"):
        bathyal.smooth(time, yaw, log, [2.0], [[0, 0, 0]])
    with pytest.raises(ValueError, match="fix_position"):
        bathyal.smooth(time, yaw, log, [0.5], [[0, 0, np.nan]])
    with pytest.raises(ValueError, match="fix_noise"):
        bathyal.smooth(time, yaw, log, [0.5], [[0, 0, 0]], fix_noise=0.0)
    with pytest.raises(ValueError, match="velocity"):
        bathyal.smooth(time, yaw, np.zeros((3, 3)), [0.5], [[0, 0, 0]])
    with pytest.raises(ValueError, match="time"):
        bathyal.smooth([0.0, 0.0], yaw, log, [0.0], [[0, 0, 0]])
    with pytest.raises(ValueError, match="sextant"):
        bathyal.smooth(time, yaw, log, [0.5], [[0, 0, 0]], sextant=1.0)
