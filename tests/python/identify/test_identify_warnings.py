# SPDX-License-Identifier: BSD-3-Clause
"""Data that can be taken but tell too little, or something else than they seem to: the fit says so,
in words that name the cause and the way out, and is silent where all is well."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal
from tests.support.touch_cases import DATA, POINTS, Touched, built, distances, drawn, touched

TOLD = distances((0, 1))
ALL_TOLD = distances((0, 1), (1, 2), (0, 2))


def fit_of(data: Touched, **more: Any) -> bathyal.ArmFit:
    return bathyal.identify_arm(drawn(), data.touches(known_distances=TOLD, **more))


def warning(fit: bathyal.ArmFit, words: str) -> str:
    """The one warning with these words."""
    found = [text for text in fit.warnings if words in text]
    assert len(found) == 1, fit.warnings
    return str(found[0])


def swapped(data: Touched, rows: Any, label: int) -> Touched:
    point = data.point.copy()
    point[rows] = label
    return Touched(data.q, point)


# Nothing to say -----------------------------------------------------------------------------------


def test_good_touches_are_not_doubted() -> None:
    said = [fit_of(touched(draw=draw)) for draw in range(40)]
    assert sum(bool(fit.warnings) for fit in said) <= 2
    assert sum(bool(fit.outliers) for fit in said) <= 1
    assert "No check raised a warning" in said[0].summary()


def test_the_chance_of_structure_is_evenly_spread_over_noise() -> None:
    p = np.sort([fit_of(touched(draw=draw)).structure_p for draw in range(120)])
    apart = np.abs(p - (np.arange(120) + 0.5) / 120).max()
    assert apart < 1.63 / np.sqrt(120)  # Kolmogorov and Smirnov, one chance in a hundred
    assert p[0] > 1e-4


def test_plain_dh_near_parallel_axes_shows_no_structure() -> None:
    fit = fit_of(touched())
    plain = bathyal.identify_arm(
        drawn(), touched().touches(known_distances=TOLD), parametrization="dh"
    )
    assert plain.structure_p == pytest.approx(fit.structure_p, abs=0.3)


def test_nothing_unknown_is_nothing_to_warn_of() -> None:
    data = touched().touches(known_distances=TOLD)
    names = [p.name for p in bathyal.identify_arm(drawn(), data).parameters]
    fit = bathyal.identify_arm(drawn(), data, fixed=names)
    assert fit.outliers == []
    assert fit.structure_p == 1.0


# Size ---------------------------------------------------------------------------------------------


def test_undetermined_scale_names_the_prior_and_what_to_measure() -> None:
    fit = bathyal.identify_arm(drawn(), touched().touches())
    text = warning(fit, "No measurement determines the scale")
    assert "prior on lengths (1 mm)" in text
    assert "a smaller rms proves nothing" in text
    assert "known_distances" in text
    assert f"{1e3 * np.linalg.norm(fit.points[0] - fit.points[1]):.3g} mm from 0 to 1" in text


def test_points_that_have_names_are_called_by_them() -> None:
    names = {0: "left", 1: "right"}
    fit = bathyal.identify_arm(drawn(), touched().touches(names=names))
    text = warning(fit, "No measurement determines the scale")
    assert "mm from left to right" in text
    assert "mm from right to 2" in text
    fit = bathyal.identify_arm(drawn(), touched(off={7: 0.05}).touches(names=names))
    assert "row 7 (point left, 50" in warning(fit, "One row lies far")


def test_loose_prior_on_the_size_is_reported() -> None:
    fit = bathyal.identify_arm(drawn(), touched().touches(), length_prior=0.1)
    assert "length_prior" in warning(
        fit, "times its nominal size with lengths constrained to 100 mm only"
    )


def test_wrong_distance_stretches_the_arm_and_is_reported() -> None:
    data = touched()
    fit = bathyal.identify_arm(drawn(), data.touches(known_distances={(0, 1): 0.5}))
    assert "no maker misses by so much" in warning(fit, "By the known distance the arm is 0.6")
    assert "from 0 to 1 given as 500 mm" in warning(fit, "contradict the given lengths")


def test_one_wrong_distance_of_three_is_named() -> None:
    told = {**ALL_TOLD, (0, 1): ALL_TOLD[0, 1] + 0.05}
    fit = bathyal.identify_arm(drawn(), touched().touches(known_distances=told))
    text = warning(fit, "contradict the given lengths")
    assert "from 0 to 1" in text
    assert "from 1 to 2" not in text
    assert "swapped" not in text


# Rows and labels ----------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [1, 3, 6, 12])
def test_outliers_are_named_by_row_and_nothing_else_is(count: int) -> None:
    rows = np.random.default_rng(count).choice(63, count, replace=False)
    data = touched(draw=count, off={int(row): 0.05 for row in rows})
    fit = fit_of(data)
    assert [o.row for o in fit.outliers] == sorted(rows)
    assert all(o.distance == pytest.approx(0.05, abs=2e-3) for o in fit.outliers)
    assert all(o.point == data.point[o.row] and o.fits is None for o in fit.outliers)
    assert len(fit.warnings) == 1
    assert f"{min(rows)} (point {data.point[min(rows)]}, " in warning(
        fit, "far from where the others"
    )


def test_an_outlier_among_exact_touches_is_named_alone() -> None:
    assert not fit_of(touched(noise=0)).warnings
    fit = fit_of(touched(noise=0, off={4: 0.05}))
    assert [o.row for o in fit.outliers] == [4]
    assert fit.outliers[0].distance == pytest.approx(0.05, rel=1e-3)


def test_outliers_are_named_at_a_robust_loss_too() -> None:
    fit = bathyal.identify_arm(
        drawn(), touched(off={5: 0.05, 40: 0.05}).touches(known_distances=TOLD), loss="cauchy"
    )
    assert [o.row for o in fit.outliers] == [5, 40]
    assert "robust loss bounds their influence" in warning(fit, "far from where the others")


def test_an_outlier_among_tracked_positions_is_named() -> None:
    q, position = tracked()
    position[7, 0] += 0.05
    fit = bathyal.identify_arm(drawn(), bathyal.Tracked(q, position))
    assert [(o.row, o.point) for o in fit.outliers] == [(7, -1)]
    assert fit.outliers[0].distance == pytest.approx(0.05, abs=1e-3)


@pytest.mark.parametrize("count", [1, 4, 10])
def test_swapped_labels_are_named_with_where_they_fit(count: int) -> None:
    good = touched()
    first, second = np.arange(count), 21 + np.arange(count)
    bad = swapped(swapped(good, first, 1), second, 0)
    fit = bathyal.identify_arm(drawn(), bad.touches())
    assert {(o.row, o.point, o.fits) for o in fit.outliers} == {
        *((row, 1, 0) for row in first),
        *((row, 0, 1) for row in second),
    }
    assert "Correct the labels" in warning(fit, "Labels look swapped")


@pytest.mark.parametrize("known", ["distances", "points"])
def test_two_points_swapped_throughout_are_named_by_what_was_given(known: str) -> None:
    good = touched()
    bad = Touched(good.q, np.array([1, 0, 2])[good.point])
    told = (
        {"known_distances": ALL_TOLD}
        if known == "distances"
        else {"known_points": dict(enumerate(POINTS))}
    )
    assert not bathyal.identify_arm(drawn(), good.touches(**told)).warnings
    fit = bathyal.identify_arm(drawn(), bad.touches(**told))
    assert "points 0 and 1 agree with it: their labels look swapped" in warning(fit, "contradict")


# Other machines -----------------------------------------------------------------------------------


def other(change: str) -> bathyal.ArmFit:
    data = touched()
    q = data.q.copy()
    arm = drawn()
    if change == "arm":
        arm = bathyal.arms.gen3_lite()
    elif change == "order":
        q[:, [1, 2]] = q[:, [2, 1]]
    elif change == "sign":
        q[:, 3] *= -1
    elif change == "labels":
        data = Touched(q, np.random.default_rng(0).integers(0, 3, 63))
    return bathyal.identify_arm(arm, Touched(q, data.point).touches())


@pytest.mark.parametrize("change", ["arm", "order", "sign", "labels"])
def test_data_of_another_machine_are_reported(change: str) -> None:
    fit = other(change)
    assert "use none of these numbers" in warning(fit, "look like different machines")
    assert fit.outliers == []


def test_positions_in_another_unit_are_reported() -> None:
    q, position = tracked()
    fit = bathyal.identify_arm(drawn(), bathyal.Tracked(q, 1e3 * position))
    assert "units" in warning(fit, "look like different machines")


def test_the_arms_older_model_is_recognised_by_its_parameters() -> None:
    fit = bathyal.identify_arm(bathyal.arms.ur10(), touched().touches(known_distances=ALL_TOLD))
    assert "type and generation" in warning(fit, "Farther from nominal")


def test_folded_arm_is_not_sold_as_a_good_fit() -> None:
    fit = other("order")
    assert fit.rms_after < 1e-6  # the trap: a folded arm agrees with everything
    assert "Use none of these numbers" in warning(fit, "no arm is built so far from its drawing")


# Too little ---------------------------------------------------------------------------------------


def test_fewer_touches_than_unknowns() -> None:
    data = touched()
    rows = [0, 1, 2, 21, 22, 23, 42, 43]
    fit = bathyal.identify_arm(drawn(), Touched(data.q[rows], data.point[rows]).touches())
    assert "15 equations from 8 touches" in warning(fit, "Fewer equations than unknowns")
    assert "do not determine the noise" in warning(fit, "As many unknowns as equations")


def test_few_degrees_of_freedom() -> None:
    data = touched()
    rows = [*range(4), *range(21, 25), *range(42, 45)]
    fit = bathyal.identify_arm(drawn(), Touched(data.q[rows], data.point[rows]).touches())
    assert "rough guess" in warning(fit, "more than unknowns")


def test_one_point() -> None:
    fit = bathyal.identify_arm(drawn(), touched(1, 21).touches())
    assert "Touch two points more" in warning(fit, "of one point")


def test_one_pose_for_a_point_tells_nothing_of_it() -> None:
    data = touched()
    fit = bathyal.identify_arm(drawn(), Touched(data.q[:43], data.point[:43]).touches())
    assert "Point 2 was touched in one pose" in warning(fit, "gives no information")


def test_joint_that_never_moves_is_named_and_its_parameters_are_not_found() -> None:
    q, position = tracked(still=2)
    fit = bathyal.identify_arm(drawn(), bathyal.Tracked(q, position))
    assert "joint 3 (elbow_joint)" in warning(fit, "Never moved")
    lost = [p.words for p in fit.parameters if p.status == "not_identifiable"]
    assert "theta of row 3" in lost
    assert lost[0] in warning(fit, "Not identifiable")


def test_poses_in_a_narrow_range() -> None:
    q, position = tracked(reach=0.1)
    fit = bathyal.identify_arm(drawn(), bathyal.Tracked(q, position))
    assert "joint 6 (wrist_3_joint) (11.5 deg)" in warning(fit, "Hardly moved")


def test_parameters_that_are_weakly_determined_are_named() -> None:
    q, position = tracked(reach=0.1)
    fit = bathyal.identify_arm(drawn(), bathyal.Tracked(q, position))
    weak = [p for p in fit.parameters if p.status == "identified" and p.group[:3] == "row"]
    worst = max((p for p in weak if p.unit == "rad"), key=lambda p: p.std)
    assert worst.words in warning(fit, "Determined too weakly")


def test_poses_within_a_narrow_cone() -> None:
    fit = fit_of(touched(lean=0.3))
    assert "plan_touches" in warning(fit, "from its mean attitude")


def test_exceeded_limits_are_named() -> None:
    table = drawn().to_dh()
    upper = np.full(6, np.pi)
    upper[4] = -1.5
    arm = bathyal.Arm.from_dh(
        table.a, table.alpha, table.d, table.theta, lower=-upper - 7, upper=upper
    )
    data = touched()
    fit = bathyal.identify_arm(arm, data.touches())
    count = int((data.q[:, 4] > -1.5 + 2e-3).sum())
    assert f"joint 5 (joint_5) in {count} rows" in warning(fit, "beyond the arm's limits")


def test_search_that_did_not_settle() -> None:
    fit = bathyal.identify_arm(drawn(), touched().touches(), max_iterations=1)
    assert not fit.converged
    assert "max_iterations" in warning(fit, "had not converged")


def test_noise_given_too_small() -> None:
    fit = bathyal.identify_arm(drawn(), touched().touches(known_distances=TOLD), noise=1e-5)
    assert "where 0.01 mm was given" in warning(fit, "The residuals imply a noise of 0.1")


# More than geometry -------------------------------------------------------------------------------


def test_elastic_joint_shows_in_the_residuals() -> None:
    data = touched()
    sagged = data.q.copy()
    sagged[:, 1] += 8e-3 * np.cos(data.q[:, 1] + 1.0)  # what the encoder does not see
    sagged[:, 2] += 8e-3 * np.cos(data.q[:, 1] + data.q[:, 2])
    fit = bathyal.identify_arm(drawn(), Touched(sagged, data.point).touches(known_distances=TOLD))
    assert fit.structure_p < 1e-6
    assert "Elastic" in warning(fit, "Geometry is not enough")


def mukca(robot: str) -> bathyal.Touches:
    folder = DATA / "mukca" / "data" / robot
    if not folder.is_dir():
        pytest.skip("MUKCa's touches are not among the shared data")
    files, told = {}, {}
    for session in sorted(os.listdir(folder)):
        for hole in (0, 1):
            files[f"{session}/{hole}"] = folder / session / f"hole_{hole}.csv"
        told[f"{session}/0", f"{session}/1"] = 0.05
    return bathyal.read_touches(files, unit="rad", known_distances=told)


@pytest.mark.parametrize("robot", ["dinova_1", "dinova_2"])
def test_kinova_needs_more_than_geometry(robot: str) -> None:
    fit = bathyal.identify_arm(bathyal.arms.gen3_lite(), mukca(robot))
    assert fit.structure_p < 1e-9
    assert "mm rms of residuals" in warning(fit, "Geometry is not enough")


def test_panda_names_few_rows_and_no_other_machine() -> None:
    fit = bathyal.identify_arm(bathyal.arms.panda(), mukca("panda_3"))
    assert fit.outliers == []
    assert all("Geometry is not enough" in text for text in fit.warnings)


def tracked(
    *, still: int | None = None, reach: float = 1.5, seed: int = 0
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    random = np.random.default_rng([seed, 4])
    q = random.uniform(-reach, reach, (60, 6))
    q[:2] = [[-reach] * 6, [reach] * 6]
    if still is not None:
        q[:, still] = 0.7
    return q, built().forward(q)[:, :3, 3] + random.normal(0, 1e-4, (60, 3))
