# SPDX-License-Identifier: BSD-3-Clause
"""How a vehicle with an arm hangs in the water, and how a real one did."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support import uvms_runs


def hanging(**body: object) -> bathyal.Workspace:
    """An arm that reaches 0.9 m along x, 0.1 kg at its tip, under a vehicle of 20 kg."""
    arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    given = {"center_of_mass": (0, 0, -0.02), "volume": 20 / 1025} | body
    vehicle = bathyal.RigidBody(20.0, **given)  # type: ignore[arg-type]
    return bathyal.Workspace(arm, radii=0.05, vehicle_body=vehicle).attach(
        [], bathyal.RigidBody(0.1)
    )


def test_pendulum_by_hand_with_its_signs() -> None:
    trim = hanging().static_trim([[0, 0], [np.pi, 0], [-np.pi / 2, 0], [np.pi / 2, 0]])
    angle = np.arctan(0.1 * 0.9 / (20 * 0.02))
    np.testing.assert_allclose(trim.pitch, [angle, -angle, 0, 0], atol=1e-12)  # forward: nose down
    np.testing.assert_allclose(trim.roll, [0, 0, angle, -angle], atol=1e-12)
    assert trim.status.tolist() == ["upright"] * 4
    np.testing.assert_allclose(trim.buoyancy, -0.1 * 9.80665, atol=1e-9)


def test_one_posture_gives_numbers() -> None:
    trim = hanging().static_trim([0, 0])
    assert isinstance(trim.pitch, float)
    assert trim.status == "upright"
    assert trim.righting == pytest.approx(9.80665 * np.hypot(0.09, 0.4))
    over = hanging(center_of_mass=(0, 0, 0.02)).static_trim([0, 0])
    assert over.status == "turned_over"
    assert abs(over.roll) == pytest.approx(np.pi)


def test_refusals() -> None:
    arm = bathyal.arms.panda()
    with pytest.raises(ValueError, match=r"`vehicle_body`: expected .* got none"):
        bathyal.Workspace(arm, radii=0.05).static_trim(np.zeros(7))
    with pytest.raises(ValueError, match="`vehicle_body`: expected a mass and a volume"):
        hanging(volume=0).static_trim([0, 0])
    with pytest.raises(ValueError, match="`water_density`: expected"):
        hanging().static_trim([0, 0], water_density=0)


@pytest.mark.skipif(not uvms_runs.there(), reason="shared/data/uvms is not here")
def test_a_free_vehicle_answers_its_arm_as_predicted() -> None:
    """Hull estimated on two runs, swings predicted on five others."""
    hull = uvms_runs.fit_hull([uvms_runs.run("traj003-0"), uvms_runs.run("traj030-0")])
    assert np.abs(hull - uvms_runs.AUTHORS_HULL).max() < 0.1
    ws = uvms_runs.workspace(hull)
    for name in ["traj004-0", "traj005-2", "traj012-1", "traj012-2", "traj006-1"]:
        run = uvms_runs.run(name)
        trim = ws.static_trim(run.q, water_density=uvms_runs.WATER)
        for measured, predicted in [(run.pitch, trim.pitch), (run.roll, trim.roll)]:
            if np.ptp(measured) < np.radians(4):
                continue
            assert np.ptp(predicted) == pytest.approx(np.ptp(measured), rel=0.15)
            assert np.corrcoef(measured, predicted)[0, 1] > 0.98
            assert np.degrees(np.sqrt(np.mean((measured - predicted) ** 2))) < 1.0
