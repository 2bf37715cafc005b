# SPDX-License-Identifier: BSD-3-Clause
"""A world that is pickled, and copied, is the same world."""

from __future__ import annotations

import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import bathyal
from tests.support.motions import rising

TERRAIN = bathyal.make_seabed(size=[30, 20], spacing=0.5, seed=3, depth=12, relief_rms=0.3)


@pytest.fixture
def world() -> bathyal.World:
    world = bathyal.World()
    world.set_material("shell", 0.05, angle=[0, 1], backscatter=[-10, -20])
    world.set_material("sand", 0.02)
    world.water = bathyal.Water(
        surface=0.5, temperature=8, tide=bathyal.Tide([("M2", (1.2, 0.3))]), current=[0.2, 0.1]
    )
    world.add(TERRAIN, material="sand", name="bottom")
    world.add_clones(bathyal.make_boulder(0.3, seed=1), 40, "rock", "stone", seed=2)
    path = bathyal.Trajectory([0, 8], np.stack([np.eye(4), rising(5)]))
    world.add(bathyal.make_boulder(1.0), path, "steel", "moving", scale=0.5)
    world.add(bathyal.make_boulder(0.5), rising, "shell", "riser")
    world.paint("bottom", [[-5, -20], [5, -20], [5, 20], [-5, 20]], "mud")
    world.paint("stone_3", [[-50, -50], [50, -50], [50, 50], [-50, 50]], "shell")
    return world


def ping(world: bathyal.World, time: float) -> np.ndarray:
    sonar = bathyal.sonars.side_scan(physics="real")
    pose = np.eye(4)
    pose[2, 3] = -6
    return sonar.ping(world, pose, time=time, seed=4)


def same(one: bathyal.World, other: bathyal.World) -> None:
    assert one.names == other.names
    assert [one.material(name) for name in one.materials] == [
        other.material(name) for name in other.materials
    ]
    for time in (0.0, 3.0):
        first, second = ping(one, time), ping(other, time)
        assert np.array_equal(first.intensity, second.intensity)
        assert np.array_equal(first.truth.material, second.truth.material)
    assert first.intensity.max() > 0
    assert {*first.truth.material.ravel()} >= {one.materials.index(m) for m in ("sand", "mud")}


def test_the_copy_is_the_same_and_stays_it(world):
    back = pickle.loads(pickle.dumps(world))
    same(world, back)
    assert pickle.dumps(back) == pickle.dumps(world)
    assert [one.moves for one in back.objects] == [one.moves for one in world.objects]
    same(world, copy.deepcopy(world))
    back.paint("bottom", [[-50, -50], [50, -50], [50, 50], [-50, 50]], "silt")
    back.set_material("shell", 0.9)
    assert world.material("shell").strength == 0.05
    assert not np.array_equal(ping(back, 0).intensity, ping(world, 0).intensity)


def test_clones_share_their_mesh_in_the_file(world):
    whole = len(pickle.dumps(world))
    stone = bathyal.make_boulder(0.3, seed=1)
    world.add_clones(stone, 200, "rock", "more", seed=7)
    mesh = stone.vertices.nbytes + stone.triangles.nbytes
    assert len(pickle.dumps(world)) - whole < 200 * mesh / 4
    scene = pickle.loads(pickle.dumps(world)).scene
    first, *others = [scene.meshes[row].vertices for row in (1, 2, 40)]
    assert all(np.shares_memory(first, other) for other in others)


def test_another_process_answers_the_same(world):
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        answer = pool.apply(world_depths, (world,))
    assert answer == world_depths(world)


def world_depths(world: bathyal.World) -> list[float]:
    rays = [[x, 0.1, 5] for x in range(-10, 10)]
    return world.at(2.0).scene.cast(rays, [[0, 0, -1]] * len(rays)).range.tolist()


def test_a_function_without_a_name_is_a_type_error(world):
    world.add(bathyal.make_boulder(0.5), lambda time: np.eye(4), name="nameless")
    with pytest.raises(TypeError, match=r'`pose` of "nameless": .*finds by its name in a module'):
        pickle.dumps(world)


def test_states_that_lie_are_refused(world):
    state = world.__getstate__()
    name, _, pose, scale, whole, paint = state[2][0]
    for lie in (
        (name, 99, pose, scale, whole, paint),
        (name, 0, pose, scale, 99, None),
        (name, 1, pose, scale, whole, paint),
        (name, 0, pose, scale, whole, 99),
        (name, 0, pose, -1.0, whole, paint),
        ("", 0, pose, scale, whole, paint),
    ):
        empty = bathyal.World.__new__(bathyal.World)
        with pytest.raises((ValueError, IndexError)):
            empty.__setstate__((*state[:2], [lie], *state[3:]))


def test_meshes_come_back_whole():
    mesh = bathyal.TriangleMesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
        [[0, 1, 2]],
        attributes={"red": [1.0, 2.0, 3.0]},
        crs="EPSG:32602",
        vertical_datum="MSL",
    )
    back = pickle.loads(pickle.dumps(mesh))
    np.testing.assert_array_equal(back.vertices, mesh.vertices)
    np.testing.assert_array_equal(back.triangles, mesh.triangles)
    assert back.attributes["red"].tolist() == [1, 2, 3]
    assert (back.crs, back.vertical_datum) == ("EPSG:32602", "MSL")
