# SPDX-License-Identifier: BSD-3-Clause
"""One program on board of three vehicles: simulated, at the end of a line, from a log."""

from __future__ import annotations

import inspect
import json
import os
import signal
import subprocess
import sys
import threading
import time

import pytest

import bathyal
from tests.support.onboard import MISSION, free_port, keep_down, run_with


@pytest.fixture
def mission(tmp_path):
    path = tmp_path / "mission.yaml"
    path.write_text(MISSION)
    return path


def test_one_program_runs_on_three_vehicles_with_the_same_bytes(mission, tmp_path):
    ended = run_with(
        mission, tmp_path / "line", lambda port: keep_down(bathyal.SerialVehicle(port))
    )
    assert ended.result.status == "done"
    assert ended.result.metrics["deepest"] == pytest.approx(2.0, abs=0.15)
    assert ended.program.status == "done"

    run = bathyal.Run(mission, seed=1, log=tmp_path / "simulated.mcap")
    keep_down(bathyal.SimulatedVehicle(run))
    run.close()
    line = (tmp_path / "line" / "log.mcap").read_bytes()
    assert (tmp_path / "simulated.mcap").read_bytes() == line

    replayed = keep_down(bathyal.ReplayedVehicle(tmp_path / "line" / "log.mcap"))
    sent = ended.result.log.messages("/inputs")
    assert [number for number, _, _ in replayed.commands] == sent["number"].astype(int).tolist()
    assert [thrusters for _, thrusters, _ in replayed.commands] == sent["thrusters"].tolist()


def test_tomorrow_the_same_dive_to_the_byte(mission, tmp_path):
    run_with(mission, tmp_path / "one", lambda port: keep_down(bathyal.SerialVehicle(port)))
    bathyal.run(mission, seed=1, out=tmp_path / "two", replay=tmp_path / "one")
    for name in ("log.mcap", "run.json"):
        assert (tmp_path / "two" / name).read_bytes() == (tmp_path / "one" / name).read_bytes()
    bathyal.run(mission, seed=1, out=tmp_path / "three", inputs=lambda moment: None)
    assert (tmp_path / "three" / "log.mcap").read_bytes() != (
        tmp_path / "one" / "log.mcap"
    ).read_bytes()


def test_a_program_in_a_process_of_its_own_over_tcp(mission, tmp_path):
    number = free_port()
    mission.write_text(MISSION.replace("port: pty, name: port", f"port: 'tcp:{number}'"))
    code = (
        "import bathyal, time\n" + inspect.getsource(keep_down) + "\nfor _ in range(200):\n"
        f"    try:\n        vehicle = bathyal.SerialVehicle('tcp:{number}')\n        break\n"
        "    except ConnectionRefusedError:\n        time.sleep(0.05)\n"
        "print(keep_down(vehicle).status)\n"
    )
    program = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    result = bathyal.run(mission, seed=1, out=tmp_path / "tcp")
    assert program.communicate(timeout=30)[0] == "done\n"
    mission.write_text(MISSION)
    run_with(mission, tmp_path / "pty", lambda port: keep_down(bathyal.SerialVehicle(port)))
    assert result.metrics["deepest"] == pytest.approx(2.0, abs=0.15)
    assert (tmp_path / "tcp" / "log.mcap").read_bytes() == (
        tmp_path / "pty" / "log.mcap"
    ).read_bytes()


def test_a_run_that_was_killed_goes_on_with_what_was_commanded(mission, tmp_path):
    """Killed in the midst, its inputs so far are in the log; the rest comes from the program."""
    mission.write_text(MISSION.replace("time: 20 s", "time: 300 s"))
    whole, broken = tmp_path / "whole", tmp_path / "broken"

    def commanded(moment):
        depth = moment.latest("depth")
        push = 0.0 if depth is None else max(-1.0, min(1.0, 0.5 * (depth.values[0] - 2.0)))
        return {"thrusters": [0, 0, 0, 0, push, push, push, push]}

    bathyal.run(mission, seed=1, out=whole, inputs=commanded)
    code = f"""
import bathyal, os, signal
from tests.python.onboard.test_vehicles import commanded_then_killed
bathyal.run({str(mission)!r}, seed=1, out={str(broken)!r}, save_every=20.0,
            inputs=commanded_then_killed)
"""
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == -signal.SIGKILL
    assert (broken / "state.bin").is_file()
    bathyal.run(mission, seed=1, out=broken, resume=True, inputs=commanded)
    assert (broken / "log.mcap").read_bytes() == (whole / "log.mcap").read_bytes()


