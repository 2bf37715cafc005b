# SPDX-License-Identifier: BSD-3-Clause
"""identify_arm against SciPy and NumPy, invariance, and the spread that it predicts."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.identify_peer import POINTS, Peer, built, touch

scipy_optimize = pytest.importorskip("scipy.optimize")

NOISE = 1e-4


@pytest.fixture(scope="module")
def noisy() -> bathyal.Touches:
    q, point = touch(built(bathyal.arms.ur10e(), 1e-3, 1), 21, 2)
    return bathyal.Touches(q + 5e-5 * np.random.default_rng(3).normal(size=q.shape), point)


@pytest.mark.parametrize("criterion", ["centroid", "pairs"])
def test_the_cost_is_scipys(noisy: bathyal.Touches, criterion: str) -> None:
    """With the scale held, by one length at nominal; equal touches, so that both forms agree."""
    arm = bathyal.arms.ur10e()
    fit = bathyal.identify_arm(
        arm, noisy, criterion=criterion, fixed=["a_2"], length_prior=100.0, noise=NOISE
    )
    assert fit.scale_source.startswith("prior"), "a held length is not determined by the data"
    peer = Peer(arm, fit, noisy.q, noisy.point)
    free = [i for i, p in enumerate(fit.parameters) if p.status not in ("gauge", "fixed")]
    assert len(free) == 20

    def of_free(y: np.ndarray) -> np.ndarray:
        x = peer.nominal.copy()
        x[free] += 1e-3 * y
        return peer.residuals(x) * 1e3

    found = scipy_optimize.least_squares(
        of_free, np.zeros(len(free)), xtol=1e-15, ftol=1e-15, gtol=1e-15
    )
    ours = np.sum(fit.residuals**2)
    assert ours == pytest.approx(2e-6 * found.cost, rel=1e-8, abs=0)
    assert ours < 0.01 * fit.rms_before**2 * len(noisy)
    values = np.array([p.value for p in fit.parameters])
    assert np.sum(peer.residuals(values) ** 2) == pytest.approx(ours, rel=1e-11, abs=0)


@pytest.mark.parametrize(("parametrization", "rank"), [("hayati", 20), ("dh", 18)])
def test_rank_and_singular_values_are_numpys(parametrization: str, rank: int) -> None:
    arm = bathyal.arms.ur10e()
    q, point = touch(built(arm, 0.0, 1), 21, 2)
    data = bathyal.Touches(q, point)
    fit = bathyal.identify_arm(arm, data, parametrization=parametrization)
    peer = Peer(arm, fit, q, point)
    values = np.linalg.svd(peer.jacobian(peer.nominal), compute_uv=False)
    assert fit.rank == rank == np.sum(values > 1e-7 * values[0])
    np.testing.assert_allclose(fit.singular_values[:rank], values[:rank], rtol=1e-6)
    told = bathyal.identify_arm(
        arm,
        bathyal.Touches(q, point, known_distances={(0, 1): np.linalg.norm(POINTS[1] - POINTS[0])}),
        parametrization=parametrization,
    )
    assert told.rank == rank + 1


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=15, deadline=None)
def test_moving_base_and_points_together_changes_nothing(seed: int) -> None:
    random = np.random.default_rng(seed)
    motion = np.eye(4)
    motion[:3, :3] = np.linalg.qr(random.normal(size=(3, 3)))[0]
    motion[:3, :3] *= np.linalg.det(motion[:3, :3])
    motion[:3, 3] = random.normal(size=3)
    drawing = bathyal.arms.ur10e()
    q, point = touch(built(drawing, 1e-3, seed % 7), 8, 2)
    q = q + 5e-5 * random.normal(size=q.shape)
    here = bathyal.identify_arm(
        drawing, bathyal.Touches(q, point, known_points=dict(enumerate(POINTS)))
    )
    moved_points = POINTS @ motion[:3, :3].T + motion[:3, 3]
    there = bathyal.identify_arm(
        moved_base(drawing, motion),
        bathyal.Touches(q, point, known_points=dict(enumerate(moved_points))),
    )
    assert there.rank == here.rank
    assert there.rms_after == pytest.approx(here.rms_after, rel=1e-6, abs=0)
    for a, b in zip(here.parameters, there.parameters, strict=True):
        if a.group != "base":
            assert b.value == pytest.approx(a.value, abs=1e-7)


def moved_base(arm: bathyal.Arm, base: np.ndarray) -> bathyal.Arm:
    table = arm.to_dh()
    return bathyal.Arm.from_dh(table.a, table.alpha, table.d, table.theta, base=base)


def test_tip_std_is_the_spread_of_many_fits() -> None:
    drawing = bathyal.arms.ur10e()
    true = built(drawing, 1e-3, 1)
    random = np.random.default_rng(5)
    q = random.uniform(-2, 2, (60, 6))
    where = random.uniform(-2, 2, (12, 6))
    exact = true.forward(q)[:, :3, 3]

    def tips(fit: bathyal.ArmFit) -> np.ndarray:
        inverse = np.linalg.inv(fit.arm.base)
        return (inverse @ fit.arm.forward(where))[:, :3, 3]

    reference = bathyal.identify_arm(drawing, bathyal.Tracked(q, exact), noise=NOISE)
    foretold = reference.tip_std(where)
    assert isinstance(reference.tip_std(where[0]), float)
    misses = []
    for _ in range(150):
        data = bathyal.Tracked(q, exact + NOISE * random.normal(size=exact.shape))
        misses.append(tips(bathyal.identify_arm(drawing, data, noise=NOISE)) - tips(reference))
    spread = np.sqrt(np.mean(np.sum(np.square(misses), axis=2), axis=0))
    np.testing.assert_allclose(spread, foretold, rtol=0.2)
    assert np.mean(spread / foretold) == pytest.approx(1, abs=0.06)


def test_reads_from_python_as_written(noisy: bathyal.Touches) -> None:
    fit = bathyal.identify_arm(bathyal.arms.ur10e(), noisy)
    assert isinstance(fit.arm, bathyal.Arm)
    assert 0 < fit.rms_after < fit.rms_before
    assert fit.rank == 20
    assert fit.std.shape == (27,) == (len(fit.parameters),)
    assert fit.covariance.shape == (27, 27)
    assert fit.scale_source == "prior on lengths (1 mm)"
    assert isinstance(fit.warnings, list)
    assert len(fit.unseen) == 7
    assert fit.history[0] > fit.history[-1]
    assert fit.residuals.shape == (63, 3)
    assert not fit.residuals.flags.writeable
    assert {p.status for p in fit.parameters} >= {"identified", "gauge"}
    gauge = next(p for p in fit.parameters if p.status == "gauge")
    assert gauge.value == gauge.nominal
    assert gauge.std == 0
    assert gauge.trades


def test_words_are_listed_when_one_is_wrong(noisy: bathyal.Touches) -> None:
    with pytest.raises(ValueError, match='`criterion`: expected "centroid" or "pairs"'):
        bathyal.identify_arm(bathyal.arms.ur10e(), noisy, criterion="mean")
    with pytest.raises(ValueError, match="`data`: expected Touches or Tracked, got list"):
        bathyal.identify_arm(bathyal.arms.ur10e(), [1, 2])  # type: ignore[arg-type]
