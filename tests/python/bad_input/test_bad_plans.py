# SPDX-License-Identifier: BSD-3-Clause
"""Aims and settings of paths that are wrong or odd, each case in a process of its own."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import bathyal
from tests.support.alone import Case, check, refused, works
from tests.support.bad_input import ANY, FAR, TWO, bottom, down, same, scene


def ten_thousand_aims() -> None:
    t = np.linspace(0.0, 1.0, 10_000)
    aims = np.column_stack(
        [0.5 + 4 * t, 2.2 + 1.7 * np.sin(40 * t), 5 + 0 * t, 0 * t, 0 * t, 0 * t - 1]
    )
    path = bathyal.plan_toolpath(scene(), aims)
    assert len(path.targets) == 10_000
    assert not path.gap.any()
    assert np.isfinite(path.position).all()


def missing_targets_are_reported() -> None:
    targets = bathyal.find_targets(scene(), [*TWO, down(100, 100)])
    assert targets.status.tolist() == ["hit", "hit", "miss"]
    assert np.isnan(targets.point[2]).all()


def one_aim() -> None:
    path = bathyal.plan_toolpath(scene(), TWO[:1])
    assert np.isfinite(path.position).all()
    same(path.arc_length[-1], 0.0)


CASES: list[Case] = [
    works("plan: 10 000 aims", ten_thousand_aims),
    works("plan: one aim", one_aim),
    works(
        "plan: 1e7 m away",
        lambda: same(
            np.isfinite(
                bathyal.plan_toolpath(scene(FAR), np.add(TWO, [FAR, FAR, FAR, 0, 0, 0])).position
            ).all(),
            True,
        ),
    ),
    works(
        "find_targets: no aims",
        lambda: same(len(bathyal.find_targets(scene(), np.zeros((0, 6)))), 0),
    ),
    works("find_targets: one that misses", missing_targets_are_reported),
    refused("plan: no aims", "aims", lambda: bathyal.plan_toolpath(scene(), np.zeros((0, 6)))),
    refused(
        "plan: nothing hit",
        "aims",
        lambda: bathyal.plan_toolpath(scene(), [down(99, 99), down(98, 99)]),
        ANY,
    ),
    refused(
        "plan: five columns", "aims", lambda: bathyal.plan_toolpath(scene(), [[0, 0, 5, 0, 0]])
    ),
    refused(
        "plan: a zero direction",
        "aims",
        lambda: bathyal.plan_toolpath(scene(), [[1, 1, 5, 0, 0, 0]]),
    ),
    refused(
        "plan: a NaN aim",
        "aims",
        lambda: bathyal.plan_toolpath(scene(), [[1, math.nan, 5, 0, 0, -1]]),
    ),
    refused(
        "plan: a mesh for a scene", "surface", lambda: bathyal.plan_toolpath(bottom(), TWO), ANY
    ),
    refused("plan: speed of 0", "speed", lambda: bathyal.plan_toolpath(scene(), TWO, speed=0.0)),
    refused(
        "plan: speed below 0", "speed", lambda: bathyal.plan_toolpath(scene(), TWO, speed=-1.0)
    ),
    refused(
        "plan: acceleration NaN",
        "acceleration",
        lambda: bathyal.plan_toolpath(scene(), TWO, acceleration=math.nan),
    ),
    refused("plan: step below 0", "step", lambda: bathyal.plan_toolpath(scene(), TWO, step=-0.1)),
    refused(
        "plan: standoff infinite",
        "standoff",
        lambda: bathyal.plan_toolpath(scene(), TWO, standoff=math.inf),
    ),
    refused(
        "plan: angular rate of 0",
        "angular_rate",
        lambda: bathyal.plan_toolpath(scene(), TWO, angular_rate=0.0),
    ),
    refused(
        "plan: an unknown orientation",
        "orientation",
        lambda: bathyal.plan_toolpath(scene(), TWO, orientation="up"),
    ),
    refused(
        "plan: an unknown vertical",
        "vertical",
        lambda: bathyal.plan_toolpath(scene(), TWO, vertical="north"),
    ),
    refused(
        "plan: a pose that is none",
        "world_from_vehicle",
        lambda: bathyal.plan_toolpath(scene(), TWO, world_from_vehicle=np.ones((4, 4))),
    ),
    refused(
        "plan: a pose of the wrong shape",
        "world_from_vehicle",
        lambda: bathyal.plan_toolpath(scene(), TWO, world_from_vehicle=np.eye(3)),
    ),
    refused(
        "cover: two corners",
        "polygon",
        lambda: bathyal.cover_polygon(scene(), [[0, 0], [1, 1]], 0.5),
    ),
    refused(
        "cover: a polygon that crosses itself",
        "polygon",
        lambda: bathyal.cover_polygon(scene(), [[0, 0], [2, 2], [2, 0], [0, 2]], 0.5),
    ),
    refused(
        "cover: a spacing of 0",
        "spacing",
        lambda: bathyal.cover_polygon(scene(), [[0, 0], [2, 0], [2, 2]], 0.0),
    ),
    refused(
        "cover: a spacing of a micrometre",
        "spacing",
        lambda: bathyal.cover_polygon(scene(), [[0, 0], [5, 0], [5, 5]], 1e-9),
    ),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_bad_input(case: Case, tmp_path: Path) -> None:
    check(case, tmp_path)
