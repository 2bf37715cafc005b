# SPDX-License-Identifier: BSD-3-Clause
"""Moving the tip, and following a tool path along a surveyed bottom."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support.vehicles import Q_START, box_mesh, flat_bottom, sampler

# A Panda that hangs from the bow, upside down: world_from_vehicle is put over the bottom by `over`.
MOUNT = np.array([[1.0, 0, 0, 0.45], [0, -1, 0, 0], [0, 0, -1, -0.1], [0, 0, 0, 1]])
HULL = bathyal.Hull(box_mesh([-0.9, -0.35, -0.1], [0.45, 0.35, 0.3]))
AHEAD = 0.35  # of the mount, where the path lies [m]


@pytest.fixture(scope="module")
def bottom() -> bathyal.Scene:
    """A surveyed bottom: waves, ripples and boulders, at a small vehicle's altitude."""
    survey = bathyal.generate_survey(
        seed=3,
        origin=(0.0, 0.0, -30.0),
        length=6.0,
        width=6.0,
        wave_height=0.1,
        ripple_height=0.01,
        roughness=0.02,
        boulders=0,
        trench_depth=0.0,
        altitude=3.0,
        lost_width=0.0,
    )
    return bathyal.Scene(bathyal.triangulate(survey))


def ground_at(scene: bathyal.Scene, x: float, y: float) -> float:
    hits = scene.cast(np.array([[x, y, 0.0]]), np.array([[0.0, 0.0, -1.0]]))
    return -float(hits.range[0])


def over(scene: bathyal.Scene, x: float = 3.0, y: float = 3.0) -> np.ndarray:
    """world_from_vehicle: the mount AHEAD of (x, y) and 0.72 m over the ground."""
    pose = np.eye(4)
    pose[:3, 3] = [x - AHEAD - 0.45, y, ground_at(scene, x, y) + 0.82]
    return pose


def panda(scene: bathyal.Scene, **around) -> bathyal.Workspace:
    return bathyal.Workspace(
        bathyal.arms.panda(), MOUNT, hull=HULL, scene=scene, vehicle_pose=over(scene), radii=0.04,
        **around,
    )  # fmt: skip


def path_through(scene: bathyal.Scene, xy, **options) -> bathyal.ToolPath:
    """Aims straight down at points; nan: one that misses."""
    aims = [[3.0, 3.0, 0.0, 0, 0, 1] if np.isnan(x) else [x, y, 0.0, 0, 0, -1] for x, y in xy]
    return bathyal.plan_toolpath(scene, np.array(aims), frame="world", **options)


