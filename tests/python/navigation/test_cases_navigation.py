"""Sensors, filter and reckoning against closed forms and bad input."""

import math

import numpy as np
import pytest

import bathyal

TIME = np.arange(0.0, 60.0, 0.02)


def still(position=(0, 0, 0), yaw=0.0):
    pose = np.tile(np.eye(4), (len(TIME), 1, 1))
    pose[:, :3, 3] = position
    pose[:, 0, 0] = pose[:, 1, 1] = math.cos(yaw)
    pose[:, 1, 0], pose[:, 0, 1] = math.sin(yaw), -math.sin(yaw)
    return pose


def ahead(speed):
    return np.tile([speed, 0, 0, 0, 0, 0], (len(TIME), 1)).astype(float)


# Dead reckoning


@pytest.mark.parametrize(("degrees", "off"), [(1.0, 17.452), (-1.0, -17.452), (90.0, 1000.0)])
def test_a_heading_that_is_off_leads_aside(degrees, off):
    time = np.linspace(0, 1000, 101)
    found = bathyal.dead_reckon(
        time, np.full(101, math.radians(degrees)), np.tile([1.0, 0, 0], (101, 1))
    )
    assert found[-1, 1] == pytest.approx(off, abs=1e-3)


def test_a_gyro_of_a_degree_an_hour_costs_47_metres():
    time = np.arange(0.0, 3601.0)
    found = bathyal.dead_reckon(
        time, math.radians(1) * time / 3600, np.tile([1.5, 0, 0], (3601, 1))
    )
    assert found[-1, 1] == pytest.approx(47.1, abs=0.05)


def test_a_circle_closes():
    time = np.linspace(0, 100, 1001)
    found = bathyal.dead_reckon(time, 2 * np.pi * time / 100, np.tile([1.0, 0, 0], (1001, 1)))
    np.testing.assert_allclose(found[-1], 0, atol=1e-9)
    assert found[500, 1] == pytest.approx(100 / np.pi, rel=1e-4)


def test_a_bow_that_is_down_goes_down():
    found = bathyal.dead_reckon([0.0, 10.0], np.array([[0, 0.1, 0]] * 2), [[1.0, 0, 0]] * 2)
    assert found[-1, 2] == pytest.approx(-10 * math.sin(0.1))


def test_reckoning_turns_with_its_heading():
    rng = np.random.default_rng(1)
    time, yaw, log = np.arange(50.0), rng.normal(size=50), rng.normal(size=(50, 3))
    plain, turned = (
        bathyal.dead_reckon(time, yaw, log),
        bathyal.dead_reckon(time, yaw + np.pi / 2, log),
    )
    np.testing.assert_allclose(
        turned, plain @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]]), atol=1e-12
    )


@pytest.mark.parametrize(
    ("time", "attitude", "velocity", "named"),
    [
        ([0.0, 0.0], [0.0, 0.0], [[1, 0, 0]] * 2, "time"),
        ([1.0, 0.0], [0.0, 0.0], [[1, 0, 0]] * 2, "time"),
        ([0.0, math.nan], [0.0, 0.0], [[1, 0, 0]] * 2, "time"),
        ([0.0, 1.0], [0.0], [[1, 0, 0]] * 2, "attitude"),
        ([0.0, 1.0], [0.0, math.inf], [[1, 0, 0]] * 2, "attitude"),
        ([0.0, 1.0], [0.0, 0.0], [[1, 0, 0]], "velocity"),
        ([0.0, 1.0], [0.0, 0.0], [[1, 0]] * 2, "velocity"),
        ([0.0, 1.0], [0.0, 0.0], [[1, 0, math.nan]] * 2, "velocity"),
    ],
)
def test_reckoning_refuses_nonsense_by_name(time, attitude, velocity, named):
    with pytest.raises(ValueError, match=named):
        bathyal.dead_reckon(time, attitude, velocity)


# Sensors


