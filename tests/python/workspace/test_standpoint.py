# SPDX-License-Identifier: BSD-3-Clause
"""Where a vehicle should be for its arm to reach targets on the bottom."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal

ARM = bathyal.arms.maevskiy_zanin()
MOUNT = np.eye(4)
MOUNT[:3, 3] = 0.75, 0.0, -0.25
HALF = np.array([0.7, 0.25, 0.2])
QUICK = {"radii": 0.03, "voxel": 0.08, "headings": 8, "step": 0.16, "refined": 6}


def box() -> bathyal.Hull:
    corners = HALF * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
    faces += [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    return bathyal.Hull(bathyal.TriangleMesh(corners, faces))


def slope(steepness: float) -> bathyal.Scene:
    square = np.array([[-4, -4, 0], [4, -4, 0], [4, 4, 0], [-4, 4, 0]], dtype=float)
    square[:, 2] = steepness * square[:, 0]
    return bathyal.Scene(bathyal.TriangleMesh(square, [[0, 1, 2], [0, 2, 3]]))


def hull_points(pose: np.ndarray) -> np.ndarray:
    """A dense set of points of the box's surface, in the world."""
    side = np.linspace(-1, 1, 40)
    u, v = (part.ravel() for part in np.meshgrid(side, side))
    faces = [
        np.insert(np.stack([u, v], axis=1), axis, sign, axis=1)
        for axis in range(3)
        for sign in (-1, 1)
    ]
    return (HALF * np.concatenate(faces)) @ pose[:3, :3].T + pose[:3, 3]


@pytest.mark.parametrize("steepness", [0.0, 0.6])
def test_targets_are_reached_as_check_target_says(steepness: float) -> None:
    scene = slope(steepness)
    along = np.linspace(-0.3, 0.3, 4)
    targets = np.stack([along, 0.5 * along, steepness * along + 0.03], axis=1)
    found = bathyal.best_standpoint(ARM, MOUNT, box(), scene, targets, **QUICK)
    assert found.status == "all"
    assert found
    assert len(found.reached) == 4
    for place in [found, *found.alternatives]:
        ws = bathyal.Workspace(
            ARM, MOUNT, hull=box(), scene=scene, vehicle_pose=place.pose, radii=0.03
        )
        free = np.asarray(ws.check_target(targets).status) == "free"
        np.testing.assert_array_equal(place.reached, free)
        assert 0 < place.score - free.sum() < 1
        points = hull_points(place.pose)
        height = (points[:, 2] - steepness * points[:, 0]) / np.hypot(1, steepness)
        assert height.min() >= 0.05 - 1e-9
        np.testing.assert_allclose(place.pose[2, :3], [0, 0, 1], atol=1e-15)
    scores = [found.score, *(place.score for place in found.alternatives)]
    assert scores == sorted(scores, reverse=True)
    assert all(not place.alternatives for place in found.alternatives)


def test_no_drawn_pose_with_room_is_better() -> None:
    scene, hull = slope(0.3), box()
    random = np.random.default_rng(1)
    targets = random.uniform([-0.9, -0.9, 0.0], [0.9, 0.9, 0.0], (6, 3))
    targets[:, 2] = 0.3 * targets[:, 0] + 0.04
    found = bathyal.best_standpoint(ARM, MOUNT, hull, scene, targets, **QUICK)
    best = 0
    for _ in range(150):
        pose = np.eye(4)
        heading = random.uniform(0, 2 * np.pi)
        c, s = np.cos(heading), np.sin(heading)
        pose[:2, :2] = [[c, -s], [s, c]]
        pose[:2, 3] = random.uniform(-1.5, 1.5, 2)
        pose[2, 3] = 0.3 * pose[0, 3] + random.uniform(0.3, 1.2)
        points = hull_points(pose)
        if np.min(points[:, 2] - 0.3 * points[:, 0]) / np.hypot(1, 0.3) < 0.05:
            continue
        ws = bathyal.Workspace(ARM, MOUNT, hull=hull, scene=scene, vehicle_pose=pose, radii=0.03)
        best = max(best, int(np.sum(np.asarray(ws.check_target(targets).status) == "free")))
    assert best > 0
    assert found.reached.sum() >= best


def test_why_there_is_none() -> None:
    over = bathyal.KeepOut.half_space((0, 0, 1), 50.0, frame="world", name="all")
    found = bathyal.best_standpoint(
        ARM, MOUNT, box(), slope(0.0), [[0, 0, 0.02]], keepouts=[over], **QUICK
    )
    assert not found
    assert found.status == "no_room"
    assert "keep-out" in found.reason
    assert found.pose is None
    assert found.score == 0.0
    np.testing.assert_array_equal(found.reached, [False])
    assert found.alternatives == []


@pytest.mark.parametrize(
    ("targets", "options", "name"),
    [
        (np.zeros((0, 3)), {}, "targets"),
        ([[0, 0, np.nan]], {}, "targets"),
        ([[0, 0]], {}, "targets"),
        ([[0, 0, 0]], {"voxel": 0.0}, "voxel"),
        ([[0, 0, 0]], {"headings": 0}, "headings"),
        ([[0, 0, 0]], {"hull_clearance": -0.1}, "hull_clearance"),
    ],
)
def test_bad_input_is_refused(targets: np.ndarray, options: dict[str, float], name: str) -> None:
    with pytest.raises(ValueError, match=f"`{name}`"):
        bathyal.best_standpoint(ARM, MOUNT, None, None, targets, **{"radii": 0.03, **options})