def commanded_then_killed(moment):
    if moment.number == 2345:
        os.kill(os.getpid(), signal.SIGKILL)
    depth = moment.latest("depth")
    push = 0.0 if depth is None else max(-1.0, min(1.0, 0.5 * (depth.values[0] - 2.0)))
    return {"thrusters": [0, 0, 0, 0, push, push, push, push]}


def test_a_program_may_stop_the_run_or_leave_the_pilot_alone(mission, tmp_path):
    def stopping(moment):
        return {"stop": True} if moment.number == 30 else None

    result = bathyal.run(mission, seed=1, out=tmp_path / "run", inputs=stopping)
    assert result.status == "stopped"
    again = bathyal.run(mission, seed=1, out=tmp_path / "again", replay=tmp_path / "run")
    assert again.status == "stopped"
    assert result.log.messages("/inputs")["number"].tolist() == [30]


def test_real_time_is_kept_and_late_ticks_are_counted(mission, tmp_path):
    mission.write_text(MISSION.replace("time: 20 s", "time: 2 s"))

    def slow_once(moment):
        if moment.number == 10:
            time.sleep(0.3)

    began = time.monotonic()
    bathyal.run(mission, seed=1, out=tmp_path / "run", speed=5.0, inputs=slow_once)
    assert time.monotonic() - began > 0.3 + 0.25  # 2 s at five times real time, and the delay
    found = json.loads((tmp_path / "run" / "links.json").read_text())
    assert found["late_ticks"] >= 1
    assert found["worst_delay"] > 0.2
    quick = bathyal.run(mission, seed=1, inputs=lambda moment: None)
    with open(quick.log.path, "rb") as one, open(tmp_path / "run" / "log.mcap", "rb") as two:
        assert one.read() == two.read()


@pytest.mark.parametrize("speed", [0.0, -1.0, float("nan"), float("inf")])
def test_a_speed_that_is_none_is_refused(mission, speed):
    with pytest.raises(ValueError, match="speed: expected a number above 0"):
        bathyal.run(mission, seed=1, speed=speed)


def test_inputs_with_a_replay_are_refused(mission, tmp_path):
    with pytest.raises(ValueError, match="inputs: expected none with replay"):
        bathyal.run(mission, seed=1, inputs=lambda moment: None, replay=tmp_path)


def test_commands_are_checked_on_board(mission):
    vehicle = bathyal.SimulatedVehicle(bathyal.Run(mission, seed=1))
    with pytest.raises(ValueError, match=r"thrusters: expected commands from -1 to 1, got 1\.5"):
        vehicle.command([1.5] + [0.0] * 7)
    with pytest.raises(ValueError, match="fins: expected finite angles"):
        vehicle.command([0.0] * 8, [float("nan")])


def test_a_file_that_is_no_log_is_refused(tmp_path):
    path = tmp_path / "log.mcap"
    path.write_bytes(b"no log")
    with pytest.raises(bathyal.Error):
        bathyal.ReplayedVehicle(path)
    with pytest.raises(FileNotFoundError):
        bathyal.ReplayedVehicle(tmp_path / "missing")


def test_fins_are_commanded_too(tmp_path):
    path = tmp_path / "remus.yaml"
    path.write_text(
        MISSION.replace("bluerov2_heavy", "remus100")
        .replace("- {protocol", "# {protocol")
        .replace("links:", "links: []")
    )

    def turning(angle):
        def inputs(moment):
            return {"thrusters": [0.8], "fins": [angle, 0.0]}

        return bathyal.run(path, seed=1, inputs=inputs)

    names = bathyal.read_mission(path).plan.fins
    assert names == ["rudder", "stern_plane"]
    one, two = (turning(angle).log.poses("/truth")[-1] for angle in (0.1, -0.1))
    assert abs(one[:3, 3] - two[:3, 3]).max() > 1.0


def test_two_programs_share_a_vehicle(mission, tmp_path):
    """One commands over a pseudo-terminal, another listens over TCP."""
    number = free_port()
    mission.write_text(
        MISSION.replace(
            "mission:", f"  - {{protocol: nmea, port: 'tcp:{number}', lockstep: false}}\nmission:"
        )
    )
    heard: list[int] = []

    def listening() -> None:
        vehicle = None
        while vehicle is None:
            try:
                vehicle = bathyal.SerialVehicle(f"tcp:{number}")
            except ConnectionRefusedError:
                time.sleep(0.01)
        for moment in vehicle:
            heard.append(moment.number)

    listener = threading.Thread(target=listening, daemon=True)
    listener.start()
    run_with(mission, tmp_path / "run", lambda port: keep_down(bathyal.SerialVehicle(port)))
    listener.join(10)
    assert len(heard) > 100
