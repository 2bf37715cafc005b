"""Bodies in water against closed forms, and what must be refused."""

import math
import pickle
from pathlib import Path

import numpy as np
import pytest

import bathyal

SURGE = [True, False, False, False, False, False]
STILL = np.eye(4)


def ball(mass=100.0, radius=0.3, **changes):
    """A neutral sphere with its own added mass; nothing rights it, nothing brakes it."""
    options = {
        "mass": mass,
        "inertia": 0.4 * mass * radius**2 * np.eye(3),
        "center_of_mass": [0, 0, 0],
        "volume": mass / 1025.0,
        "added_mass": bathyal.ellipsoid_added_mass([radius] * 3),
    }
    return bathyal.Vehicle(**{**options, **changes})


def turn(axis, angle):
    """(4, 4) of a rotation about a world's axis."""
    out = np.eye(4)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    out[i, i] = out[j, j] = math.cos(angle)
    out[i, j], out[j, i] = -math.sin(angle), math.sin(angle)
    return out


# Added mass


@pytest.mark.parametrize("radius", [1e-3, 0.3, 20.0])
def test_the_added_mass_of_a_sphere_is_half_the_displaced_water(radius):
    added = bathyal.ellipsoid_added_mass([radius] * 3, water_density=1000.0)
    half = 0.5 * 1000.0 * 4 / 3 * np.pi * radius**3
    np.testing.assert_allclose(added[:3, :3], half * np.eye(3), rtol=1e-9, atol=1e-12 * half)
    np.testing.assert_allclose(added[3:, 3:], 0, atol=1e-9 * half * radius**2)


def test_a_spheroid_of_four_to_one_has_lambs_coefficients():
    added = np.diag(bathyal.ellipsoid_added_mass([2.0, 0.5, 0.5], water_density=1000.0))
    water = 1000.0 * 4 / 3 * np.pi * 2.0 * 0.25
    inertia = water * (2.0**2 + 0.5**2) / 5
    np.testing.assert_allclose(added[:3] / water, [0.0816, 0.8598, 0.8598], atol=6e-5)
    np.testing.assert_allclose(added[3:] / inertia, [0, 0.6079, 0.6079], atol=6e-5)


def test_added_mass_follows_the_order_of_the_axes():
    first = np.diag(bathyal.ellipsoid_added_mass([1.0, 2.0, 3.0]))
    other = np.diag(bathyal.ellipsoid_added_mass([3.0, 1.0, 2.0]))
    np.testing.assert_allclose(other, first[[2, 0, 1, 5, 3, 4]], rtol=1e-9)


def test_a_flat_disc_has_the_added_mass_of_a_disc():
    added = bathyal.ellipsoid_added_mass([1.0, 1.0, 1e-4], water_density=1000.0)
    assert added[2, 2] == pytest.approx(8 / 3 * 1000.0, rel=1e-3)  # Lamb, art. 102: 8/3 ρ a³


@pytest.mark.parametrize(
    "axes", [[0, 1, 1], [-1, 1, 1], [math.nan, 1, 1], [math.inf, 1, 1], [1, 1]]
)
def test_half_axes_that_are_none_are_refused(axes):
    with pytest.raises((ValueError, TypeError), match=r"half_axes|half axis"):
        bathyal.ellipsoid_added_mass(axes)


# Motion


def test_a_force_moves_body_and_added_mass_together():
    acceleration = ball().acceleration(STILL, [10, 0, 0, 0, 0, 0])
    added = 0.5 * 1025.0 * 4 / 3 * np.pi * 0.3**3
    np.testing.assert_allclose(
        acceleration, [10 / (100 + added), 0, 0, 0, 0, 0], rtol=1e-9, atol=1e-12
    )


def test_a_heavy_body_sinks_by_its_weight_in_water():
    body = ball(volume=0.09)
    wanted = (0.09 * 1025 - 100) * 9.80665 / body.mass_matrix[2, 2]
    assert body.acceleration(STILL, np.zeros(6))[2] == pytest.approx(wanted, rel=1e-9)


def test_a_neutral_ball_in_water_that_speeds_up_goes_with_it():
    neutral = 1025 * 4 / 3 * np.pi * 0.3**3
    body = ball(mass=neutral, volume=neutral / 1025)
    motion = body.simulate(
        STILL, np.zeros(6), 2.0, current=lambda point, time: np.array([0.2 * time, 0, 0])
    )
    # Taylor 1928: (m + m_A) dv/dt = (ρV + m_A) du/dt: a neutral body goes with the water.
    assert motion.velocity[-1, 0] == pytest.approx(0.4, abs=2e-3)


