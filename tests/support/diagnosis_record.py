# SPDX-License-Identifier: BSD-3-Clause
"""The record from which diagnoses of bad input start: an arm of three joints whose second encoder
is eccentric, seen by a tracker.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import bathyal
from bathyal import Tracked

N = 90
NAN = float("nan")
TIME = 10.0 * np.arange(N)
COS, ORDER = 1e-3, 2.0  # [rad] of the harmonic along joint 2


def three_joints() -> bathyal.Arm:
    arm = bathyal.Arm.from_dh(
        a=[0, 0.4, 0.3], alpha=[np.pi / 2, 0, 0], d=[0.3, 0, 0], theta=[0, 0, 0]
    )
    tool = np.eye(4)
    tool[:3, 3] = 0.05, 0.02, 0.1
    arm.tool = tool
    return arm


ARM = three_joints()


def record(rows: int = N, noise: float = 5e-5, size: float = COS) -> tuple[Any, Any]:
    random = np.random.default_rng(1)
    q = random.uniform(-2, 2, (rows, 3))
    wrong = q.copy()
    wrong[:, 1] += size * np.cos(ORDER * q[:, 1])
    return q, ARM.forward(wrong)[:, :3, 3] + random.normal(0, noise, (rows, 3))


Q, P = record()


def diagnosed(q: Any = Q, position: Any = P, *, options: Any = None, **more: Any) -> Any:
    return bathyal.diagnose(ARM, Tracked(q, position, **more), **(options or {}))


def some(values: Any, rows: int = 30) -> Any:
    """Without the numbers of the first rows."""
    values = np.array(values, float)
    values[:rows] = NAN
    return values


def is_right(report: Any) -> None:
    assert report.verdict == "named"
    assert [(e.name, e.joint) for e in report.effects] == [("joint_harmonic", 1)]
    low, high = report.effects[0].parameters["cos"].interval
    assert low < COS < high


def refuses(body: Callable[[], Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        body()
