# SPDX-License-Identifier: BSD-3-Clause
"""identify_arm on recordings of real arms: what it finds, and whether it holds where it was not
fitted."""

from __future__ import annotations

from functools import cache
from itertools import combinations
from typing import Any

import numpy as np
import pytest

import bathyal
from tests.support.real_arms import (
    SOCKETS_APART,
    Array,
    apart,
    blocks,
    hilti,
    placements,
    sockets,
    trailblazer,
    trailblazer_with_one_slide,
    ur10,
)

MM = 1e-3


def rms(errors: Array) -> float:
    return float(np.sqrt((errors**2).sum(axis=1).mean()))


def part(data: bathyal.Tracked, rows: Array) -> bathyal.Tracked:
    return bathyal.Tracked(data.q[rows], data.position[rows])


def rows_of(fit: Any) -> list[str]:
    return [p.name for p in fit.parameters if p.group.startswith("row")]


def left(arm: bathyal.Arm, data: bathyal.Tracked) -> float:
    """Deviation of measured positions from where the arm says they are [m]."""
    return rms(arm.forward(data.q)[:, :3, 3] - data.position)


def spread(arm: bathyal.Arm, touches: bathyal.Touches) -> float:
    """Deviation of touches about their points [m]."""
    tips = arm.forward(touches.q)[:, :3, 3]
    points = [tips[touches.point == label] for label in np.unique(touches.point)]
    return rms(np.vstack([point - point.mean(axis=0) for point in points]))


# MUKCa: a ball seated in pairs of sockets ---------------------------------------------------------


@pytest.mark.parametrize(
    ("robot", "before", "after"),
    [("panda_2_clean", 8.42, 0.31), ("panda_3", 2.84, 0.21), ("panda_4_clean", None, 0.21)],
)
def test_pandas_whose_distances_are_given(robot: str, before: float | None, after: float) -> None:
    fit = bathyal.identify_arm(bathyal.arms.panda(), sockets(robot))
    if before is not None:
        assert fit.rms_before == pytest.approx(before * MM, abs=0.01 * MM)
    assert 0.2 * MM < fit.rms_after < after * MM
    assert fit.rank == 25
    assert fit.scale_source == "known distances"
    np.testing.assert_allclose(list(fit.distances.values()), SOCKETS_APART, atol=0.35 * MM)


@pytest.mark.parametrize(("robot", "within"), [("panda_2_clean", 0.2), ("panda_3", 0.05)])
@pytest.mark.parametrize("half", [0, 1])
def test_distances_given_on_half_of_the_placements_hold_on_the_rest(
    robot: str, within: float, half: int
) -> None:
    names = placements(robot)
    told = np.arange(len(names)) % 2 == half
    touches = sockets(robot, with_distance=lambda name: bool(told[names.index(name)]))
    fit = bathyal.identify_arm(bathyal.arms.panda(), touches)
    assert len(fit.distances) == told.sum()
    assert apart(fit.points)[~told].mean() == pytest.approx(SOCKETS_APART, abs=within * MM)


def test_any_half_of_the_placements_tells_the_size() -> None:
    """Every other of the 70 halves of panda_2's eight placements."""
    names = placements("panda_2_clean")
    found = []
    for chosen in [*combinations(names, 4)][::2]:
        touches = sockets("panda_2_clean", with_distance=lambda name, chosen=chosen: name in chosen)
        fit = bathyal.identify_arm(bathyal.arms.panda(), touches)
        found.append(apart(fit.points)[[name not in chosen for name in names]].mean())
    assert np.median(found) == pytest.approx(SOCKETS_APART, abs=0.05 * MM)
    assert (np.abs(np.array(found) - SOCKETS_APART) < 0.2 * MM).mean() > 0.9
    np.testing.assert_allclose(found, SOCKETS_APART, atol=0.3 * MM)


@pytest.mark.parametrize("robot", ["panda_2_clean", "panda_3"])
def test_a_placement_that_was_left_out_is_met_as_well(robot: str) -> None:
    held, distance = [], []
    for name in placements(robot):
        fit = bathyal.identify_arm(
            bathyal.arms.panda(), sockets(robot, used=lambda other, name=name: other != name)
        )
        touches = sockets(robot, used=lambda other, name=name: other == name)
        tips = fit.arm.forward(touches.q)[:, :3, 3]
        points = np.array([tips[touches.point == k].mean(axis=0) for k in np.unique(touches.point)])
        held.append(spread(fit.arm, touches))
        distance.append(apart(points)[0])
    assert max(held) < 0.5 * MM
    assert np.median(held) < 0.35 * MM
    np.testing.assert_allclose(distance, SOCKETS_APART, atol=0.35 * MM)


