# SPDX-License-Identifier: BSD-3-Clause
"""verify_arm: the paper's check of an arm against a tracker, by exact pairs and by ICP."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support.touch_simulation import Array, identified_ur10e

ARM = bathyal.arms.ur10e()


def flange_positions(seed: int = 1) -> tuple[Array, Array]:
    """As in Yukhimets, Gubankov (2023): 13 poses of one orientation; and where the flange of the
    identified arm then is."""
    truth = identified_ur10e()
    truth.tool = np.eye(4)
    random = np.random.default_rng(seed)
    poses = np.tile(np.diag([1.0, -1.0, -1.0, 1.0]), (40, 1, 1))
    poses[:, :3, 3] = random.uniform([-0.9, -0.6, 0.1], [-0.3, 0.6, 0.7], (40, 3))
    solution = truth.inverse(poses)
    q = solution.q[solution.status == "reached"][:13]
    return q, truth.forward(q)[:, :3, 3]


def motion(angle: float, shift: tuple[float, float, float]) -> tuple[Array, Array]:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), np.array(shift)


def moved(points: Array, angle: float, shift: tuple[float, float, float]) -> Array:
    turn, offset = motion(angle, shift)
    return points @ turn.T + offset


def test_the_instruments_frame_does_not_count() -> None:
    q, seen = flange_positions()
    here = bathyal.verify_arm(ARM, q, seen)
    there = bathyal.verify_arm(ARM, q, moved(seen, 2.0, (4, -5, 6)))
    assert there.rms_after == pytest.approx(here.rms_after, rel=1e-9)
    np.testing.assert_allclose(there.deviation, here.deviation, rtol=1e-8)
    assert there.rms_before > 0.1


def test_nor_does_the_pose_of_the_base_or_what_it_carries() -> None:
    """A tool moves all points of one orientation alike."""
    q, seen = flange_positions()
    arm = identified_ur10e()
    arm.base = [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]
    assert bathyal.verify_arm(arm, q, seen).rms_after < 1e-6  # as the poses are of one orientation
    assert bathyal.verify_arm(arm, q + 0.01, seen).rms_after > 1e-4


def test_the_deviations_are_those_of_the_rigid_motion_that_leaves_least() -> None:
    """Against Kabsch's solution by NumPy's own decomposition."""
    q, seen = flange_positions()
    result = bathyal.verify_arm(ARM, q, seen)
    predicted = ARM.forward(q)[:, :3, 3]
    a, b = predicted - predicted.mean(axis=0), seen - seen.mean(axis=0)
    left, _, right = np.linalg.svd(a.T @ b)
    turn = right.T @ np.diag([1, 1, np.linalg.det(right.T @ left.T)]) @ left.T
    residual = b - a @ turn.T
    np.testing.assert_allclose(result.residual, residual, atol=1e-12)
    np.testing.assert_allclose(result.deviation, np.linalg.norm(residual, axis=1), atol=1e-12)
    assert result.rms_after == pytest.approx(np.sqrt((residual**2).sum(axis=1).mean()))
    assert result.rms_before == pytest.approx(np.sqrt(((b - a) ** 2).sum(axis=1).mean()))
    assert result.rms_after < result.rms_before
    pose = np.asarray(result.measured_from_predicted)
    np.testing.assert_allclose(pose[:3, :3], turn, atol=1e-12)
    np.testing.assert_allclose(
        predicted @ pose[:3, :3].T + pose[:3, 3] + residual, seen, atol=1e-12
    )


def test_icp_finds_the_pairs_of_positions_in_any_order() -> None:
    pytest.importorskip("bathyal._pcl")
    q, seen = flange_positions()
    order = np.random.default_rng(2).permutation(13)
    # A tracker whose frame is close to the arm's: ICP starts from centroids laid on each other.
    shuffled = moved(seen, 0.05, (4, -5, 6))[order]
    result = bathyal.verify_arm(ARM, q, shuffled, pairing="icp")
    np.testing.assert_array_equal(order[result.pairs], np.arange(13))
    exact = bathyal.verify_arm(ARM, q, seen)
    assert result.rms_after == pytest.approx(exact.rms_after, rel=1e-9)


def test_icp_leaves_over_what_no_pose_belongs_to() -> None:
    pytest.importorskip("bathyal._pcl")
    q, seen = flange_positions()
    result = bathyal.verify_arm(ARM, q[:12], seen, pairing="icp")
    np.testing.assert_array_equal(result.pairs, np.arange(12))


def test_icp_does_not_give_one_position_to_two_poses() -> None:
    pytest.importorskip("bathyal._pcl")
    q, seen = flange_positions()
    with pytest.raises(bathyal.Error, match="nearest to the same position"):
        bathyal.verify_arm(ARM, q, moved(seen, 1.5, (0, 0, 0)), pairing="icp")


@pytest.mark.parametrize("pairing", ["exact", "icp"])
def test_mistakes_are_named(pairing: str) -> None:
    if pairing == "icp":
        pytest.importorskip("bathyal._pcl")
    q, seen = flange_positions()
    hole = seen.copy()
    hole[3, 1] = np.nan
    line = np.outer(np.arange(13.0), [1, 1, 0])
    for arguments, told in [
        ((q, seen[:12]), "`positions`: expected as many rows"),
        ((q, hole), "`positions`: expected finite"),
        ((q, seen[:, :2]), "`positions`: expected real numbers"),
        ((q[:2], seen[:2]), "`q`: expected three rows or more, got shape"),
        ((q[0], seen[0]), "`q`: expected three rows or more, got shape"),
        ((q[:, :5], seen), "`q`: expected real numbers"),
        ((q * np.nan, seen), "`q`: expected finite"),
    ]:
        with pytest.raises(ValueError, match=told):
            bathyal.verify_arm(ARM, *arguments, pairing=pairing)
    with pytest.raises(ValueError, match="`positions`: expected points that are not all on one"):
        bathyal.verify_arm(ARM, q, line)


def test_another_pairing_is_refused() -> None:
    with pytest.raises(ValueError, match="`pairing`: expected"):
        bathyal.verify_arm(ARM, *flange_positions(), pairing="nearest")


def test_what_is_handed_out_cannot_be_changed() -> None:
    result = bathyal.verify_arm(ARM, *flange_positions())
    assert result.deviation.shape == (13,)
    assert result.residual.shape == (13, 3)
    assert "13 positions" in repr(result)
    for array in (result.deviation, result.residual, result.pairs):
        assert not array.flags.writeable