def test_sensors_without_errors_say_what_is():
    pose = still([3, 4, -10], yaw=0.5)
    speed = ahead(1.5)
    for sensor, wanted in [
        (bathyal.Sensor("depth"), [10]),
        (bathyal.Sensor("dvl"), [1.5, 0, 0]),
        (bathyal.Sensor("imu"), [0, 0, 0, 0, 0, 9.81]),
        (bathyal.Sensor("compass"), [0, 0, 0.5]),
        (bathyal.Sensor("altimeter"), [7]),
        (bathyal.Sensor("usbl", beacons=[[0, 0, 0]]), [3, 4, -10]),
        (bathyal.Sensor("lbl", beacons=[[3, 4, 0], [3, 0, -10]]), [10, 4]),
        (bathyal.Sensor("modem", beacons=[[3, 4, 0]], sound_speed=1500.0), [10 / 1500]),
        (bathyal.Sensor("leak"), [0]),
    ]:
        values = sensor.simulate(
            TIME, pose, velocity=speed, altitude=np.full(len(TIME), 7.0)
        ).values
        assert len(values) > 0, sensor.kind
        np.testing.assert_allclose(
            values, np.tile(wanted, (len(values), 1)), atol=1e-9, err_msg=sensor.kind
        )


def test_a_usbl_at_a_kilometre_is_late_by_the_two_way_time():
    usbl = bathyal.Sensor("usbl", rate=1.0, beacons=[[0, 0, 1000]], sound_speed=1500.0)
    readings = usbl.simulate(TIME, still())
    np.testing.assert_allclose(readings.arrival - readings.time, 2000 / 1500, rtol=1e-9)


def test_gps_is_silent_under_water():
    assert not bathyal.Sensor("gps").simulate(TIME, still([0, 0, -1])).valid.any()
    assert bathyal.Sensor("gps").simulate(TIME, still([0, 0, 0.1])).valid.all()


def test_a_mount_turns_and_a_lever_adds_the_speed_of_turning():
    mount = np.eye(4)
    mount[:2, :2] = [[0, -1], [1, 0]]
    mount[:3, 3] = [2, 0, 0]
    velocity = np.tile([1.0, 0, 0, 0, 0, 0.5], (len(TIME), 1))
    values = (
        bathyal.Sensor("dvl", vehicle_from_sensor=mount)
        .simulate(TIME, still(), velocity=velocity)
        .values
    )
    np.testing.assert_allclose(values[0], [1.0, -1.0, 0], atol=1e-12)  # 1 ahead, 0.5 · 2 to port


def test_an_imu_off_the_origin_feels_the_centripetal_force():
    mount = np.eye(4)
    mount[:3, 3] = [2, 0, 0]
    velocity = np.tile([0, 0, 0, 0, 0, 0.5], (len(TIME), 1))
    values = (
        bathyal.Sensor("imu", vehicle_from_sensor=mount)
        .simulate(TIME, still(), velocity=velocity)
        .values
    )
    np.testing.assert_allclose(values[0], [0, 0, 0.5, -0.5, 0, 9.81], atol=1e-9)


def test_noise_has_the_deviation_that_is_asked_for():
    values = (
        bathyal.Sensor("depth", rate=50.0, noise=0.2)
        .simulate(TIME, still([0, 0, -5]), seed=3)
        .values
    )
    assert len(values) == 3000
    assert values.std() == pytest.approx(0.2, rel=0.06)
    assert values.mean() == pytest.approx(5, abs=0.02)


def test_biases_are_drawn_once_a_seed_with_their_deviation():
    gauge = bathyal.Sensor("depth", rate=1.0, bias=0.5)
    runs = [gauge.simulate(TIME[:200], still()[:200], seed=seed).values for seed in range(400)]
    assert all(np.ptp(values) < 1e-12 for values in runs)
    drawn = np.array([values[0, 0] for values in runs])
    assert drawn.std() == pytest.approx(0.5, rel=0.12)
    assert abs(drawn.mean()) < 0.1


def test_dropouts_and_outliers_come_as_often_as_they_are_asked_for():
    lossy = bathyal.Sensor("depth", rate=50.0, dropout=0.3).simulate(TIME, still(), seed=1)
    assert len(lossy) / 3000 == pytest.approx(0.7, abs=0.03)
    wild = bathyal.Sensor("depth", rate=50.0, outlier_rate=0.1, outlier_size=5.0).simulate(
        TIME, still(), seed=1
    )
    assert np.mean(np.abs(wild.values) > 1e-9) == pytest.approx(0.1, abs=0.02)