# Length prior [mm]: rms [mm] and mean distance of the sockets [mm].
TRAP_BY_RESIDUALS = {1: (0.299, 49.68), 5: (0.265, 43.95), 20: (0.096, 15.89), 100: (0.006, 0.92)}
TRAP_BY_3D_RMS = {1: (0.300, 49.87), 5: (0.287, 47.70), 20: (0.173, 28.66), 100: (0.016, 2.57)}


@pytest.mark.parametrize(
    ("noise", "trap"), [(None, TRAP_BY_RESIDUALS), (0.301 * MM, TRAP_BY_3D_RMS)]
)
def test_a_smaller_rms_proves_nothing_where_only_a_prior_tells_the_size(
    noise: float | None, trap: dict[int, tuple[float, float]]
) -> None:
    """Touches of a smaller arm scatter less, and a loose prior lets it shrink.

    How far depends on the noise that the prior is weighed against: that found in the residuals,
    0.175 mm per axis, or (a slip that is easily made) the 3-D rms, 0.301 mm, taken as that of an
    axis, which weighs touches a third as much.
    """
    touches = sockets("panda_2_clean", with_distance=lambda name: False)
    for prior, (scatter, distance) in trap.items():
        fit = bathyal.identify_arm(
            bathyal.arms.panda(), touches, length_prior=prior * MM, noise=noise
        )
        assert fit.rms_after == pytest.approx(scatter * MM, abs=0.0006 * MM)
        assert apart(fit.points).mean() == pytest.approx(distance * MM, rel=0.003)
        assert fit.scale_source == f"prior on lengths ({prior} mm)"
        assert fit.scale_source in str(fit)
        assert any("a smaller rms proves nothing" in warning for warning in fit.warnings)
        assert fit.rank == 24
        assert fit.rms_after_scaled == pytest.approx(fit.rms_after / fit.scale)


@pytest.mark.parametrize(
    ("robot", "before", "after"), [("dinova_1", 6.1, (2.8, 3.1)), ("dinova_2", 4.6, (1.8, 2.3))]
)
def test_geometry_is_not_enough_for_the_kinovas(
    robot: str, before: float, after: tuple[float, float]
) -> None:
    """Millimetres are left, and more of them where it was not fitted."""
    nominal = bathyal.arms.gen3_lite()
    fit = bathyal.identify_arm(nominal, sockets(robot))
    assert fit.rms_before == pytest.approx(before * MM, abs=0.05 * MM)
    assert after[0] * MM < fit.rms_after < after[1] * MM
    assert fit.noise > 1 * MM
    assert any(warning.startswith("Geometry is not enough") for warning in fit.warnings)
    held = []
    for name in placements(robot):
        others = sockets(robot, used=lambda other, name=name: other != name)
        found = bathyal.identify_arm(nominal, others).arm
        held.append(spread(found, sockets(robot, used=lambda other, name=name: other == name)))
    assert rms(np.array(held)[:, None]) > 1.2 * fit.rms_after


# IPA: a UR10 before a laser tracker ---------------------------------------------------------------


@pytest.mark.parametrize("series", ["A", "B", "C"])
def test_ur10_where_it_was_not_fitted(series: str) -> None:
    data = ur10(series)
    chosen = blocks(len(data.q))
    for fitted, held in ((chosen, ~chosen), (~chosen, chosen))[: 1 if series == "A" else 2]:
        fit = bathyal.identify_arm(bathyal.arms.ur10(), part(data, fitted))
        nominal = bathyal.identify_arm(bathyal.arms.ur10(), part(data, fitted), fixed=rows_of(fit))
        assert fit.scale_source == "measured positions"
        assert 0.8 * MM < left(nominal.arm, part(data, held)) < 1.12 * MM
        assert 0.40 * MM < left(fit.arm, part(data, held)) < 0.50 * MM
        assert all(p.status in ("identified", "gauge") for p in fit.parameters)