@pytest.mark.parametrize("jump", [0.503, 0.5061])
def test_a_neutral_ball_in_water_that_starts_at_once_goes_with_it(jump):
    neutral = 1025 * 4 / 3 * np.pi * 0.3**3
    body = ball(mass=neutral, volume=neutral / 1025)
    motion = body.simulate(
        STILL, np.zeros(6), 1.0, current=lambda point, time: np.array([0, 0.3 * (time > jump), 0])
    )
    assert motion.velocity[-1, 1] == pytest.approx(0.3, rel=1e-6)
    assert np.ptp(motion.velocity[60:, 1]) < 1e-9


@pytest.mark.parametrize("force", [3.86, 0.5, 30.0])
def test_surge_under_quadratic_drag_is_a_hyperbolic_tangent(force):
    remus = bathyal.vehicles.remus100()
    motion = remus.simulate(STILL, [force, 0, 0, 0, 0, 0], 30.0, free=SURGE)
    drag = 3.86 / 1.5436**2
    final = math.sqrt(force / drag)
    time = remus.mass_matrix[0, 0] / math.sqrt(force * drag)
    np.testing.assert_allclose(
        motion.velocity[:, 0], final * np.tanh(motion.time / time), atol=2e-3 * final
    )


def test_remus_own_time_constant_is_the_published_one():
    remus = bathyal.vehicles.remus100()
    assert remus.mass_matrix[0, 0] * 1.5436 / 3.86 == pytest.approx(12.561, rel=1e-3)


@pytest.mark.parametrize(("axis", "speed"), [(0, 0.549), (1, 0.480), (2, 0.433)])
def test_bluerov_reaches_its_published_speeds(axis, speed):
    force = np.zeros(6)
    force[axis] = 50
    free = [row == axis for row in range(6)]
    motion = bathyal.vehicles.bluerov2_heavy().simulate(STILL, force, 30.0, free=free)
    assert motion.velocity[-1, axis] == pytest.approx(speed, abs=6e-4)


def test_linear_drag_lets_speed_decay_exponentially():
    body = ball(linear_drag=20.0 * np.eye(6))
    motion = body.simulate((STILL, [1, 0, 0, 0, 0, 0]), np.zeros(6), 10.0)
    wanted = np.exp(-20.0 / body.mass_matrix[0, 0] * motion.time)
    np.testing.assert_allclose(motion.velocity[:, 0], wanted, rtol=1e-8)
    np.testing.assert_allclose(
        motion.pose[-1, 0, 3], body.mass_matrix[0, 0] / 20.0 * (1 - wanted[-1]), rtol=1e-7
    )


def test_quadratic_drag_lets_speed_decay_as_a_hyperbola():
    body = ball(quadratic_drag=[50, 0, 0, 0, 0, 0])
    motion = body.simulate((STILL, [2, 0, 0, 0, 0, 0]), np.zeros(6), 20.0)
    wanted = 2 / (1 + 2 * 50 / body.mass_matrix[0, 0] * motion.time)
    np.testing.assert_allclose(motion.velocity[:, 0], wanted, rtol=1e-7)


def test_a_body_swings_as_a_pendulum_about_its_centre_of_buoyancy():
    body = ball(center_of_mass=[0, 0, -0.05], inertia=4.0 * np.eye(3), added_mass=None)
    about = body.mass_matrix[4, 4]
    period = 2 * np.pi * math.sqrt(about / (100 * 9.80665 * 0.05))
    free = [False, False, False, False, True, False]
    motion = body.simulate(turn(1, 0.01), np.zeros(6), 1.5 * period, free=free)
    pitch = np.arctan2(motion.pose[:, 0, 2], motion.pose[:, 2, 2])
    falls = np.flatnonzero((pitch[:-1] > 0) & (pitch[1:] <= 0))
    assert len(falls) == 2
    crossing = [motion.time[i] + 0.01 * pitch[i] / (pitch[i] - pitch[i + 1]) for i in falls]
    assert crossing[1] - crossing[0] == pytest.approx(period, rel=1e-4)


def test_statics_trim_a_bluerov_by_three_newton_metres():
    rov = bathyal.vehicles.bluerov2_heavy()
    free = [False, False, False, False, True, False]
    motion = rov.simulate(STILL, [0, 0, 0, 0, 0.3, 0], 120.0, free=free)
    pitch = math.atan2(motion.pose[-1, 0, 2], motion.pose[-1, 2, 2])
    assert math.sin(pitch) == pytest.approx(
        0.3 / 1.31, rel=0.02
    )  # its righting moment: 1.31 N m / rad


def kirchhoff(angle, duration):
    """REMUS without weight or drag, centred, thrown at an angle off broadside."""
    added = np.diag(np.diag(bathyal.vehicles.remus100().added_mass))
    body = bathyal.vehicles.remus100().replace(
        center_of_mass=[0, 0, 0], added_mass=added, terms=[], gravity=0.0, linear_drag=None
    )
    impulse = 47.115 * np.array([math.sin(angle), math.cos(angle), 0])
    velocity = np.zeros(6)
    velocity[:3] = impulse / np.diag(body.mass_matrix)[:3]
    free = [True, True, False, False, False, True]
    return body, body.simulate((STILL, velocity), np.zeros(6), duration, free=free)


