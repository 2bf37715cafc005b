# SPDX-License-Identifier: BSD-3-Clause
"""Paths of fish: smooth, in their region, and never nearer to the scene than the clearance."""

from __future__ import annotations

import math

import numpy as np
import pytest

import bathyal


@pytest.fixture(scope="module")
def rough() -> bathyal.Scene:
    seabed = bathyal.make_seabed(
        60, 0.5, seed=2, relief_rms=0.5, boulder_density=0.02, boulder_radius=2.0,
        cliff_height=5.0, cliff_run=1.0,
    )  # fmt: skip
    post = bathyal.make_mine("cylinder", length=0.5, diameter=6.0)  # a disc on edge
    return bathyal.Scene([seabed, post])


def poses(paths: list[bathyal.Trajectory]) -> np.ndarray:
    return np.array([path.pose for path in paths])


@pytest.mark.parametrize("clearance", [0.1, 0.8])
def test_no_path_is_nearer_than_the_clearance(rough: bathyal.Scene, clearance: float) -> None:
    paths = bathyal.fish_paths(rough, 30, 120.0, seed=1, clearance=clearance, altitude=0.0)
    points = poses(paths)[:, :, :3, 3]
    ends = points[:, :-1].reshape(-1, 3), points[:, 1:].reshape(-1, 3)
    assert rough.nearest_segments(*ends).distance.min() >= clearance
    between = np.concatenate([path.at(np.linspace(0, 120, 3001))[:, :3, 3] for path in paths])
    assert rough.nearest(between).distance.min() >= clearance - 1e-9
    # They do swim near the bottom, not just high above it.
    assert np.median(rough.nearest(between).distance) < clearance + 2.0


def test_paths_are_smooth_and_of_the_speed_asked_for(rough: bathyal.Scene) -> None:
    pose = poses(bathyal.fish_paths(rough, 10, 100.0, speed=0.9, step=0.2))
    move = np.diff(pose[:, :, :3, 3], axis=1)
    along = np.linalg.norm(move[:, :, :2], axis=2) / 0.2
    assert np.abs(along - 0.9).max() < 0.03
    unit = move / np.linalg.norm(move, axis=2, keepdims=True)
    turn = np.arccos(np.clip(np.sum(unit[:, 1:] * unit[:, :-1], axis=2), -1, 1))
    assert turn.max() < 0.6
    ahead = np.sum(pose[:, 1:-1, :3, 0] * (unit[:, 1:] + unit[:, :-1]) / 2, axis=2)
    assert ahead.min() > 0.9
    assert pose[:, :, 2, 2].min() > 0.3  # backs up, over a cliff too
    rotation = pose[:, :, :3, :3]
    off = rotation @ rotation.swapaxes(2, 3) - np.eye(3)
    assert np.abs(off).max() < 1e-12


def test_paths_stay_in_their_region_and_under_the_ceiling(rough: bathyal.Scene) -> None:
    points = poses(
        bathyal.fish_paths(rough, 20, 200.0, region=[(-20, -5), (-4, 9)], ceiling=5.5, seed=3)
    )[:, :, :3, 3]
    assert (points[:, :, :2] >= [-20, -5]).all()
    assert (points[:, :, :2] <= [-4, 9]).all()
    assert points[:, :, 2].max() < 5.5


def test_paths_are_seeded_and_the_same_for_any_number_of_threads(rough: bathyal.Scene) -> None:
    one = poses(bathyal.fish_paths(rough, 6, 30.0, seed=5, num_threads=1))
    four = poses(bathyal.fish_paths(rough, 9, 30.0, seed=5, num_threads=4))
    assert one.tobytes() == four[:6].tobytes()
    assert not np.array_equal(one, poses(bathyal.fish_paths(rough, 6, 30.0, seed=6)))
    assert bathyal.fish_paths(rough, 0, 30.0) == []


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("count", {"count": -1}), ("duration", {"duration": 0}),
        ("duration", {"duration": math.nan}), ("clearance", {"clearance": 0}),
        ("clearance", {"clearance": math.nan}), ("speed", {"speed": 0}), ("step", {"step": 0}),
        ("step", {"duration": 1e9}), ("ceiling", {"ceiling": math.nan}),
        ("region", {"region": [(0, 0), (0, 1)]}), ("region", {"region": [(0, 0)]}),
        ("region", {"region": [(500, 500), (600, 600)]}), ("region", {"ceiling": -10.0}),
        ("region", {"region": [(0, 0), (math.nan, 1)]}),
    ],
)  # fmt: skip
def test_what_leaves_no_path_is_refused_by_name(rough, name, options) -> None:
    with pytest.raises(ValueError, match=f"`{name}`"):
        bathyal.fish_paths(rough, **{"count": 2, "duration": 20.0, **options})
