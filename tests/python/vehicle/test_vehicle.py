# SPDX-License-Identifier: BSD-3-Clause
"""Vehicles from Python: published figures, an independent integrator, worlds, files, bad input."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import bathyal

SURGE = [True, False, False, False, False, False]


@pytest.fixture(scope="module")
def remus():
    return bathyal.vehicles.remus100()


def test_surge_is_the_published_tanh(remus):
    motion = remus.simulate(np.eye(4), [3.86, 0, 0, 0, 0, 0], 60.0, free=SURGE)
    expected = 1.5436 * np.tanh(motion.time / 12.561)
    np.testing.assert_allclose(motion.velocity[:, 0], expected, atol=2e-4)
    assert motion.pose.shape == (6001, 4, 4)


def test_bluerov_reaches_its_published_speeds():
    rov = bathyal.vehicles.bluerov2_heavy()
    for axis, speed in enumerate([0.549, 0.480, 0.433]):
        free = [row == axis for row in range(6)]
        motion = rov.simulate(np.eye(4), 50.0 * np.eye(6)[axis], 60.0, free=free)
        assert motion.velocity[-1, axis] == pytest.approx(speed, abs=1e-3)


def test_an_independent_integrator_agrees_within_a_millimetre():
    """Fossen's equations written anew with numpy, solved by DOP853."""
    integrate = pytest.importorskip("scipy.integrate")
    rov = bathyal.vehicles.bluerov2_heavy().replace(mass=13.7)
    mass, added = rov.mass_matrix, rov.added_mass
    rigid = mass - added
    current = np.array([0.2, -0.1, 0.05])

    def thrust(time):
        return np.array([20 * np.sin(0.4 * time), 8, 2, 0, 0.5, 0.8 * np.cos(0.2 * time)])

    def cross(v):
        return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])

    def coriolis(m, v):
        linear, angular = np.split(m @ v, 2)
        return np.concatenate(
            [np.cross(v[3:], linear), np.cross(v[3:], angular) + np.cross(v[:3], linear)]
        )

    def rate(time, y):
        turn, v = y[3:12].reshape(3, 3), y[12:]
        water = np.concatenate([turn.T @ current, np.zeros(3)])
        relative = v - water
        change = np.concatenate([-np.cross(v[3:], water[:3]), np.zeros(3)])
        weight = turn.T @ [0, 0, -rov.mass * rov.gravity]
        lift = turn.T @ [0, 0, rov.water_density * rov.volume * rov.gravity]
        force = thrust(time) - coriolis(rigid, v) - coriolis(added, relative) + added @ change
        force[:3] += weight + lift
        force[3:] += np.cross(rov.center_of_mass, weight)
        force -= rov.linear_drag @ relative
        for row, a, b, absolute, coefficient in rov.terms:
            force[row] += (
                coefficient * relative[a] * (abs(relative[b]) if absolute else relative[b])
            )
        return np.concatenate(
            [turn @ v[:3], (turn @ cross(v[3:])).ravel(), np.linalg.solve(mass, force)]
        )

    start = np.concatenate([np.zeros(3), np.eye(3).ravel(), np.zeros(6)])
    found = integrate.solve_ivp(rate, (0, 60), start, method="DOP853", rtol=1e-11, atol=1e-12)
    motion = rov.simulate(
        np.eye(4), lambda time, pose, velocity: thrust(time), 60.0, step=0.01, current=current
    )
    expected = found.y[:, -1]
    assert np.linalg.norm(motion.pose[-1, :3, 3] - expected[:3]) < 1e-3
    assert np.linalg.norm(expected[:3]) > 5.0
    np.testing.assert_allclose(motion.pose[-1, :3, :3].ravel(), expected[3:12], atol=1e-4)


def test_a_vehicle_at_rest_stays_at_rest():
    rov = bathyal.vehicles.bluerov2_heavy()
    motion = rov.simulate(np.eye(4), np.zeros(6), 60.0)
    assert np.abs(motion.pose[-1] - np.eye(4)).max() < 1e-9