@pytest.mark.parametrize(("degrees", "period"), [(30, 3.19821), (60, 4.09135)])
def test_a_body_without_drag_swings_about_broadside(degrees, period):
    _, motion = kirchhoff(math.radians(degrees), 3 * period)
    yaw = np.unwrap(np.arctan2(motion.pose[:, 1, 0], motion.pose[:, 0, 0]))
    middle = (yaw.max() + yaw.min()) / 2
    rises = np.flatnonzero((yaw[:-1] < middle) & (yaw[1:] >= middle))
    crossing = [motion.time[i] + 0.01 * (middle - yaw[i]) / (yaw[i + 1] - yaw[i]) for i in rises]
    assert np.diff(crossing) == pytest.approx(period, rel=1e-4)
    assert (yaw.max() - yaw.min()) / 2 == pytest.approx(math.radians(degrees), rel=1e-3)


def test_kinetic_energy_and_impulse_are_kept_without_drag():
    body, motion = kirchhoff(math.radians(60), 120.0)
    matrix = body.mass_matrix
    energy = 0.5 * np.einsum("ki,ij,kj->k", motion.velocity, matrix, motion.velocity)
    impulse = np.einsum("kij,kj->ki", motion.pose[:, :3, :3], (motion.velocity @ matrix)[:, :3])
    np.testing.assert_allclose(energy, energy[0], rtol=1e-7)
    np.testing.assert_allclose(impulse, np.tile(impulse[0], (len(impulse), 1)), atol=1e-7 * 47.115)


def test_a_free_top_keeps_its_energy_and_angular_momentum():
    body = ball(inertia=np.diag([1.0, 2.0, 3.0]), added_mass=None, gravity=0.0)
    motion = body.simulate((STILL, [0, 0, 0, 0.01, 2.0, 0.01]), np.zeros(6), 60.0)
    turning = motion.velocity[:, 3:]
    energy = turning**2 @ [1.0, 2.0, 3.0]
    momentum = np.einsum("kij,kj->ki", motion.pose[:, :3, :3], turning * [1.0, 2.0, 3.0])
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)
    np.testing.assert_allclose(momentum - momentum[0], 0, atol=1e-5)
    assert turning[:, 1].min() < -1.9  # it tumbles about its middle axis (Dzhanibekov)


def test_the_step_is_of_fourth_order():
    remus = bathyal.vehicles.remus100()
    start = (turn(1, 0.1), [1.5, 0.05, 0, 0, 0.1, 0.1])
    ends = [
        remus.simulate(start, [4, 0, 0, 0.1, 0, 0], 2.0, step=step).pose[-1, :3, 3]
        for step in (0.04, 0.02, 0.01)
    ]
    ratio = np.linalg.norm(ends[0] - ends[1]) / np.linalg.norm(ends[1] - ends[2])
    assert 11 < ratio < 23


# Invariance


def test_rest_stays_rest():
    motion = bathyal.vehicles.bluerov2_heavy().simulate(STILL, np.zeros(6), 60.0)
    np.testing.assert_allclose(motion.pose[-1], STILL, atol=1e-9)


def test_a_uniform_current_is_a_moving_frame():
    remus = bathyal.vehicles.remus100()
    drift = np.array([0.4, -0.3, 0.1])
    pose = turn(2, 0.7)
    start = np.array([1.2, 0.05, 0.0, 0.02, 0.1, -0.1])
    moved = start.copy()
    moved[:3] += pose[:3, :3].T @ drift
    still = remus.simulate((pose, start), [4, 0, 0, 0, 0, 0.2], 60.0)
    moving = remus.simulate((pose, moved), [4, 0, 0, 0, 0, 0.2], 60.0, current=drift)
    way = still.pose[:, :3, 3] + still.time[:, None] * drift
    np.testing.assert_allclose(moving.pose[:, :3, 3], way, atol=1e-9)
    np.testing.assert_allclose(moving.pose[:, :3, :3], still.pose[:, :3, :3], atol=1e-9)


def test_turning_the_world_about_the_vertical_changes_nothing():
    remus = bathyal.vehicles.remus100()
    start = [1.2, 0.05, 0.0, 0.02, 0.1, -0.1]
    world = turn(2, 2.2)
    plain = remus.simulate((STILL, start), [4, 0, 0, 0, 0, 0.2], 60.0)
    turned = remus.simulate((world, start), [4, 0, 0, 0, 0, 0.2], 60.0)
    np.testing.assert_allclose(turned.pose, world @ plain.pose, atol=1e-9)


