# SPDX-License-Identifier: BSD-3-Clause
"""A slip between two sessions is a tool that was changed: the two are reported as ambiguous."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal

_NOISE = 5e-5


@pytest.mark.parametrize("size", [0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize(("rows", "boundary"), [(180, 90), (900, 431)])
def test_a_slip_at_the_boundary_of_two_sessions(rows: int, boundary: int, size: float) -> None:
    rng = np.random.default_rng(int(10 * size) + rows)
    arm = bathyal.arms.ur10()
    q = rng.uniform(-1.5, 1.5, (rows, 6))
    pose = arm.forward(q)
    after = (np.arange(rows) >= boundary).astype(float)
    direction = rng.normal(size=3)
    direction *= 2 * np.sqrt(3) * size * _NOISE / np.linalg.norm(direction)  # half is absorbed
    tips = pose[:, :3, 3] + (pose[:, :3, :3] @ direction) * after[:, None]
    data = bathyal.Tracked(q, tips + rng.normal(0, _NOISE, tips.shape), session=after)
    report = bathyal.diagnose(arm, data)
    assert report.verdict == "ambiguous"
    assert len(report.effects) == 1
    assert {"tool_change", "tool_slip"} <= {cause.name for cause in report.ambiguous}
    [slip] = [cause for cause in report.ambiguous if cause.name == "tool_slip"]
    assert f"row {boundary}" in slip.words


def test_where_poses_cannot_tell_the_base_is_among_the_causes() -> None:
    """All poses have the same orientation of the tool: a shift of it is one of the base."""
    rng = np.random.default_rng(3)
    h = np.pi / 2
    gantry = bathyal.Arm.from_dh(
        a=[0, 0, 0],
        alpha=[-h, h, 0],
        d=[0.4, 0.4, 0.4],
        theta=[0, h, 0],
        joint_types=["prismatic"] * 3,
    )
    q = rng.uniform(-0.3, 0.3, (120, 3))
    after = (np.arange(120) >= 60).astype(float)
    tips = gantry.forward(q)[:, :3, 3] + after[:, None] * [3e-4, -2e-4, 1e-4]
    data = bathyal.Tracked(q, tips + rng.normal(0, _NOISE, tips.shape), session=after)
    report = bathyal.diagnose(gantry, data)
    assert report.verdict == "ambiguous"
    causes = {cause.name for cause in report.ambiguous}
    assert {"tool_change", "tool_slip", "base_shift"} <= causes
