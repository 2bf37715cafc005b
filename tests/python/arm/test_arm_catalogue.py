# SPDX-License-Identifier: BSD-3-Clause
"""The arms by name, against what is known of them from elsewhere."""

from math import pi
from pathlib import Path

import numpy as np
import pytest

import bathyal
from tests.support.pin_arms import urdf_tips

DATA = Path(__file__).parents[3] / ".." / "shared" / "data"
MUKCA = DATA / "arms" / "mukca" / "urdf"
ALPHA = DATA / "uvms" / "urdf" / "alpha_seabotix.urdf"
ALL = [getattr(bathyal.arms, name) for name in bathyal.arms.__all__]


def needs(path: Path) -> str:
    if not path.exists():
        pytest.skip(f"{path.name} of the shared data is not here")
    return str(path)


def within(arm: bathyal.Arm, count: int) -> np.ndarray:
    return np.random.default_rng(2).uniform(arm.lower, arm.upper, (count, arm.size))


@pytest.mark.parametrize("make", ALL, ids=lambda make: make.__name__)
def test_every_arm_says_what_it_is(make) -> None:  # type: ignore[no-untyped-def]
    arm = make()
    assert arm.name
    assert arm.source
    assert (arm.lower < arm.upper).all()
    assert len(set(arm.joint_names)) == arm.size
    assert make().forward(np.zeros(arm.size)).shape == (4, 4)


def test_panda_is_that_of_its_urdf() -> None:
    arm = bathyal.arms.panda()
    q = within(arm, 50)
    tips = urdf_tips(
        needs(MUKCA / "panda.urdf"), "panda_link8", "panda_link0", arm.joint_names, q
    )  # fmt: skip
    np.testing.assert_allclose(arm.forward(q), tips, atol=1e-12)


def test_gen3_lite_is_that_of_its_urdf_whose_angles_are_rounded() -> None:
    arm = bathyal.arms.gen3_lite()
    q = within(arm, 50)
    tips = urdf_tips(
        needs(MUKCA / "gen3lite.urdf"), "end_effector_link", "kinova_base_link", arm.joint_names, q
    )  # fmt: skip
    np.testing.assert_allclose(arm.forward(q), tips, atol=2e-5)


def test_reach_alpha_5_is_that_of_its_urdf_whose_angles_are_rounded() -> None:
    """There the zero of the wrist is half a radian off, and the jaw a quarter turn."""
    arm = bathyal.arms.reach_alpha_5()
    q = within(arm, 50)
    arm.tool = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    names = [f"r5m_joint{k}" for k in (5, 4, 3, 2)]
    tips = urdf_tips(needs(ALPHA), "r5m_jaw", "r5m_base_link", names, q + np.array([0, 0, 0, 0.5]))
    np.testing.assert_allclose(arm.forward(q), tips, atol=4e-4)


def test_ur_arms_stretched_out_and_upright() -> None:
    for arm, reach, height in [
        (bathyal.arms.ur10e(), 0.6127 + 0.5715, 0.1807),
        (bathyal.arms.ur10(), 0.612 + 0.5723, 0.1273),
    ]:
        offset = -arm.to_dh().d[3] - arm.to_dh().d[5]
        flat = arm.forward(np.zeros(6))[:3, 3]
        np.testing.assert_allclose(flat, [-reach, offset, height - arm.to_dh().d[4]], atol=1e-15)
        upright = arm.forward([0, -pi / 2, 0, -pi / 2, 0, 0])[:3, 3]
        np.testing.assert_allclose(
            upright, [0, offset, height + reach + arm.to_dh().d[4]], atol=1e-15
        )


def test_maevskiy_zanin_starts_before_the_hull() -> None:
    arm = bathyal.arms.maevskiy_zanin()
    q = np.radians([0, -45, 50])
    reach = 0.193 + 0.552 * np.cos(q[1]) + 0.596 * np.cos(q[1] + q[2])
    height = 0.552 * np.sin(q[1]) + 0.596 * np.sin(q[1] + q[2]) - 0.117
    np.testing.assert_allclose(arm.forward(q)[:3, 3], [reach, 0, height], atol=1e-15)
    assert arm.within_limits(q)


def test_reach_bravo_7_is_the_table_multiplied_out() -> None:
    arm = bathyal.arms.reach_bravo_7()
    s = np.arctan(5.2 / 290.77)
    q = np.array([0.4, 1.0, 0.6, 2.0, 1.1, -0.3])
    rows = [
        (41.45, 0, 67.5, pi), (-117.48, q[0] + pi, 46, -pi / 2),
        (0, q[1] - pi / 2 + s, 290.82, 0), (0, q[2] - pi / 2 - s, 40.8, -pi / 2),
        (-160.26, q[3] + pi, 40.8, -pi / 2), (0, q[4], 40.8, -pi / 2),
        (-224.16, q[5], 0, pi / 2), (0, -pi / 2, 120, 0),
    ]  # fmt: skip
    pose = np.eye(4)
    for d, t, a, f in rows:
        pose = pose @ [
            [np.cos(t), -np.sin(t) * np.cos(f), np.sin(t) * np.sin(f), a * np.cos(t) / 1000],
            [np.sin(t), np.cos(t) * np.cos(f), -np.cos(t) * np.sin(f), a * np.sin(t) / 1000],
            [0, np.sin(f), np.cos(f), d / 1000],
            [0, 0, 0, 1],
        ]
    np.testing.assert_allclose(arm.forward(q), pose, atol=1e-14)
    assert arm.upper[5] == np.inf
