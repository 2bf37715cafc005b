# SPDX-License-Identifier: BSD-3-Clause
"""What a caller asks a diagnosis, or a model, for by name."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal
from bathyal import CorrectedArm, Link, Tracked
from bathyal.effects import FoundEffect, library_effects

Array = NDArray[np.float64]

RNG = np.random.default_rng(8)
Q = RNG.uniform(-1.5, 1.5, (120, 6))
ARM = bathyal.arms.ur10()
TIP = ARM.forward(Q)[:, :3, 3]
MASSLESS = bathyal.Arm.from_dh(
    **{key: getattr(ARM.to_dh(), key) for key in ("a", "alpha", "d", "theta", "beta")}
)
HEAVY = bathyal.Arm.from_dh(
    **{key: getattr(ARM.to_dh(), key) for key in ("a", "alpha", "d", "theta", "beta")},
    links=[Link(mass=mass) for mass in (4.0, 7.0, 13.0, 4.0, 2.0, 2.0, 0.4)],
)

OF_WEIGHT: list[tuple[str, dict[str, Any]]] = [
    ("joint_compliance", {"parameters": {"compliance": 1e-5}, "joint": 1}),
    ("link_compliance", {"parameters": {"flexibility": 1e-5}, "joint": 1, "settings": {"row": 1}}),
    ("base_compliance", {"parameters": {"compliance_x": 1e-6}}),
]


@pytest.mark.parametrize(("name", "arguments"), OF_WEIGHT)
def test_a_model_refuses_an_effect_that_nothing_weighs_on(
    name: str, arguments: dict[str, Any]
) -> None:
    effect = FoundEffect(name, **arguments)
    with pytest.raises(ValueError, match=f"effect {name}.*masses, or a `payload`.*no weight"):
        CorrectedArm(MASSLESS, [effect], Tracked(Q, TIP))
    loaded = Tracked(Q, TIP, covariates={"payload": np.linspace(0, 3, 120)})
    for model in (
        CorrectedArm(HEAVY, [effect], Tracked(Q, TIP)),
        CorrectedArm(MASSLESS, [effect], loaded),
    ):
        moved = model.forward(Q, covariates={"payload": 3.0}) - model.arm.forward(Q)
        assert np.abs(moved).max() > 1e-6


@pytest.mark.parametrize("name", ["link_compliance", "base_compliance"])
def test_a_diagnosis_refuses_an_effect_that_nothing_weighs_on(name: str) -> None:
    only = [bathyal.effects.get("joint_scale"), bathyal.effects.get(name)]
    data = Tracked(Q, TIP + RNG.normal(0, 1e-5, TIP.shape))
    with pytest.raises(ValueError, match=f"`effects`.*{name}, which an arm without masses"):
        bathyal.diagnose(MASSLESS, data, effects=only)
    assert bathyal.diagnose(HEAVY, data, effects=only).verdict == "clean"
    assert bathyal.diagnose(MASSLESS, data, effects=library_effects()).verdict == "clean"


def _slipped(moment: int, noise: float) -> Tracked:
    turned = ARM.forward(Q)
    tips = turned[:, :3, 3] + (np.arange(120) >= moment)[:, None] * (turned[:, :3, 1] * 5e-4)
    return Tracked(Q, tips + RNG.normal(0, noise, tips.shape))


def test_a_slip_that_was_found_by_row_can_be_asked_for_by_row() -> None:
    data = _slipped(47, 2e-5)
    report = bathyal.diagnose(ARM, data)
    assert [effect.name for effect in report.effects] == ["tool_slip"]
    assert int(report.effects[0].parameters["moment"]) == 47
    tips = report.model.forward(Q, covariates={"row": np.arange(120)})[:, :3, 3]
    misses = np.asarray(data.position) - tips
    assert np.abs(misses + np.asarray(report.residuals_after)).max() < 1e-9
    after = report.model.forward(Q)[:, :3, 3]  # without a row it has slipped
    assert np.abs((after - tips)[47:]).max() == 0.0
    assert np.abs((after - tips)[:47]).max() > 3e-4
    again = FoundEffect("tool_slip", {"shift_y": 5e-4}, settings={"moment": 47})
    model = CorrectedArm(ARM, [again], data)
    moved = model.forward(Q, covariates={"row": np.arange(120)}) - ARM.forward(Q)
    assert (np.abs(moved).max(axis=(1, 2)) > 0).tolist() == [row >= 47 for row in range(120)]
    with pytest.raises(ValueError, match="`covariates row`: expected whole numbers of 0 or more"):
        model.forward(Q, covariates={"row": -1.0})


def test_the_moment_of_a_slip_counts_copies_of_rows_too() -> None:
    data = _slipped(47, 2e-5)
    rows = [*range(10), *range(5), *range(10, 120)]  # five rows twice, before the slip
    twice = Tracked(Q[rows], np.asarray(data.position)[rows])
    report = bathyal.diagnose(ARM, twice)
    [effect] = report.effects
    assert int(effect.parameters["moment"]) == 52
    assert "row 52" in effect.words
    tips = report.model.forward(Q[rows], covariates={"row": np.arange(125)})[:, :3, 3]
    misses = np.asarray(twice.position) - tips
    assert np.abs(misses + np.asarray(report.residuals_after)).max() < 1e-9


def test_a_prior_on_lengths_holds_them() -> None:
    long = bathyal.Arm.from_dh(
        **{key: getattr(ARM.to_dh(), key) for key in ("alpha", "d", "theta", "beta")},
        a=ARM.to_dh().a + np.array([0, 1e-3, -1e-3, 0, 0, 0]),
    )
    data = Tracked(Q, long.forward(Q)[:, :3, 3] + RNG.normal(0, 5e-5, TIP.shape))

    def lengths(prior: float | None) -> Array:
        report = bathyal.diagnose(ARM, data, length_prior=prior)
        return np.asarray(report.model.arm.to_dh().a - ARM.to_dh().a)[1:3]

    assert lengths(None) == pytest.approx([1e-3, -1e-3], abs=1e-4)
    assert lengths(1e-3) == pytest.approx([1e-3, -1e-3], abs=1e-4)
    assert np.abs(lengths(1e-7)).max() < 1e-4
    with pytest.raises(ValueError, match="`length_prior`"):
        bathyal.diagnose(ARM, data, length_prior=0.0)
