# SPDX-License-Identifier: BSD-3-Clause
"""What a sonar hears along the way of a run, as XTF."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal

LEG = """\
world:
  water: {surface: 0}
  terrain: {seabed: {size: [60, 60], spacing: 0.5, depth: 12, relief_rms: 0.4}}
vehicle: {preset: bluerov2_heavy}
start: {position: [-8, 0, -5]}
mission: [leg: {to: [8, 0], depth: 5 m, speed: 1 m/s}]
"""


def test_pings_along_a_run_are_written_as_xtf(tmp_path):
    path = tmp_path / "mission.yaml"
    path.write_text(LEG)
    mission = bathyal.read_mission(path)
    log = bathyal.run(mission, seed=1).log
    truth = log.messages("/truth")
    track = bathyal.Trajectory(truth["time"], log.poses("/truth"))
    sonar = bathyal.sonars.side_scan_100khz()
    record = sonar.survey(mission.world, track, seed=1, count=5)
    record.write(tmp_path / "run.xtf")
    again = bathyal.read_sonar(tmp_path / "run.xtf")
    assert again.intensity.shape == record.intensity.shape
    where = np.interp(record.time, truth["time"], truth["pose.position.x"])
    assert again.navigation.position[:, 0] == pytest.approx(where, abs=0.01)
    assert again.navigation.position[:, 1] == pytest.approx(
        np.interp(record.time, truth["time"], truth["pose.position.y"]), abs=0.01
    )
    assert np.nanmax(again.intensity) > 0
