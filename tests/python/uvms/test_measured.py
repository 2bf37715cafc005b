# SPDX-License-Identifier: BSD-3-Clause
"""A real vehicle that its moving arm swings."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support import uvms_runs
from tests.support.uvms_runs import about_mean

pytestmark = pytest.mark.skipif(not uvms_runs.there(), reason="uvms of the shared data is not here")


def test_vehicle_answers_its_arm_as_measured() -> None:
    """On 13 runs that the four numbers of the hull were not fitted to."""
    names = [n for n in uvms_runs.names() if n not in uvms_runs.FITTED and n.startswith("traj")]
    assert len(names) == 13
    pitch, roll = [], []
    for name in names:
        run = uvms_runs.run(name)
        simulated_roll, simulated_pitch = uvms_runs.simulated(name, uvms_runs.NUMBERS)
        pitch.append(about_mean(simulated_pitch) - about_mean(run.pitch))
        roll.append(about_mean(simulated_roll) - about_mean(run.roll))
    assert np.degrees(np.std(np.concatenate(pitch))) < 0.55  # the arm's static moment: 0.63
    assert np.degrees(np.std(np.concatenate(roll))) < 0.65  # 0.88
