# SPDX-License-Identifier: BSD-3-Clause
"""Drawn arms with a sliding joint: identify_arm leaves the noise, whatever is square."""

from dataclasses import replace

import numpy as np
import pytest

import bathyal
from tests.simulated_cases.arm_draws import draw_arm
from tests.simulated_cases.arms import turned
from tests.simulated_cases.cases import draw_case

NOISE = 1e-4
SLIDING = [s for s in range(130) if draw_arm(np.random.default_rng(s)).sliding.any()]


def assert_noise_is_left(fit: bathyal.ArmFit, noise: float) -> None:
    """Chi square of 3 N position rows within five of its standard deviations."""
    freedom = fit.degrees_of_freedom
    assert freedom > 100
    assert (fit.noise / noise) ** 2 == pytest.approx(1.0, abs=5 * np.sqrt(2 / freedom))


@pytest.mark.parametrize("digits", [15, 4])
@pytest.mark.parametrize("with_turns", [False, True])
def test_the_noise_is_left_of_tracked_arms(with_turns: bool, digits: int) -> None:
    """As drawn, and with angles rounded as drawings have them."""
    assert len(SLIDING) > 25
    for seed in SLIDING:
        random = np.random.default_rng([seed, 1])
        drawn = replace(draw_arm(np.random.default_rng(seed)), urdf=False)
        q = random.uniform(drawn.lower, drawn.upper, (200, drawn.size))
        frames = drawn.built(random, 1e-3, 1e-3).walk(q)
        base = turned(random.normal(size=(1, 3)))[0]
        poses = np.tile(np.eye(4), (len(q), 1, 1))
        poses[:, :3, :3] = base @ frames.tool @ turned(NOISE * random.normal(size=(len(q), 3)))
        poses[:, :3, 3] = frames.tip @ base.T + [1, 2, 0.5] + NOISE * random.normal(size=(200, 3))
        angles = {c: np.round(getattr(drawn, c), digits) for c in ("theta", "alpha")}
        data = bathyal.Tracked(q, pose=poses) if with_turns else bathyal.Tracked(q, poses[:, :3, 3])
        assert_noise_is_left(bathyal.identify_arm(replace(drawn, **angles).arm(), data), NOISE)


# Clean cases of the generator of hidden effects: some left up to 3.6 of the noise; of touches, the
# scatter of some passed for something that follows the sliding joint.
@pytest.mark.parametrize("seed", [61, 343, 982, 1063, 1284, 1303, 1620, 1781, 60, 121, 1440])
def test_the_noise_is_left_of_sealed_cases(seed: int) -> None:
    case = draw_case(seed)
    assert case.answer.kind == "clean"
    assert case.arm.sliding.any()
    fit = bathyal.identify_arm(case.bathyal_arm(), case.data())
    assert_noise_is_left(fit, case.answer.noise)
    assert not [text for text in fit.warnings if "Geometry is not enough" in text]