def test_a_quantum_makes_steps():
    values = bathyal.Sensor("depth", noise=1.0, quantum=0.25).simulate(TIME, still(), seed=1).values
    np.testing.assert_allclose(values / 0.25, np.round(values / 0.25), atol=1e-9)
    assert len(np.unique(values)) > 3


def test_a_walk_grows_with_the_root_of_time():
    walker = bathyal.Sensor("depth", rate=1.0, walk=0.1)
    ends = [walker.simulate(TIME, still(), seed=seed).values[-1, 0] for seed in range(300)]
    assert np.std(ends) == pytest.approx(0.1 * math.sqrt(59), rel=0.12)


def test_noise_depends_on_seed_and_name_alone():
    pose = still()
    first = bathyal.Sensor("depth", name="a", noise=1.0).simulate(TIME, pose, seed=1).values
    again = bathyal.Sensor("depth", name="a", noise=1.0).simulate(TIME, pose, seed=1).values
    np.testing.assert_array_equal(first, again)
    for name, seed in [("a", 2), ("b", 1), ("aa", 1)]:
        other = bathyal.Sensor("depth", name=name, noise=1.0).simulate(TIME, pose, seed=seed).values
        assert abs(np.corrcoef(first[:, 0], other[:, 0])[0, 1]) < 0.5
        assert not np.any(first == other)


def test_dropouts_change_nobodys_noise_among_those_that_come():
    pose = still()
    whole = bathyal.Sensor("depth", noise=1.0).simulate(TIME, pose, seed=1)
    lossy = bathyal.Sensor("depth", noise=1.0, dropout=0.4).simulate(TIME, pose, seed=1)
    kept = np.isin(whole.time, lossy.time)
    np.testing.assert_array_equal(whole.values[kept], lossy.values)


@pytest.mark.parametrize(
    ("keywords", "named"),
    [
        ({"kind": "nose"}, "kind|nose"),
        ({"rate": 0}, "rate"),
        ({"rate": -1}, "rate"),
        ({"rate": math.nan}, "rate"),
        ({"latency": -1}, "latency"),
        ({"dropout": 1.1}, "dropout"),
        ({"dropout": -0.1}, "dropout"),
        ({"noise": -1}, "noise"),
        ({"noise": math.nan}, "noise"),
        ({"noise": [1, 2]}, "noise"),
        ({"outlier_rate": 2}, "outlier_rate"),
        ({"quantum": -1}, "quantum"),
        ({"markov": 1.0, "markov_time": 0.0}, "markov"),
        ({"range": 0}, "range"),
        ({"sound_speed": 0}, "sound_speed"),
        ({"vehicle_from_sensor": 2 * np.eye(4)}, "vehicle_from_sensor"),
        ({"kind": "usbl"}, "beacons"),
        ({"kind": "lbl", "beacons": np.zeros((13, 3))}, "beacons"),
        ({"kind": "usbl", "beacons": [[0, 0, math.nan]]}, "beacons"),
    ],
)
def test_a_sensor_that_is_none_is_refused_by_name(keywords, named):
    with pytest.raises(ValueError, match=named):
        bathyal.Sensor(**{"kind": "depth", **keywords})


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"time": TIME[::-1]}, "time"),
        ({"time": TIME - 1}, "time"),
        ({"time": TIME[:-1]}, "pose|time"),
        ({"pose": 2 * still()}, "pose"),
        ({"pose": np.full((len(TIME), 4, 4), math.nan)}, "pose"),
        ({"velocity": np.zeros((3, 6))}, "velocity"),
        ({"velocity": np.full((len(TIME), 6), math.inf)}, "velocity"),
        ({"altitude": np.zeros(3)}, "altitude"),
        ({"gravity": math.nan}, "gravity"),
        ({"surface": math.inf}, "surface"),
    ],
)
def test_a_motion_that_is_none_is_refused_by_name(changes, named):
    sensor = bathyal.Sensor("imu" if named == "gravity" else "depth")
    with pytest.raises(ValueError, match=named):
        sensor.simulate(**{"time": TIME, "pose": still(), **changes})


# Allan deviation