def test_moving_the_world_to_survey_coordinates_changes_little():
    remus = bathyal.vehicles.remus100()
    far = np.eye(4)
    far[:3, 3] = [431207.0, 6172657.0, -30.0]
    plain = remus.simulate(STILL, [4, 0, 0, 0, 0, 0.2], 30.0)
    moved = remus.simulate(far, [4, 0, 0, 0, 0, 0.2], 30.0)
    np.testing.assert_allclose(moved.pose[:, :3, 3] - far[:3, 3], plain.pose[:, :3, 3], atol=1e-5)
    np.testing.assert_allclose(moved.velocity, plain.velocity, atol=1e-12)


def test_the_same_numbers_z_down_are_the_same_body():
    flip = np.diag([1.0, -1, -1, 1, -1, -1])
    added = np.diag([5.0, 20, 30, 1, 2, 3])
    added[1, 5] = added[5, 1] = 1.5
    added[2, 4] = added[4, 2] = -2.5
    up = ball(center_of_mass=[0.1, 0.02, -0.05], added_mass=added)
    down = ball(center_of_mass=[0.1, -0.02, 0.05], added_mass=flip @ added @ flip, z_down=True)
    np.testing.assert_allclose(down.mass_matrix, up.mass_matrix, atol=1e-12)
    state = (turn(1, 0.2), [1, 0.1, 0.2, 0.1, 0.2, 0.3])
    np.testing.assert_allclose(
        down.acceleration(state, np.ones(6)), up.acceleration(state, np.ones(6)), atol=1e-12
    )


def test_mirroring_port_and_starboard_mirrors_the_motion():
    rov = bathyal.vehicles.bluerov2_heavy()
    mirror = np.array([1.0, -1, 1, -1, 1, -1])
    force = np.array([10.0, 5, 3, 0.1, 0.2, 0.5])
    left = rov.simulate(STILL, force, 5.0)
    right = rov.simulate(STILL, mirror * force, 5.0)
    np.testing.assert_allclose(right.velocity, left.velocity * mirror, atol=1e-10)


def test_a_pickled_vehicle_moves_to_the_same_bytes():
    remus = bathyal.vehicles.remus100()
    again = pickle.loads(pickle.dumps(remus))
    one, two = (body.simulate(STILL, [4, 0, 0, 0, 0, 0.2], 5.0) for body in (remus, again))
    assert one.pose.tobytes() == two.pose.tobytes()
    assert one.velocity.tobytes() == two.velocity.tobytes()


def test_the_orientation_stays_a_rotation_while_it_tumbles():
    body = ball(inertia=np.diag([1.0, 2.0, 3.0]), gravity=0.0)
    motion = body.simulate((STILL, [0, 0, 0, 1, 5, 3]), np.zeros(6), 60.0)
    turns = motion.pose[:, :3, :3]
    np.testing.assert_allclose(
        turns @ turns.transpose(0, 2, 1), np.tile(np.eye(3), (len(turns), 1, 1)), atol=1e-12
    )


# Surface, waves, ground


WORLD = """
water: {{surface: 0{water}}}
terrain: {{seabed: {{size: [40, 40], spacing: 1, depth: {depth}, relief_rms: 0}}}}
"""


def world_of(tmp_path, water="", depth=10):
    path = tmp_path / "world.yaml"
    path.write_text(WORLD.format(water=water, depth=depth))
    return bathyal.read_world(path)


def test_a_ball_half_as_heavy_as_water_floats_half_out(tmp_path):
    part = 4 / 3 * np.pi * 0.3**3
    body = ball(
        mass=part * 512.5, volume=part, parts=[[0, 0, 0, 0.3, 1]], linear_drag=200 * np.eye(6)
    )
    start = STILL.copy()
    start[2, 3] = -1.0
    motion = body.simulate(start, np.zeros(6), 30.0, world=world_of(tmp_path))
    assert motion.pose[-1, 2, 3] == pytest.approx(0.0, abs=0.01)
    assert np.abs(motion.velocity[-1]).max() < 1e-3


def test_a_heavy_ball_comes_to_rest_on_the_bottom(tmp_path):
    part = 4 / 3 * np.pi * 0.3**3
    body = ball(
        mass=1.05 * part * 1025, volume=part, parts=[[0, 0, 0, 0.3, 1]], linear_drag=20 * np.eye(6)
    )
    start = STILL.copy()
    start[2, 3] = -8.0
    motion = body.simulate(start, np.zeros(6), 30.0, world=world_of(tmp_path))
    assert motion.pose[-1, 2, 3] == pytest.approx(-9.7, abs=0.05)
    assert np.abs(motion.velocity[-1]).max() < 1e-3


def test_a_body_in_the_air_falls_freely(tmp_path):
    body = ball(parts=[[0, 0, 0, 0.1, 1]], added_mass=None)
    start = STILL.copy()
    start[2, 3] = 5.0
    motion = body.simulate(start, np.zeros(6), 0.5, world=world_of(tmp_path))
    assert motion.velocity[-1, 2] == pytest.approx(-9.80665 * 0.5, rel=1e-6)


