# SPDX-License-Identifier: BSD-3-Clause
"""Touches and tracked poses that cannot be taken: refused with the argument's name and the way out.

URDFs that are none are in test_urdf_refusals.py; data that can be taken but determine too little,
in test_identify_warnings.py.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bathyal
from tests.support.touch_cases import drawn, touched

Q = [[0.1, 0.2], [0.3, -0.4], [0.5, 0.6]]
NAN = float("nan")

TOUCHES: dict[str, tuple[Any, Any, dict[str, Any], str]] = {
    "degrees": ([[90.0, 0.0], [45.0, 1.0]], [0, 0], {}, r"`q`: expected radians .*`q_deg`.*90"),
    "nan": ([[0.1, NAN], [0.3, 0.4]], [0, 0], {}, "`q`: expected finite numbers, got nan at row 0"),
    "inf": (
        [[0.1, np.inf], [0.3, 0.4]],
        [0, 0],
        {},
        "`q`: expected finite .*inf at row 0, joint 1",
    ),
    "nan_degrees": (None, [0, 0], {"q_deg": [[1, NAN], [2, 3]]}, "finite numbers"),
    "no_rows": (np.empty((0, 2)), [], {}, r"`q`: expected at least one row .*shape \(0, 2\)"),
    "no_joints": (np.empty((3, 0)), [0, 0, 0], {}, "`q`: expected"),
    "flat": ([0.1, 0.2], [0, 0], {}, r"`q`: expected real numbers of shape \(N, n\)"),
    "words": ([["a", "b"]], [0], {}, "`q`: expected"),
    "nothing": (None, [0], {}, "`q`: expected joint values, .* got neither"),
    "twice": (Q, [0, 0, 0], {"q_deg": Q}, "`q`: expected joint values, .* got both"),
    "equal_poses": ([[0.1, 0.2]] * 5, [0] * 5, {}, "`q`: expected poses that differ, got 5 rows"),
    "no_points": (Q, None, {}, "`point`: expected 3 rows"),
    "few_points": (Q, [0, 0], {}, "`point`: expected 3 rows, as many as `q`, got 2 rows"),
    "half_label": (Q, [0, 0.5, 1], {}, "`point`: expected whole numbers, got 0.5 at row 1"),
    "nan_label": (Q, [0, NAN, 1], {}, "`point`: expected"),
    "one_pose_each": (Q, [0, 1, 2], {}, "`point`: expected a point that is touched in two poses"),
    "weight_zero": (Q, [0, 0, 0], {"weights": [1, 0, 1]}, "`weights`: expected .* above 0"),
    "weight_nan": (Q, [0, 0, 0], {"weights": [1, NAN, 1]}, "`weights`: expected"),
    "few_weights": (Q, [0, 0, 0], {"weights": [1]}, "`weights`: expected 3 rows"),
    "tool_gap": (Q, [0, 0, 0], {"tool": [0, 2, 0]}, "`tool`: expected numbers that count from 0"),
    "station_gap": (Q, [0, 0, 0], {"station": [1, 1, 1]}, "`station`: expected numbers that count"),
    "unknown_pair": (
        Q,
        [0, 0, 0],
        {"known_distances": {(0, 7): 0.1}},
        "`known_distances`: expected labels that occur in `point`, got 7",
    ),
    "pair_of_one": (
        Q,
        [0, 0, 0],
        {"known_distances": {(0, 0): 0.1}},
        "`known_distances`: expected two",
    ),
    "distance_zero": (
        Q,
        [0, 0, 1],
        {"known_distances": {(0, 1): 0.0}},
        "`known_distances`: expected",
    ),
    "distance_nan": (
        Q,
        [0, 0, 1],
        {"known_distances": {(0, 1): NAN}},
        "`known_distances`: expected",
    ),
    "distance_std": (Q, [0, 0, 1], {"distance_std": 0.0}, "`distance_std`: expected"),
    "unknown_point": (
        Q,
        [0, 0, 0],
        {"known_points": {3: (0, 0, 0)}},
        "`known_points`: expected labels",
    ),
    "point_nan": (
        Q,
        [0, 0, 0],
        {"known_points": {0: (0, NAN, 0)}},
        "`known_points`: expected three finite",
    ),
    "small_plane": (
        Q,
        [0, 0, 0],
        {"planes": {"deck": [0, 1, 2]}},
        "`planes deck`: expected four rows",
    ),
    "covariate": (
        Q,
        [0, 0, 0],
        {"covariates": {"load": [1, 2]}},
        "`covariates load`: expected 3 rows",
    ),
}


@pytest.mark.parametrize("case", TOUCHES)
def test_touches_that_are_none(case: str) -> None:
    q, point, more, message = TOUCHES[case]
    with pytest.raises(ValueError, match=message):
        bathyal.Touches(q, point, **more)


X = [[1.0, 0.0, 0.0], [1.1, 0.1, 0.0], [1.2, 0.0, 0.1]]
TRACKED: dict[str, tuple[Any, Any, dict[str, Any], str]] = {
    "degrees": ([[90.0, 0.0], [45.0, 1.0], [0.0, 0.0]], X, {}, "`q`: expected radians .*`q_deg`"),
    "nan_position": (Q, [*X[:2], [NAN, 0, 0]], {}, "`position`: expected finite numbers"),
    "few_positions": (Q, X[:2], {}, "`position`: expected 3 rows"),
    "flat_positions": (Q, np.array(X)[:, :2], {}, "`position`: expected"),
    "one_pose": (Q[:1], X[:1], {}, "`q`: expected two poses or more"),
    "equal_poses": ([Q[0]] * 3, X, {}, "`q`: expected poses that differ"),
    "neither": (Q, None, {}, "`position`: expected what was measured"),
    "not_a_rotation": (
        Q,
        None,
        {"pose": [np.diag([2.0, 1, 1, 1])] * 3},
        "`pose`: expected",
    ),
}


@pytest.mark.parametrize("case", TRACKED)
def test_tracked_poses_that_are_none(case: str) -> None:
    q, position, more, message = TRACKED[case]
    with pytest.raises(ValueError, match=message):
        bathyal.Tracked(q, position, **more)


def test_degrees_are_taken_by_their_name() -> None:
    touches = bathyal.Touches(q_deg=[[90.0, 0.0], [45.0, 1.0]], point=[0, 0])
    np.testing.assert_allclose(touches.q[0], [np.pi / 2, 0.0], atol=1e-15)


def test_degrees_in_a_file_name_the_unit(tmp_path: Path) -> None:
    file = tmp_path / "touches.csv"
    file.write_text("point;q1;q2\n0;90;0\n0;45;10\n0;30;20\n")
    with pytest.raises(ValueError, match='unit="deg"'):
        bathyal.read_touches(file, unit="rad")
    assert bathyal.read_touches(file, unit="deg").q.max() == pytest.approx(np.pi / 2)


def test_joints_without_a_unit_are_refused_with_the_option_that_gives_it(tmp_path: Path) -> None:
    file = tmp_path / "touches.csv"
    file.write_text("point;q1;q2\n0;1;0\n0;0.5;0.1\n0;0.3;0.2\n")
    with pytest.raises(bathyal.Error, match=r'`q1`: expected a unit among .*; unit="rad" or unit='):
        bathyal.read_touches(file)


def test_the_option_for_joints_is_no_remedy_for_other_columns(tmp_path: Path) -> None:
    file = tmp_path / "touches.csv"
    file.write_text("point;q1_rad;q2_rad;payload_m\n0;1;0;1\n0;0.5;0.1;1\n0;0.3;0.2;1\n")
    with pytest.raises(bathyal.Error, match="expected a unit among kg") as caught:
        bathyal.read_touches(file)
    assert "unit=" not in str(caught.value)


def test_another_number_of_joints_is_refused_with_the_arms_name() -> None:
    data = touched(1, 5)
    with pytest.raises(ValueError, match="`q`: expected 7 columns, the joints of Panda, got 6"):
        bathyal.identify_arm(bathyal.arms.panda(), data.touches())


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"length_prior": -1e-3}, "`length_prior`: expected"),
        ({"priors": {"d_9": 1e-3}}, "`priors`: expected names of parameters"),
        ({"fixed": ["elbow"]}, "`fixed`: expected names of parameters"),
        ({"noise": NAN}, "`noise`: expected"),
        ({"max_iterations": 0}, "`max_iterations`: expected"),
        ({"base": "free"}, "`base`: expected"),
        ({"loss": "soft"}, "`loss`: expected"),
    ],
)
def test_options_that_make_no_sense(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        bathyal.identify_arm(drawn(), touched(1, 5).touches(), **options)