def finite_differences(q: np.ndarray, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rates of the legs, and accelerations from leg to leg, from rest to rest."""
    duration = np.diff(time)
    rate = np.diff(q, axis=0) / duration[:, None]
    rest = np.zeros((1, q.shape[1]))
    between = np.convolve(np.concatenate([[0], duration, [0]]), [0.5, 0.5], "valid")
    change = np.diff(np.vstack([rest, rate, rest]), axis=0)
    return rate, change / between[:, None]


def check_limits(ws: bathyal.Workspace, q: np.ndarray, time: np.ndarray) -> None:
    velocity = np.where(np.isfinite(ws.arm.velocity), ws.arm.velocity, 1.0)
    rate, acceleration = finite_differences(q, time)
    assert (np.abs(rate) <= velocity * (1 + 1e-9)).all()
    assert (np.abs(acceleration) <= velocity / 0.5 * (1 + 1e-6)).all()
    assert (q >= ws.arm.lower - 1e-12).all()
    assert (q <= ws.arm.upper + 1e-12).all()


def check_followed(ws, scene_pose, path, followed, tip_contact) -> None:
    at_sample = (followed.sample >= 0) & (followed.fraction == 0)
    tips = scene_pose @ ws.arm.forward(followed.q[at_sample])
    j = followed.sample[at_sample]
    assert np.linalg.norm(tips[:, :3, 3] - path.position[j], axis=1).max() < 1e-4
    cosine = -np.einsum("ij,ij->i", tips[:, :3, 2], path.approach[j])
    assert np.arccos(np.clip(cosine, -1, 1)).max() < 1e-3
    assert ws.check_motion(followed.q, tip_contact=tip_contact)
    assert (np.diff(followed.time) > 0).all()


def test_a_path_along_a_surveyed_bottom_is_followed(bottom) -> None:
    ws = panda(bottom)
    path = path_through(bottom, [(2.9, 2.8), (3.1, 3.0), (2.9, 3.2)])
    followed = ws.follow(path)
    assert followed.cut == []
    assert set(range(len(path.position))) == set(followed.sample)
    check_followed(ws, over(bottom), path, followed, tip_contact=True)
    check_limits(ws, followed.q, followed.time)
    again = ws.follow(path)
    assert again.q.tobytes() == followed.q.tobytes()
    assert not followed.q.flags.writeable


def test_a_gap_is_crossed_lifted(bottom) -> None:
    ws = panda(bottom)
    nan = (np.nan, np.nan)
    path = path_through(bottom, [(2.9, 2.8), (3.0, 2.9), nan, (3.0, 3.1), (2.9, 3.2)])
    followed = ws.follow(path, lift=0.08)
    assert followed.cut == []
    check_followed(ws, over(bottom), path, followed, tip_contact=True)
    transit = followed.sample == -1
    tips = (over(bottom) @ ws.arm.forward(followed.q[transit]))[:, :3, 3]
    across = tips[np.abs(tips[:, 1] - 3.0) < 0.08]
    height = [z - ground_at(bottom, x, y) for x, y, z in across]
    assert len(height) > 5
    assert min(height) > 0.06
    assert ws.clearance(followed.q[transit][len(across) // 2]).distance > 0


def test_what_is_out_of_reach_is_listed(bottom) -> None:
    ws = panda(bottom)
    path = path_through(bottom, [(3.0, 3.0), (4.5, 3.0)])
    followed = ws.follow(path)
    first, last = followed.cut[0][0], followed.cut[-1][1]
    assert last == len(path.position) - 1
    assert followed.cut[-1][2] == "unreachable"
    assert [cut[0] for cut in followed.cut[1:]] == [cut[1] for cut in followed.cut[:-1]]
    assert len(followed.cut_by) == len(followed.cut)
    assert first == followed.sample.max()
    assert 3.2 < path.position[first, 0] < 3.6
    check_followed(ws, over(bottom), path, followed, tip_contact=True)


def test_where_nothing_is_reached_all_is_cut(bottom) -> None:
    path = path_through(bottom, [(5.0, 5.0), (5.2, 5.0)])
    followed = panda(bottom).follow(path)
    assert len(followed) == 0
    assert followed.q.shape == (0, 7)
    assert followed.cut == [(0, len(path.position) - 1, "unreachable")]


def test_standoff_keeps_the_tip_off(bottom) -> None:
    ws = panda(bottom)
    path = path_through(bottom, [(2.9, 2.9), (3.1, 3.1)], standoff=0.08)
    followed = ws.follow(path)
    assert followed.cut == []
    check_followed(ws, over(bottom), path, followed, tip_contact=False)
    assert ws.clearance(followed.q).distance.min() > 0.0


def test_the_papers_arm_moves_by_both_methods() -> None:
    ws = sampler(scene=flat_bottom(-1.1))
    target = np.array([1.4, 0.2, -0.9])
    damped = ws.move(Q_START, point=target)
    assert damped.status == "reached"
    assert damped.position_error <= 1e-4
    check_limits(ws, damped.path, damped.time)
    paper = ws.move(Q_START, point=target, method="pseudo_inverse")
    assert paper.status == "reached"
    alone = ws.arm.inverse(target, Q_START, task="position", method="pseudo_inverse")
    np.testing.assert_allclose(paper.path[-1], alone.q, atol=1e-9)
    check_limits(ws, paper.path, paper.time)


def test_a_target_inside_the_hull_halts_in_front_of_it() -> None:
    ws = sampler()
    inside = ws.move(Q_START, point=[0.1, 0.05, 0.0])
    assert inside.status in ("stuck", "at_limit")
    assert ws.clearance(inside.path).distance.min() > 0
    paper = ws.move(Q_START, point=[0.1, 0.05, 0.0], method="pseudo_inverse")
    assert paper.status in ("blocked", "at_limit")


def test_moves_are_refused_by_name() -> None:
    ws = sampler()
    with pytest.raises(ValueError, match=r"`point`: expected either it or `pose`, got neither"):
        ws.move(Q_START)
    with pytest.raises(ValueError, match=r"`q_start`: expected 3 values, got 2"):
        ws.move(Q_START[:2], point=[1, 0, 0])
    with pytest.raises(ValueError, match=r"`velocity`"):
        ws.move(Q_START, point=[1, 0, 0], velocity=0.0)
    with pytest.raises(ValueError, match=r"`point`"):
        ws.move(Q_START, point=[np.nan, 0, 0])
    with pytest.raises(ValueError, match=r"`method`"):
        ws.move(Q_START, point=[1, 0, 0], method="best")