def test_a_worlds_current_carries_as_one_that_is_given(tmp_path):
    remus = bathyal.vehicles.remus100()
    start = STILL.copy()
    start[2, 3] = -5.0
    world = world_of(tmp_path, ", current: [0.4, 0.2, 0]")
    by_world = remus.simulate(start, np.zeros(6), 10.0, world=world)
    by_hand = remus.simulate(start, np.zeros(6), 10.0, current=[0.4, 0.2, 0])
    np.testing.assert_allclose(by_world.velocity, by_hand.velocity, atol=1e-12)
    assert by_world.velocity[-1, 1] > 0.1


def test_a_small_neutral_body_goes_with_the_orbit_of_the_waves(tmp_path):
    body = ball(linear_drag=np.diag([500.0] * 6))
    start = STILL.copy()
    start[2, 3] = -5.0
    world = world_of(tmp_path, ", waves: {height: 0.5, period: 5}", depth=30)
    motion = body.simulate(start, np.zeros(6), 40.0, world=world)
    late = motion.time > 20
    assert 0.02 < motion.velocity[late, 0].std() < 0.2
    assert 0.02 < motion.velocity[late, 2].std() < 0.2


def test_waves_of_a_hundred_metres_have_airys_period_and_decay():
    deep = bathyal.Waves.regular(2.0, 8.004)
    assert 2 * np.pi / np.linalg.norm(deep.wave_number[0]) == pytest.approx(100, rel=2e-3)
    ratio = np.linalg.norm(deep.velocity([0, 0, -50], 0.0)) / np.linalg.norm(
        deep.velocity([0, 0, 0], 0.0)
    )
    assert ratio == pytest.approx(0.0432, rel=0.07)  # stretching moves the crest's own
    shallow = bathyal.Waves.regular(0.2, 10.726, depth=10.0)
    assert 2 * np.pi / np.linalg.norm(shallow.wave_number[0]) == pytest.approx(100, rel=1e-3)


def test_the_acceleration_of_waves_is_the_derivative_of_their_velocity():
    waves = bathyal.Waves.regular(1.0, 6.0, direction=0.4)
    point = [3.0, -2.0, -4.0]
    by_difference = (waves.velocity(point, 1.0005) - waves.velocity(point, 0.9995)) / 0.001
    np.testing.assert_allclose(waves.acceleration(point, 1.0), by_difference, rtol=2e-3, atol=1e-5)


# Devices


def test_a_battery_solves_its_quadratic():
    load = bathyal.Battery(capacity=10, resistance=0.1, charge=[0, 1], voltage=[12, 16]).solve(
        200.0
    )
    current = (16 - math.sqrt(16**2 - 4 * 0.1 * 200)) / 0.2
    assert (load.current, load.voltage) == pytest.approx((current, 16 - 0.1 * current), rel=1e-9)
    assert not load.collapsed


def test_a_battery_gives_no_more_than_a_quarter_of_e_squared_over_r():
    battery = bathyal.Battery(capacity=10, resistance=0.1, charge=[0, 1], voltage=[12, 16])
    most = 16**2 / 0.4
    assert not battery.solve(most * 0.999).collapsed
    beyond = battery.solve(most * 1.001)
    assert beyond.collapsed
    assert beyond.voltage * beyond.current == pytest.approx(most, rel=1e-6)


def test_a_resistive_load_on_a_battery_divides_its_voltage():
    battery = bathyal.Battery(capacity=10, resistance=0.1, charge=[0, 1], voltage=[12, 16])
    load = battery.solve(lambda volts: volts**2 / 0.7)
    assert load.voltage == pytest.approx(16 * 0.7 / 0.8, rel=1e-6)


def test_an_open_circuit_lies_between_the_curves_points():
    battery = bathyal.Battery(capacity=10, resistance=0.1, charge=[0, 0.5, 1], voltage=[12, 15, 16])
    assert battery.open_circuit(0.25) == pytest.approx(13.5)
    assert battery.open_circuit(0.0) == 0.0


@pytest.mark.parametrize(
    "changes",
    [
        {"capacity": 0},
        {"capacity": -1},
        {"capacity": math.nan},
        {"resistance": -0.1},
        {"resistance": math.inf},
        {"charge": [1, 0]},
        {"charge": [0.1, 1]},
        {"charge": []},
        {"voltage": [12]},
        {"voltage": [12, math.nan]},
    ],
)
def test_a_battery_that_is_none_is_refused(changes):
    options = {"capacity": 10, "resistance": 0.1, "charge": [0, 1], "voltage": [12, 16], **changes}
    with pytest.raises(ValueError, match="(?i)" + next(iter(changes)) + "|charge|voltage"):
        bathyal.Battery(**options)


def test_the_energy_of_a_hotel_load_leaves_the_battery():
    battery = bathyal.Battery(capacity=1, resistance=1e-9, charge=[0, 1], voltage=[10, 10])
    system = bathyal.VehicleSystem(
        bathyal.vehicles.bluerov2_heavy(), battery=battery, hotel_power=36.0
    )
    state = system.rest()
    system.step(state, step=0.1, steps=600)
    assert state.charge == pytest.approx(1 - 3.6 / 60, rel=1e-6)