def test_white_noise_and_a_random_walk_have_their_formulas():
    rng = np.random.default_rng(4)
    white = rng.normal(size=200_000) * 0.1 * math.sqrt(100)  # density 0.1 at 100 Hz
    interval, deviation = bathyal.allan_deviation(white, 100.0, [1, 10, 100])
    np.testing.assert_allclose(deviation, 0.1 / np.sqrt(interval), rtol=0.05)
    walk = np.cumsum(rng.normal(size=200_000)) * 0.02 / math.sqrt(100)
    interval, deviation = bathyal.allan_deviation(walk, 100.0, [100, 300])
    np.testing.assert_allclose(deviation, 0.02 * np.sqrt(interval / 3), rtol=0.08)


@pytest.mark.parametrize(
    ("data", "rate", "factors"),
    [
        ([1.0] * 3, 1.0, []),
        ([1.0] * 9, 0.0, []),
        ([1.0, math.nan] * 4, 1.0, []),
        ([1.0] * 9, 1.0, [0]),
        ([1.0] * 9, 1.0, [5]),
    ],
)
def test_allan_deviation_refuses_nonsense(data, rate, factors):
    with pytest.raises(ValueError, match=r"rate_data|sample_rate|factors"):
        bathyal.allan_deviation(data, rate, factors)


# Filter


def filter_of(**options):
    sensors = [bathyal.Sensor("gps", noise=0.5), bathyal.Sensor("depth", noise=0.1)]
    return bathyal.NavigationFilter(
        sensors, **{"initial_position": 10.0, "log_walk": 0.1, **options}
    )


def test_a_fix_is_weighed_by_its_variances():
    navigation = filter_of()
    navigation.predict_motion(0.0, [0, 0, 0], [0, 0, 0])
    navigation.update("gps", 0.0, [4.0, 0, 0])
    assert navigation.position[0] == pytest.approx(4 * 100 / (100 + 0.25), rel=1e-6)
    assert navigation.covariance[0, 0] == pytest.approx(100 * 0.25 / 100.25, rel=1e-6)


def test_the_order_of_two_fixes_does_not_matter():
    ends = []
    for order in ([0, 1], [1, 0]):
        navigation = filter_of()
        navigation.predict_motion(0.0, [0, 0, 0], [0, 0, 0])
        fixes = [("gps", [4.0, 1, -2]), ("depth", [2.5])]
        for i in order:
            navigation.update(fixes[i][0], 0.0, fixes[i][1])
        ends.append(navigation.position)
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-9)


def test_a_late_fix_counts_as_if_it_had_come_in_time():
    def track(late):
        navigation = filter_of(lag=5.0)
        for second in range(11):
            navigation.predict_motion(float(second), [0, 0, 0.02 * second], [1.5, 0, 0])
            if second == (9 if late else 6):
                navigation.update("gps", 6.0, [9.5, 0.3, 0.0])
        return navigation.position, navigation.covariance

    for one, two in zip(track(late=False), track(late=True), strict=True):
        np.testing.assert_allclose(one, two, atol=1e-9)


def test_a_fix_older_than_the_lag_is_not_used():
    navigation = filter_of(lag=1.0)
    for second in range(11):
        navigation.predict_motion(float(second), [0, 0, 0], [1.5, 0, 0])
    before = navigation.to_bytes()
    assert not navigation.update("gps", 2.0, [0, 0, 0]).used
    assert navigation.to_bytes() == before


def test_a_wild_fix_is_refused_and_the_next_good_one_is_not():
    navigation = filter_of(gate=0.999)
    navigation.predict_motion(0.0, [0, 0, 0], [0, 0, 0])
    navigation.update("gps", 0.0, [0, 0, 0])
    wild = navigation.update("gps", 0.0, [500, 0, 0])
    assert (wild.used, wild.accepted) == (True, False)
    assert navigation.position[0] == pytest.approx(0, abs=1e-9)
    assert navigation.update("gps", 0.0, [0.2, 0, 0]).accepted


def test_a_restored_filter_goes_on_to_the_same_bytes():
    one, two = filter_of(), filter_of()
    for second in range(20):
        if second == 9:
            two.restore(one.to_bytes())
        for navigation in (one, two) if second >= 9 else (one,):
            navigation.predict_motion(float(second), [0, 0, 0.1 * second], [1, 0.1, 0])
            navigation.update("gps", float(second), [second, 0.1, 0])
    assert one.to_bytes() == two.to_bytes()


