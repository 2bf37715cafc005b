# SPDX-License-Identifier: BSD-3-Clause
"""The table of docs/real_and_simulated.md, computed anew."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal.sonar.describe import fit_altitude

ROOT = Path(__file__).parents[3]
REAL = ROOT.parent / "shared" / "data" / "sidescan" / "scotsman-iver2.xtf"


@pytest.fixture(scope="module")
def script():
    sys.path.insert(0, str(ROOT / "docs"))
    yield runpy.run_path(str(ROOT / "docs" / "real_and_simulated.py"))
    sys.path.pop(0)


@pytest.mark.skipif(not REAL.exists(), reason=f"the measured side-scan is not at {REAL}")
def test_the_table_of_differences(script) -> None:
    measured = bathyal.read_sonar(REAL)
    simulated = script["sonar"](measured).survey(script["sea"](), script["track"](measured))
    one, two = measured.statistics(), simulated.statistics()
    wide = one.angle > np.radians(10)
    off = [found.level_by_angle - np.nanmedian(found.level_by_angle) for found in (one, two)]
    rms = np.sqrt(np.nanmean((off[0] - off[1])[:, wide] ** 2, axis=1))
    assert rms == pytest.approx([1.7, 2.3], abs=0.1)
    water = [found.water_level - np.nanmedian(found.level_by_angle) for found in (one, two)]
    assert water[0] == pytest.approx([-31.5, -29.4], abs=1)
    assert water[1] == pytest.approx(-75.0, abs=1)
    assert one.contrast == pytest.approx([0.40, 0.44], abs=0.01)
    assert two.contrast == pytest.approx(0.525, abs=0.015)
    assert one.correlation_range == pytest.approx([0.22, 0.28], abs=0.01)
    assert one.correlation_ping == pytest.approx([0.10, 0.19], abs=0.01)
    assert two.correlation_ping == pytest.approx(0.0, abs=0.03)
    assert one.saturated == pytest.approx([0.021, 0.032], abs=0.001)
    pitch_alone = fit_altitude(simulated.track_bottom().altitude, simulated.navigation.altitude)
    assert pitch_alone.slope == pytest.approx(1.10, abs=0.02)