def test_a_battery_does_not_go_below_empty():
    battery = bathyal.Battery(capacity=0.001, resistance=0.01, charge=[0, 1], voltage=[10, 10])
    system = bathyal.VehicleSystem(
        bathyal.vehicles.bluerov2_heavy(), battery=battery, hotel_power=100.0
    )
    state = system.rest()
    system.step(state, step=0.1, steps=100)
    assert state.charge == 0.0


def test_a_thrusters_speed_lags_exponentially():
    t200 = bathyal.Thruster.t200()
    final = t200.steady(0.6, 16.0)[2]
    assert t200.advanced(0.0, 0.6, 16.0, t200.lag) == pytest.approx(
        final * (1 - math.exp(-1)), rel=1e-6
    )
    twice = t200.advanced(t200.advanced(0.0, 0.6, 16.0, 0.01), 0.6, 16.0, 0.02)
    assert twice == pytest.approx(t200.advanced(0.0, 0.6, 16.0, 0.03), rel=1e-9)


def test_a_thruster_does_nothing_in_its_dead_zone():
    t200 = bathyal.Thruster.t200()
    for micros in (1480, 1500, 1520):
        assert t200.steady((micros - 1500) / 400, 16.0)[0] == 0.0
    assert t200.steady((1460 - 1500) / 400, 16.0)[0] < 0 < t200.steady((1540 - 1500) / 400, 16.0)[0]


@pytest.mark.parametrize("thrust", [-20.0, -3.0, -0.5, 0.0, 0.5, 3.0, 30.0])
@pytest.mark.parametrize("voltage", [12.0, 16.0])
def test_the_command_for_a_thrust_gives_that_thrust(thrust, voltage):
    t200 = bathyal.Thruster.t200()
    assert t200.steady(t200.command_for(thrust, voltage), voltage)[0] == pytest.approx(
        thrust, abs=1e-6
    )


def test_the_command_beyond_the_limit_is_the_limit():
    t200 = bathyal.Thruster.t200()
    assert t200.command_for(1e9, 16.0) == 1.0
    assert t200.command_for(-1e9, 16.0) == -1.0


def test_a_placed_thrusters_moment_is_lever_times_force():
    place, way = np.array([0.3, -0.2, 0.1]), np.array([1.0, 2.0, -2.0])
    thruster = bathyal.Thruster.t200().placed(place, way)
    wrench = thruster.wrench(30.0)
    np.testing.assert_allclose(wrench[:3] / np.linalg.norm(wrench[:3]), way / 3, atol=1e-12)
    np.testing.assert_allclose(wrench[3:], np.cross(place, wrench[:3]), atol=1e-9)


def test_drop_weights_lighten_the_vehicle_by_their_weight_in_water():
    rov = bathyal.vehicles.bluerov2_heavy()
    weight = bathyal.DropWeight(mass=2.0, volume=0.0005)
    state = (system := bathyal.VehicleSystem(rov, drop_weights=[weight])).rest()
    held = system.wrench(state)
    assert held[2] == pytest.approx(-(2.0 - 0.0005 * rov.water_density) * rov.gravity, rel=1e-9)
    system.step(state, drop=[True])
    assert list(state.released) == [True]
    np.testing.assert_allclose(system.wrench(state), 0, atol=1e-12)
    system.step(state, drop=[False])
    assert list(state.released) == [True]


def test_a_level_tether_hangs_as_a_catenary():
    span, length, weight = 8.0, 10.0, 2.0
    low, high = 1e-3, 100.0
    for _ in range(200):
        a = 0.5 * (low + high)
        low, high = (a, high) if 2 * a * math.sinh(span / (2 * a)) > length else (low, a)
    tether = bathyal.Tether(anchor=[-span, 0, 0], length=length, weight=weight, stiffness=1e9)
    wrench = tether.wrench(STILL)
    assert wrench[0] == pytest.approx(-weight * a, rel=1e-4)
    assert wrench[2] == pytest.approx(-weight * length / 2, rel=1e-4)
    np.testing.assert_allclose(wrench[[1, 3, 4, 5]], 0, atol=1e-6)


def test_a_taut_tether_pulls_as_a_spring():
    tether = bathyal.Tether(anchor=[0, 0, 10.0], length=8.0, weight=0.0, stiffness=400.0)
    np.testing.assert_allclose(tether.wrench(STILL), [0, 0, 400.0 * 2 / 8, 0, 0, 0], atol=1e-3)


def test_a_slack_weightless_tether_pulls_hardly():
    tether = bathyal.Tether(anchor=[0, 0, 5.0], length=10.0, weight=0.0)
    assert np.abs(tether.wrench(STILL)).max() < 1.0