def test_no_bent_state_crashes_a_filter():
    navigation = filter_of()
    for second in range(5):
        navigation.predict_motion(float(second), [0, 0, 0], [1, 0, 0])
    state = navigation.to_bytes()
    chance = np.random.default_rng(2)
    for _ in range(300):
        bent = bytearray(state)
        for place in chance.integers(0, len(bent), 4):
            bent[place] = chance.integers(0, 256)
        other = filter_of()
        try:
            other.restore(bytes(bent[: chance.integers(0, len(bent) + 1)]))
            other.predict_motion(100.0, [0, 0, 0], [1, 0, 0])
            other.update("gps", 100.0, [0, 0, 0])
        except (ValueError, bathyal.Error):
            continue


@pytest.mark.parametrize("how", ["empty", "short", "long"])
def test_a_state_of_another_size_is_refused(how):
    navigation = filter_of()
    state = navigation.to_bytes()
    bent = {"empty": b"", "short": state[:-1], "long": state + b"x"}[how]
    with pytest.raises((ValueError, bathyal.Error), match=r"state|saved|bytes"):
        navigation.restore(bent)
    assert navigation.to_bytes() == state


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({"gyro_nois": 1.0}, "gyro_nois"),
        ({"gyro_noise": -1.0}, "gyro_noise"),
        ({"gyro_noise": math.nan}, "gyro_noise"),
        ({"gate": 1.5}, "gate"),
        ({"lag": -1.0}, "lag"),
        ({"gravity": math.inf}, "gravity"),
        ({"initial_position": -1.0}, "initial_position"),
        ({"pose": 2 * np.eye(4)}, "pose"),
        ({"velocity": [1, 2]}, "velocity"),
        ({"time": math.nan}, "time"),
    ],
)
def test_a_filter_that_is_none_is_refused_by_name(options, named):
    with pytest.raises(ValueError, match=named):
        filter_of(**options)


@pytest.mark.parametrize(
    ("device", "time", "values", "named"),
    [
        ("sonar", 0.0, [0, 0, 0], "sonar|device"),
        ("gps", 0.0, [0, 0], "values"),
        ("gps", 0.0, [0, 0, math.nan], "values|finite"),
        ("gps", 5.0, [0, 0, 0], "time"),
        ("gps", math.nan, [0, 0, 0], "time"),
    ],
)
def test_a_reading_that_is_none_is_refused_by_name(device, time, values, named):
    navigation = filter_of()
    navigation.predict_motion(0.0, [0, 0, 0], [0, 0, 0])
    before = navigation.to_bytes()
    with pytest.raises(ValueError, match=named):
        navigation.update(device, time, values)
    assert navigation.to_bytes() == before


def test_two_devices_of_a_name_are_refused():
    with pytest.raises(ValueError, match=r"gps|name"):
        bathyal.NavigationFilter([bathyal.Sensor("gps"), bathyal.Sensor("gps")])


def test_smoothing_needs_a_record():
    navigation = filter_of()
    navigation.predict_motion(0.0, [0, 0, 0], [0, 0, 0])
    with pytest.raises((ValueError, bathyal.Error), match="record"):
        navigation.smooth()


def test_a_smoothed_track_goes_through_its_fixes_and_beats_reckoning():
    time = np.arange(0.0, 301.0)
    yaw = 0.005 * time
    truth = bathyal.dead_reckon(time, yaw, np.tile([1.0, 0, 0], (301, 1)))
    log = np.tile([1.03, 0, 0], (301, 1)) + np.random.default_rng(1).normal(size=(301, 3)) * 0.01
    fixes = [0, 100, 200, 300]
    track = bathyal.smooth(time, yaw + 0.02, log, time[fixes], truth[fixes], fix_noise=0.05)
    reckoned = bathyal.dead_reckon(time, yaw + 0.02, log)
    smoothed_error = np.linalg.norm((track.fix_point - truth)[:, :2], axis=1)
    assert smoothed_error[fixes].max() < 0.3
    assert smoothed_error.max() < 0.2 * np.linalg.norm(reckoned - truth, axis=1).max()