def test_a_uniform_current_is_a_moving_frame(remus):
    still = remus.simulate(np.eye(4), [3.86, 0.2, 0, 0, 0.1, 0.05], 60.0)
    current = np.array([0.4, -0.3, 0.0])
    carried = remus.simulate(
        (np.eye(4), [*current, 0, 0, 0]), [3.86, 0.2, 0, 0, 0.1, 0.05], 60.0, current=current
    )
    moved = carried.pose[:, :3, 3] - carried.time[:, None] * current
    np.testing.assert_allclose(moved, still.pose[:, :3, 3], atol=1e-9)


def test_the_water_of_a_world_moves_it():
    rov = bathyal.vehicles.bluerov2_heavy()
    world = bathyal.World()
    world.water = bathyal.Water(current=(0.3, 0.0, 0.0))
    by_world = rov.simulate(np.eye(4), np.zeros(6), 20.0, world=world)
    by_current = rov.simulate(np.eye(4), np.zeros(6), 20.0, current=[0.3, 0.0, 0.0])
    assert (by_world.pose == by_current.pose).all()
    assert by_world.pose[-1, 0, 3] > 1.0


def test_it_rests_on_the_bottom_and_floats_at_the_surface():
    world = bathyal.World()
    world.add(bathyal.make_seabed([20, 20], 1.0, seed=0), name="bottom")
    world.water = bathyal.Water(surface=10.0)
    start = np.eye(4)
    start[2, 3] = 5.0
    rov = bathyal.vehicles.bluerov2_heavy()
    heavy = rov.replace(mass=15.5).simulate(start, np.zeros(6), 60.0, world=world)
    ground = world.at(0.0).scene.cast(heavy.pose[-1, :3, 3][None], [[0.0, 0.0, -1.0]])
    assert 0.1 < ground.range[0] < 0.16
    light = rov.replace(mass=12.5).simulate(start, np.zeros(6), 60.0, world=world)
    assert 9.8 < light.pose[-1, 2, 3] < 10.1


def test_replace_and_pickle_keep_everything_else(remus):
    heavier = remus.replace(mass=40.0, name="heavy")
    assert (heavier.mass, heavier.name) == (40.0, "heavy")
    for name in ("inertia", "added_mass", "linear_drag", "parts", "center_of_mass"):
        np.testing.assert_array_equal(getattr(heavier, name), getattr(remus, name))
    assert heavier.terms == remus.terms
    again = pickle.loads(pickle.dumps(heavier))
    assert repr(again) == repr(heavier)
    np.testing.assert_array_equal(again.mass_matrix, heavier.mass_matrix)


def test_quadratic_drag_takes_the_place_of_its_terms():
    rov = bathyal.vehicles.bluerov2_heavy()
    doubled = rov.replace(quadratic_drag=[282, 434, 380, 2.38, 0.94, 3.0])
    assert sorted(doubled.terms) == sorted((*t[:4], 2 * t[4]) for t in rov.terms)


def test_tables_of_z_down_are_turned_once():
    numbers = dict(
        mass=10.0, volume=0.01, inertia=np.diag([1.0, 2.0, 3.0]), center_of_mass=[0.1, 0.2, 0.05]
    )
    turned = bathyal.Vehicle(**numbers, z_down=True)
    np.testing.assert_allclose(turned.center_of_mass, [0.1, -0.2, -0.05])
    assert turned.replace(mass=11.0).center_of_mass.tolist() == turned.center_of_mass.tolist()


def test_from_a_hulls_mesh():
    from bathyal.view.solids import box

    mesh = bathyal.TriangleMesh(*box(np.array([1.0, 0.4, 0.4])))
    vehicle, vehicle_from_mesh = bathyal.Vehicle.from_mesh(mesh, center_of_mass=[0, 0, -0.02])
    assert vehicle.volume == pytest.approx(0.16)
    assert vehicle.mass == pytest.approx(164.0)
    assert vehicle.added_mass[0, 0] < vehicle.added_mass[1, 1]
    np.testing.assert_allclose(vehicle_from_mesh, np.eye(4), atol=1e-12)
    swing = np.eye(4)
    swing[:3, :3] = [[1, 0, 0], [0, np.cos(0.2), -np.sin(0.2)], [0, np.sin(0.2), np.cos(0.2)]]
    assert vehicle.acceleration(swing, np.zeros(6))[3] < 0  # it rights itself