def test_a_vertical_slack_tether_shares_its_weight():
    tether = bathyal.Tether(anchor=[0, 0, 6.0], length=10.0, weight=1.0, stiffness=1e9)
    # Two vertical strands of 8 and 2 m: the vehicle carries the lower 2 m.
    assert tether.wrench(STILL)[2] == pytest.approx(-2.0, rel=0.02)


@pytest.mark.parametrize("lost", range(8))
def test_bluerov_holds_six_directions_without_any_one(lost):
    rov = bathyal.VehicleSystem.bluerov2_heavy()
    allocation = bathyal.Allocation(rov.thrusters)
    assert allocation.rank(failed=[lost]) == (6, [])
    assert np.linalg.matrix_rank(np.delete(allocation.matrix, lost, axis=1)) == 6


def test_allocation_says_what_its_thrusts_give():
    rov = bathyal.VehicleSystem.bluerov2_heavy()
    allocation = bathyal.Allocation(rov.thrusters)
    for wrench in ([30, 20, 10, 1, -1, 2], [500, 0, 0, 0, 0, 0], [0, 0, 0, 0, 40, 0]):
        given = allocation.allocate(wrench, 15.0)
        np.testing.assert_allclose(allocation.matrix @ given.thrust, given.achieved, atol=1e-9)
        assert np.abs(given.command).max() <= 1.0
    assert given.saturated


@pytest.mark.parametrize("failed", [[8], [-1], [0, 99]])
def test_allocation_refuses_thrusters_that_are_not_there(failed):
    allocation = bathyal.Allocation(bathyal.VehicleSystem.bluerov2_heavy().thrusters)
    with pytest.raises((ValueError, IndexError), match="failed"):
        allocation.rank(failed=failed)


def test_a_rudder_to_port_turns_to_port_and_the_propeller_heels_to_port():
    remus = bathyal.VehicleSystem.remus100()
    state = remus.rest()
    remus.step(state, thrusters=[1], fins=[math.radians(4), 0], step=0.01, steps=500)
    assert state.velocity[5] > 0


# What must be refused


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"mass": 0}, "mass"),
        ({"mass": -1}, "mass"),
        ({"mass": math.nan}, "mass"),
        ({"mass": math.inf}, "mass"),
        ({"volume": -1}, "volume"),
        ({"volume": math.nan}, "volume"),
        ({"inertia": np.zeros((3, 3))}, "inertia|positive definite"),
        ({"inertia": -np.eye(3)}, "inertia|positive definite"),
        ({"inertia": np.eye(2)}, "inertia"),
        ({"inertia": [[1, 2, 0], [0, 1, 0], [0, 0, 1]]}, "inertia"),
        ({"inertia": np.diag([1.0, 1.0, 5.0])}, "inertia"),
        ({"center_of_mass": [0, 0]}, "center_of_mass"),
        ({"center_of_mass": [0, 0, math.nan]}, "center_of_mass"),
        ({"added_mass": -np.eye(6)}, "added_mass|added mass"),
        ({"added_mass": np.eye(5)}, "added_mass"),
        ({"added_mass": np.triu(np.ones((6, 6))) + 9 * np.eye(6)}, "added_mass|added mass"),
        ({"linear_drag": np.full((6, 6), math.nan)}, "linear_drag"),
        ({"quadratic_drag": [1, 2, 3]}, "quadratic_drag"),
        ({"terms": [(6, 0, 0, True, 1.0)]}, "terms?"),
        ({"terms": [(0, -1, 0, True, 1.0)]}, "terms?"),
        ({"terms": [(0, 0, 0, True, math.nan)]}, "terms?"),
        ({"parts": [[0, 0, 0, -1, 1]]}, "parts?"),
        ({"parts": [[0, 0, 0, 1]]}, "parts?"),
        ({"gravity": -9.81}, "gravity"),
        ({"water_density": 0}, "water_density|water density"),
    ],
)
def test_a_vehicle_that_is_none_is_refused_by_name(changes, named):
    with pytest.raises(ValueError, match=named):
        ball(**changes)


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (((np.eye(3)), np.zeros(6), 1.0), "state|pose"),
        ((2 * np.eye(4), np.zeros(6), 1.0), "state|pose|rigid"),
        ((np.full((4, 4), math.nan), np.zeros(6), 1.0), "state|pose|finite"),
        (((STILL, [1, 2, 3]), np.zeros(6), 1.0), "velocity|state"),
        ((STILL, np.zeros(5), 1.0), "thrust"),
        ((STILL, [math.nan] * 6, 1.0), "thrust"),
        ((STILL, np.zeros(6), -1.0), "duration"),
        ((STILL, np.zeros(6), math.nan), "duration"),
        ((STILL, np.zeros(6), math.inf), "duration"),
        ((STILL, np.zeros(6), 1.0, 0.0), "step"),
        ((STILL, np.zeros(6), 1.0, -0.01), "step"),
        ((STILL, np.zeros(6), 1.0, math.nan), "step"),
        ((STILL, np.zeros(6), 1.0, 0.01, [0, 0]), "current"),
        ((STILL, np.zeros(6), 1.0, 0.01, [0, math.inf, 0]), "current"),
        ((STILL, np.zeros(6), 1.0, 0.01, None, [True] * 5), "free"),
    ],
)
def test_a_motion_that_is_none_is_refused_by_name(arguments, named):
    with pytest.raises(ValueError, match=named):
        ball().simulate(*arguments)