def test_ur10_of_another_session() -> None:
    """The rows found in one session, base and target put up anew: those of the grid (A) hold in B;
    those of the random poses (C) take back little of the nominal arm's error there."""
    left_of = {}
    rows = rows_of(bathyal.identify_arm(bathyal.arms.ur10(), ur10("B")))
    nominal = bathyal.identify_arm(bathyal.arms.ur10(), ur10("B"), fixed=rows).rms_after
    for series, every in (("A", 4), ("C", 1)):
        data = ur10(series)
        chosen = part(data, np.arange(len(data.q)) % every == 0)
        found = bathyal.identify_arm(bathyal.arms.ur10(), chosen).arm
        left_of[series] = bathyal.identify_arm(found, ur10("B"), fixed=rows).rms_after
    assert nominal == pytest.approx(1.085 * MM, abs=0.01 * MM)
    assert left_of["A"] == pytest.approx(0.498 * MM, abs=0.01 * MM)
    assert left_of["C"] == pytest.approx(0.905 * MM, abs=0.02 * MM)


# Hilti: a lifting column with an arm --------------------------------------------------------------


@cache
def column_fits() -> list[tuple[Any, Any, float, float]]:
    """By every other pose in turn: the fit, that of base and tool alone, and both held out."""
    data, _ = hilti("flat")
    even = np.arange(len(data.q)) % 2 == 0
    out = []
    for fitted, held in ((even, ~even), (~even, even)):
        fit = bathyal.identify_arm(trailblazer_with_one_slide(), part(data, fitted))
        nominal = bathyal.identify_arm(
            trailblazer_with_one_slide(), part(data, fitted), fixed=rows_of(fit)
        )
        out.append(
            (fit, nominal, left(nominal.arm, part(data, held)), left(fit.arm, part(data, held)))
        )
    return out


def test_column_and_arm_where_they_were_not_fitted() -> None:
    for _, _, nominal, found in column_fits():
        assert nominal == pytest.approx(9.1 * MM, abs=0.2 * MM)
        assert found == pytest.approx(3.5 * MM, abs=0.2 * MM)


def test_stationing_points_by_the_arm_found_at_the_others() -> None:
    data, stationing = hilti("flat")
    arm = trailblazer_with_one_slide()
    fit = bathyal.identify_arm(arm, part(data, ~stationing))
    nominal = bathyal.identify_arm(arm, part(data, ~stationing), fixed=rows_of(fit))
    assert left(nominal.arm, part(data, stationing)) == pytest.approx(6.16 * MM, abs=0.1 * MM)
    assert left(fit.arm, part(data, stationing)) == pytest.approx(4.29 * MM, abs=0.1 * MM)


def test_the_sliding_joint_is_identified() -> None:
    """The first turning axis of the arm is not square to the column by 0.44°, and both halves of
    the data say so alike."""
    angle, std = [], []
    for fit, *_ in column_fits():
        slide = {p.name: p for p in fit.parameters}
        assert {slide[name].status for name in ("alpha_1", "theta_2")} == {"identified"}
        assert {p.status for p in fit.parameters} == {"identified", "gauge"}
        assert fit.rank == 29
        jacobian = fit.arm.jacobian(np.zeros(7))
        np.testing.assert_allclose(np.linalg.norm(jacobian[:3, 0]), 1.0, atol=1e-12)
        np.testing.assert_array_equal(jacobian[3:, 0], 0.0)
        angle.append(np.arccos(jacobian[:3, 0] @ jacobian[3:, 1]))
        std.append(slide["alpha_1"].std)
    assert max(std) < 0.5e-3
    assert abs(angle[0] - angle[1]) < 3 * np.hypot(*std)
    np.testing.assert_allclose(np.degrees(angle), 89.556, atol=0.02)


def test_two_stages_that_slide_as_one_are_not_distinguished() -> None:
    data, _ = hilti("flat")
    two = bathyal.identify_arm(trailblazer(), data)
    one = bathyal.identify_arm(trailblazer_with_one_slide(), data)
    assert two.rms_after == pytest.approx(one.rms_after, rel=1e-3)
    assert two.rank == one.rank
    assert "not_identifiable" in {p.status for p in two.parameters if p.group == "row 1"}
    assert "not_identifiable" not in {p.status for p in one.parameters}