def test_read_vehicle(tmp_path):
    path = tmp_path / "vehicle.yaml"
    path.write_text(
        "vehicle:\n  name: box\n  mass: 10\n  volume: 0.01\n  center_of_mass: [0, 0, 0.02]\n"
        "  z_down: true\n  inertia: [1, 2, 3]\n  quadratic_drag: [10, 20, 30, 1, 2, 3]\n"
        "  terms: [{force: yaw, a: surge, b: sway, absolute: false, coefficient: 2}]\n"
        "  parts: [{center: [0.1, 0, 0], radius: 0.1}, {center: [-0.1, 0, 0], radius: 0.1}]\n"
    )
    vehicle = bathyal.read_vehicle(path)
    assert vehicle.name == "box"
    assert vehicle.center_of_mass[2] == -0.02
    assert (5, 0, 1, False, 2.0) in vehicle.terms  # both y and yaw are turned round
    assert vehicle.parts.shape == (2, 5)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("mass: 3\n", r":1:1: .*expected volume, or a preset or a hull"),
        ("preset: remus100\nmas: 3\n", r":2:1: mas: this key is not known"),
        ("preset: remus100\nmass: 0\n", r":2:1: mass: expected greater than 0, got 0"),
        ("preset: remus100\nmass: .nan\n", r":2:1: mass: "),
        ("preset: remus100\nz_down: true\n", r"expected z_down with numbers alone"),
        ("preset: nautilus\n", r":1:1: preset: .*remus100"),
        ("hull: {mesh: ../hull.stl}\n", r":1:8: hull.mesh: .*lies outside"),
        ("hull: {mesh: hull.stl}\n", r":1:8: hull.mesh: no such file"),
        ("preset: remus100\nadded_mass: [1, 2, 3]\n", r":2:1: added_mass"),
        ("preset: remus100\ninertia: [-1, 2, 3]\n", r"inertia"),
        ("mass: 1\nmass: 2\n", r":2:1: key 'mass' comes twice"),
    ],
)
def test_mistakes_of_a_file_are_reported_by_line(tmp_path, text, message):
    path = tmp_path / "vehicle.yaml"
    path.write_text(text)
    with pytest.raises(bathyal.Error, match=message):
        bathyal.read_vehicle(path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"mass": 0.0}, "mass"),
        ({"mass": np.nan}, "mass"),
        ({"inertia": np.zeros((3, 3)), "added_mass": None}, "inertia"),
        ({"added_mass": -np.eye(6)}, "added_mass"),
        ({"added_mass": np.triu(np.ones((6, 6)))}, "added_mass"),
        ({"parts": [[0.5, 0, 0, 0.1, 1]]}, "parts"),
        ({"parts": [[0, 0, 0, -0.1, 1]]}, "parts radius"),
        ({"weight": 3}, "weight.: expected one of mass, inertia"),
        ({"quadratic_drag": [1, 2]}, "quadratic_drag"),
        ({"terms": [(7, 0, 0, True, 1.0)]}, "terms"),
    ],
)
def test_bad_values_are_named(remus, change, message):
    with pytest.raises((ValueError, TypeError), match=message):
        remus.replace(**change)


def test_bad_calls_of_simulate_are_named(remus):
    good = dict(state=np.eye(4), thrust=np.zeros(6), duration=1.0)
    for change, message in [
        ({"state": np.ones((4, 4))}, "state"),
        ({"state": (np.eye(4), [1.0])}, "state"),
        ({"thrust": [1, 2, 3]}, "thrust"),
        ({"thrust": lambda time, pose, velocity: [np.nan] * 6}, "thrust"),
        ({"duration": -1.0}, "duration"),
        ({"step": 0.0}, "step"),
        ({"step": 5.0}, "step.: expected at most .* the limit of the fastest mode, in roll"),
        ({"current": [1, 2]}, "current"),
        ({"free": [True]}, "free"),
    ]:
        with pytest.raises((ValueError, TypeError), match=message):
            remus.simulate(**{**good, **change})