def test_a_step_beyond_stability_names_the_mode():
    body = ball(linear_drag=np.diag([20.0, 20, 20, 1e5, 20, 20]))
    limit = 2.785 * body.mass_matrix[3, 3] / 1e5
    with pytest.raises(ValueError, match=r"(?i)step.*roll|roll.*step"):
        body.simulate(STILL, np.zeros(6), 0.1, step=1.02 * limit)
    body.simulate(STILL, np.zeros(6), 0.1, step=0.98 * limit)


def test_a_thrust_function_that_fails_fails_with_its_own_error():
    def broken(time, pose, velocity):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        ball().simulate(STILL, broken, 1.0)


@pytest.mark.parametrize("value", [np.zeros(3), [math.nan] * 6, None, "abc"])
def test_a_thrust_function_of_nonsense_is_refused(value):
    with pytest.raises((ValueError, TypeError, bathyal.Error)):
        ball().simulate(STILL, lambda time, pose, velocity: value, 1.0)


def test_an_unknown_change_is_named():
    with pytest.raises(ValueError, match="masss"):
        ball().replace(masss=3)


@pytest.mark.parametrize(
    ("keywords", "named"),
    [
        ({"thrusters": [0.0] * 7}, "thrusters"),
        ({"thrusters": [math.nan] * 8}, "thrusters"),
        ({"fins": [0.1]}, "fins"),
        ({"drop": [True]}, "drop"),
        ({"wrench": [0.0] * 5}, "wrench"),
        ({"wrench": [math.inf] * 6}, "wrench"),
        ({"current": [0.0]}, "current"),
        ({"step": 0.0}, "step"),
        ({"step": math.nan}, "step"),
        ({"steps": -1}, "steps"),
    ],
)
def test_a_systems_step_refuses_nonsense_by_name_and_leaves_the_state(keywords, named):
    rov = bathyal.VehicleSystem.bluerov2_heavy()
    state = rov.rest()
    with pytest.raises(ValueError, match=named):
        rov.step(state, **keywords)
    np.testing.assert_array_equal(state.pose, STILL)
    np.testing.assert_array_equal(state.velocity, np.zeros(6))


def test_a_state_of_another_system_is_refused():
    rov, remus = bathyal.VehicleSystem.bluerov2_heavy(), bathyal.VehicleSystem.remus100()
    with pytest.raises(ValueError, match=r"state|thrusters"):
        rov.step(remus.rest())


# Files


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("", "empty|mapping|nothing|preset|mass"),
        ("[]", "mapping|keys|list"),
        ("preset: remus101", "remus101|preset"),
        ("preset: remus100\npreset: remus100", "preset.*twice|twice|duplicate|doubled|again"),
        ("preset: remus100\nmas: 3", "mas"),
        ("preset: remus100\nmass: 0", "mass"),
        ("preset: remus100\nmass: .nan", "mass"),
        ("preset: remus100\nmass: heavy", "mass"),
        ("preset: remus100\nmass: 3 m", "mass"),
        ("preset: !!python/object/apply:os.system ['touch pwned']", "tag"),
        (
            "preset: remus100\nadded_mass: [-900, -900, -900, -900, -900, -900]",
            "added_mass|added mass|positive",
        ),
        ("hull: {mesh: ../../../etc/passwd}", "outside|passwd"),
        ("hull: {mesh: /etc/passwd}", "outside|passwd"),
        ("hull: {mesh: none.stl}", "none.stl"),
        ("preset: remus100\n\tmass: 3", "tab|line 2|:2:"),
        ("preset: remus100\nmass: 1" + "0" * 400, "mass"),
    ],
)
def test_a_hostile_vehicle_file_is_refused_by_name(tmp_path, monkeypatch, text, named):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "vehicle.yaml"
    path.write_text(text)
    with pytest.raises(bathyal.Error, match=r"(?is)vehicle.yaml.*(" + named + ")"):
        bathyal.read_vehicle(path)
    assert not Path("pwned").exists()


def test_a_vehicle_heavier_than_its_water_is_read_and_warned_of(tmp_path):
    path = tmp_path / "vehicle.yaml"
    path.write_text("preset: bluerov2_heavy\nmass: 20\n")
    with pytest.warns(UserWarning, match=r"(?i)weight|buoyan|sink"):
        bathyal.read_vehicle(path)
