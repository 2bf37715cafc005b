# SPDX-License-Identifier: BSD-3-Clause
"""Worlds from Python: objects, what moves, clones, paint; against closed forms."""

from __future__ import annotations

import gc
import math
import threading
import weakref

import numpy as np
import pytest

import bathyal

DOWN = [0.0, 0.0, -1.0]


def plane(half: int = 10, slope: float = 0.0) -> bathyal.TriangleMesh:
    """Cells of 1 m, z = slope · x."""
    axis = np.arange(-half, half + 1.0)
    x, y = (part.ravel() for part in np.meshgrid(axis, axis))
    side = len(axis)
    low = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    lower = np.column_stack([low, low + 1, low + side + 1])
    upper = np.column_stack([low, low + side + 1, low + side])
    return bathyal.TriangleMesh(np.column_stack([x, y, slope * x]), np.vstack([lower, upper]))


def moved(x: float, y: float, z: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def height(scene: bathyal.Scene, x: float, y: float) -> float:
    return float(50 - scene.cast([[x, y, 50]], [DOWN]).range[0])


@pytest.fixture
def world() -> bathyal.World:
    world = bathyal.World()
    world.add(plane(), material="sand", name="bottom")
    return world


def test_rows_are_the_order_of_adding(world):
    assert world.add(plane(1), moved(3, 0, 2), "steel", "plate", scale=0.5) == 1
    assert world.add(plane(1), moved(-3, 0, 2)) == 2
    assert world.names == ["bottom", "plate", "object_2"]
    assert len(world) == 3
    assert repr(world) == "World(3 objects)"
    hits = world.scene.cast([[3.3, 0.1, 50], [3.7, 0.1, 50], [-3.7, 0.1, 50]], [DOWN] * 3)
    assert hits.mesh.tolist() == [1, 0, 2]
    np.testing.assert_allclose(hits.range, [48, 50, 48], rtol=1e-15)


def test_objects_are_met_where_they_are(world):
    there_and_back = bathyal.Trajectory(
        [0, 4, 8], [moved(-5, 0, 3), moved(5, 0, 3), moved(-5, 0, 3)]
    )
    world.add(plane(1), there_and_back, name="train")
    world.add(plane(1), lambda time: moved(0, 5 * math.cos(time), 6), name="swing")
    for time in (0.0, 1.5, 4.0, 7.0):
        scene = world.at(time).scene
        x = -5 + 2.5 * min(time, 8 - time)
        assert height(scene, x + 0.4, 0.7) == pytest.approx(
            6 if abs(5 * math.cos(time) - 0.7) < 1 and abs(x + 0.4) < 1 else 3, abs=1e-12
        )
        assert height(scene, 0.3, 5 * math.cos(time) - 0.4) == pytest.approx(6, abs=1e-12)
        assert height(scene, 9.3, 9.4) == pytest.approx(0, abs=1e-12)
    assert world.at(1.5).time == 1.5


def test_function_is_asked_for_the_time_and_dropped_with_its_world():
    asked = []

    class Swing:
        def __call__(self, time):
            asked.append(time)
            return np.eye(4)

    swing = Swing()
    dropped = weakref.ref(swing)
    world = bathyal.World()
    world.add(plane(1), swing)
    world.at(2.5)
    assert set(asked) == {2.5}
    del swing
    gc.collect()
    assert dropped() is not None
    del world
    gc.collect()
    assert dropped() is None


def test_threads_share_a_world_whose_poses_are_python_functions(world):
    world.add(plane(1), lambda time: moved(time, 0, 2), name="plate")
    wrong = []

    def ask(start: float) -> None:
        for step in range(20):
            time = start + 0.1 * step
            if abs(height(world.at(time).scene, time + 0.3, 0.6) - 2) > 1e-12:
                wrong.append(time)

    threads = [threading.Thread(target=ask, args=(start,)) for start in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30)
    assert not any(thread.is_alive() for thread in threads)
    assert wrong == []


def test_errors_of_a_function_arrive(world):
    faults = {"zero": ZeroDivisionError, "matrix": ValueError, "own": ValueError}
    for name, kind in faults.items():
        broken = bathyal.World()

        def pose(time, name=name, broken=broken):
            if name == "own":
                broken.at(time)
            return np.zeros((4, 4)) if name == "matrix" else np.eye(4) * (1 / (name != "zero"))

        broken.add(plane(1), pose)
        with pytest.raises(kind):
            broken.at(1.0)


def test_paint_is_what_a_ping_meets(world):
    # 3 by 2 cells, two triangles each.
    assert world.paint("bottom", [[0, 0], [3, 0], [3, 2], [0, 2]], "rock") == 12
    sonar = bathyal.sonars.echo_sounder()
    for x, expected in ((1.4, "rock"), (-1.6, "sand")):
        ping = sonar.ping(world, moved(x, 1.3, 0.4))
        seen = ping.truth.material[np.isfinite(ping.truth.range)]
        assert {world.materials[row] for row in seen} == {expected}


def test_material_sets_how_strong_an_echo_is(world):
    world.set_material("half", 0.5)
    world.set_material("whole", 1.0)
    total = []
    for name in ("half", "whole"):
        one = bathyal.World()
        one.set_material("half", 0.5)
        one.set_material("whole", 1.0)
        one.add(plane(), material=name)
        total.append(bathyal.sonars.echo_sounder().ping(one, moved(0.2, 0.3, 5)).intensity.sum())
    assert total[1] > 0
    assert total[0] == pytest.approx(0.5 * total[1], rel=1e-12)


@pytest.mark.parametrize("slope", [0.0, 0.3])
def test_clones_lie_on_the_ground(slope):
    world = bathyal.World()
    world.add(plane(20, slope), name="bottom")
    made = bathyal.make_boulder(0.3, seed=1)
    stone = bathyal.TriangleMesh(made.vertices - [0, 0, 0.2], made.triangles)  # foot off origin
    low, high = (float(pick(stone.vertices[:, 2])) for pick in (np.min, np.max))
    first = world.add_clones(
        stone, 40, name="stone", seed=5,
        region=[-9, -8, 7, 6], scale=[0.5, 2], tilt=0, sunk=0.25, apart=1,
    )  # fmt: skip
    assert first == 1
    assert world.names[1:] == [f"stone_{i}" for i in range(40)]
    poses, scales = world.scene.poses[1:], np.array(world.scene.scales[1:])
    at = np.array(poses)[:, :3, 3]
    assert (at[:, :2] >= [-9, -8]).all()
    assert (at[:, :2] <= [7, 6]).all()
    assert scales.min() >= 0.5
    assert scales.max() <= 2
    sunk = slope * at[:, 0] - (at[:, 2] + scales * low)
    np.testing.assert_allclose(sunk, 0.25 * scales * (high - low), atol=1e-12)
    away = np.linalg.norm(at[:, None, :2] - at[None, :, :2], axis=2) + 1e9 * np.eye(40)
    assert away.min() >= 1


def test_clones_of_a_seed_are_the_same_bytes():
    def poses(seed):
        world = bathyal.World()
        world.add(plane())
        world.add_clones(bathyal.make_boulder(0.3), 20, seed=seed)
        return np.array(world.scene.poses).tobytes()

    assert poses(3) == poses(3)
    assert poses(3) != poses(4)


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        (lambda w, m: w.add(m, name="bottom"), "`name`"),
        (lambda w, m: w.add(m, material="cheese"), "`material`"),
        (lambda w, m: w.add(m, 2 * np.eye(4)), "`pose`"),
        (lambda w, m: w.add(m, np.full((4, 4), np.nan)), "`pose`"),
        (lambda w, m: w.add(m, scale=0), "`scale`"),
        (lambda w, m: w.add(m, scale=np.inf), "`scale`"),
        (lambda w, m: w.at(np.nan), "`time`"),
        (lambda w, m: w.paint("roof", [[0, 0], [1, 0], [0, 1]], "mud"), "`object`"),
        (lambda w, m: w.paint("bottom", [[0, 0], [1, 0]], "mud"), "`polygon`"),
        (lambda w, m: w.paint("bottom", [[0, 0], [1, 0], [np.inf, 1]], "mud"), "`polygon`"),
        (lambda w, m: w.paint("bottom", [0, 0, 1], "mud"), "`polygon`"),
        (lambda w, m: w.set_material("", 1), "`name`"),
        (lambda w, m: w.set_material("a", -1), "`strength`"),
        (lambda w, m: w.set_material("a", angle=[0, 1], backscatter=[1]), "`angle`"),
        (lambda w, m: w.set_material("a", angle=[0, 2], backscatter=[1, 1]), "`angle`"),
        (lambda w, m: w.add_clones(m, -1), "`count`"),
        (lambda w, m: w.add_clones(m, 1, scale=[2, 1]), "`scale`"),
        (lambda w, m: w.add_clones(m, 1, region=[0, 0, 0, 1]), "`region`"),
        (lambda w, m: w.add_clones(m, 1, region=[50, 50, 51, 51]), "`count`"),
        (lambda w, m: w.add_clones(m, 1, tilt=-1), "`tilt`"),
        (lambda w, m: w.add_clones(m, 1, sunk=1.5), "`sunk`"),
        (lambda w, m: w.add_clones(m, 1, apart=np.nan), "`apart`"),
    ],
)
def test_what_cannot_be_is_refused_and_leaves_the_world_as_it_was(world, fault, message):
    before = world.names, world.materials
    with pytest.raises(ValueError, match=message):
        fault(world, plane(1))
    assert (world.names, world.materials) == before


def test_an_empty_world_says_so():
    with pytest.raises(ValueError, match="`world`: expected one object or more, got none"):
        _ = bathyal.World().scene


def test_a_picture_shows_what_lies_above(world):
    world.add(plane(2), moved(4, -3, 5))
    figure = world.show()
    shaded, heights = (image.get_array() for image in figure.axes[0].images)
    assert figure.axes[0].images[1].get_extent() == [-10, 10, -10, 10]
    cells = np.asarray(heights)
    row, column = (int((v + 10) / 20 * cells.shape[0]) for v in (-3, 4))
    assert cells[row, column] == pytest.approx(5, abs=1e-9)
    assert cells[20, 20] == pytest.approx(0, abs=1e-9)
    assert np.asarray(shaded)[row, column, :3].tolist() != np.asarray(shaded)[20, 20, :3].tolist()
