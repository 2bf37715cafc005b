# SPDX-License-Identifier: BSD-3-Clause
"""Materials by value, what a world lists of its objects, and of what is made what rays meet."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import bathyal
from tests.support.motions import rising

SQUARE = [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]


def plate(half: float = 9.0) -> bathyal.TriangleMesh:
    return bathyal.TriangleMesh(np.array(SQUARE) * half / 9, [[0, 1, 2], [0, 2, 3]])


@pytest.fixture
def world() -> bathyal.World:
    world = bathyal.World()
    world.add(plate(), material="sand", name="bottom")
    return world


def test_materials_come_by_name_and_by_row(world):
    for row, name in enumerate(world.materials):
        assert world.material(row) == world.material(name)
        assert world.material(name).name == name
    sand = world.material("sand")
    assert sand.strength == pytest.approx(10**-2.2)
    assert sand.angle is None
    assert sand.backscatter is None
    assert sand.sediment == bathyal.Sediment()  # the default is sand's
    assert world.material("steel").sediment is None
    assert world.material(np.int32(1)).name == world.materials[1]


def test_a_material_is_set_as_it_is(world):
    sediment = bathyal.Sediment(density_ratio=2.0, loss=0.02)
    shell = bathyal.Material("shell", 0.05, angle=[0, 1], backscatter=[-10, -20], sediment=sediment)
    world.set_material(shell)
    assert world.material("shell") == shell
    assert world.materials[-1] == "shell"
    by_parts = bathyal.World()
    by_parts.set_material("shell", 0.05, angle=[0, 1], backscatter=[-10, -20], sediment=sediment)
    assert by_parts.material("shell") == shell
    assert shell != bathyal.Material("shell", 0.05, angle=[0, 1], backscatter=[-10, -21])
    assert len({shell, pickle.loads(pickle.dumps(shell))}) == 1
    assert shell.backscatter.tolist() == [-10, -20]


def test_a_sediment_of_its_own_is_what_the_sonar_computes_from(world):
    sonar = bathyal.sonars.side_scan().replace(backscatter="material")
    angles = np.linspace(0.1, 1.2, 5)
    gravel = world.material("gravel").sediment
    world.set_material("mine", 1.0, sediment=gravel)
    mine = sonar.scattering_strength(world, "mine", angles)
    np.testing.assert_array_equal(mine, sonar.scattering_strength(world, "gravel", angles))
    world.set_material("mine", 1.0, sediment=bathyal.Sediment(density_ratio=1.2))
    assert not np.allclose(mine, sonar.scattering_strength(world, "mine", angles))


@pytest.mark.parametrize(
    ("action", "text"),
    [
        (lambda w: w.material("snow"), "`material`"),
        (lambda w: w.material(99), "`name`.*row from 0 to 11, got 99"),
        (lambda w: w.material(-1), "`name`"),
        (lambda w: w.material(1.5), "`name`.*got float"),
        (lambda w: w.set_material(3), "`name`.*got int"),
        (lambda w: w.set_material(w.material(0), 0.5), "`name`"),
        (lambda w: w.set_material("a", sediment=3), "`sediment`.*got int"),
        (lambda w: bathyal.Sediment(density_ratio=0), "`density_ratio`"),
        (lambda w: bathyal.Sediment(spectral_exponent=5), "`spectral_exponent`"),
        (lambda w: bathyal.Material(""), "`name`"),
        (lambda w: bathyal.Material("a", -1), "`strength`"),
    ],
)
def test_mistakes_name_what_is_wrong(world, action, text):
    with pytest.raises(ValueError, match=text):
        action(world)
    assert len(world.materials) == 12


def test_objects_are_listed(world):
    pose = np.eye(4)
    pose[:3, 3] = 1, 2, 3
    world.add(plate(1), pose, "steel", "plate", scale=2.0)
    world.add(plate(1), rising, "rock", "riser")
    assert world.paint("bottom", [[-9, -9], [9, -9], [9, 9]], "mud") == 1
    bottom, steel, riser = world.objects
    assert [one.name for one in world.objects] == world.names
    assert [one.material for one in world.objects] == ["sand", "steel", "rock"]
    assert [one.painted for one in world.objects] == [True, False, False]
    assert [one.moves for one in world.objects] == [False, False, True]
    assert [one.scale for one in world.objects] == [1, 2, 1]
    np.testing.assert_array_equal(steel.pose(), pose)
    np.testing.assert_array_equal(steel.mesh.vertices, plate(1).vertices)
    assert riser.pose(3.0)[2, 3] == 5
    assert repr(bottom) == 'WorldObject("bottom", sand)'
    assert repr(riser) == 'WorldObject("riser", rock, moves)'


def test_hits_know_their_material(world):
    world.add(plate(1), [[1, 0, 0, 5], [0, 1, 0, 5], [0, 0, 1, 1], [0, 0, 0, 1]], "steel", "plate")
    world.paint("bottom", [[-9, -9], [9, -9], [9, 9]], "mud")  # the first of its triangles
    now = world.at(0)
    down = [0, 0, -1]
    hits = now.scene.cast([[5, 5, 9], [3, -3, 9], [-3, 3, 9], [50, 0, 9]], [down] * 4)
    rows = now.material(hits)
    assert rows.dtype == np.int32
    assert [now.materials[row].name for row in rows[:3]] == ["steel", "mud", "sand"]
    assert rows[3] == -1
    assert [material.name for material in now.materials] == world.materials
    only = bathyal.World()
    only.add(plate())
    with pytest.raises(ValueError, match="`hits`: expected those of this snapshot's scene"):
        only.at(0).material(hits)
