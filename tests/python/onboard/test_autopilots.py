# SPDX-License-Identifier: BSD-3-Clause
"""Autopilots in the loop: peers that speak as ArduSub and PX4 do."""

from __future__ import annotations

import json
import math
import socket
import threading
import time

import numpy as np
import pytest

import bathyal
from bathyal._core import servo_packet
from bathyal.onboard.autopilots import attitude_down
from tests.support.onboard import MISSION, free_port

LINE = "{protocol: nmea, port: pty, name: port, timeout: 20}"
FAST = "step: 0.02\nsteps_per_tick: 1\nmission: [wait: {time: 10 s}]\n"


def mission_with(tmp_path, link):
    path = tmp_path / "mission.yaml"
    path.write_text(MISSION.replace(LINE, link).split("mission:")[0] + FAST)
    return path


def in_thread(function):
    thread = threading.Thread(target=function, daemon=True)
    thread.start()
    return thread


class ArduSub:
    """Sends servo packets and reads states, as the program does with --model JSON."""

    def __init__(self, number, channels=16):
        self.number, self.channels = number, channels
        self.states = []

    def fly(self, *, ticks, twice_at=-1, noise_at=-1):
        line = socket.socket(type=socket.SOCK_DGRAM)
        line.settimeout(0.2)
        peer = ("127.0.0.1", self.number)
        down = 1500
        frame = 0
        while frame <= ticks:
            pulses = [1500] * 4 + [down] * 4 + [0] * (self.channels - 8)
            packet = servo_packet(rate=50, frame=frame, pulses=pulses)
            try:
                line.sendto(packet, peer)
                if frame == noise_at:
                    line.sendto(b"noise", peer)
                    noise_at = -1
                if frame == twice_at and self.states:
                    line.sendto(packet, peer)
                if frame == ticks:
                    return
                given = line.recv(65536)
            except (TimeoutError, ConnectionRefusedError):
                time.sleep(0.01)
                continue
            assert given[:1] == given[-1:] == b"\n"
            state = json.loads(given)
            if self.states and state["timestamp"] <= self.states[-1]["timestamp"]:
                continue
            self.states.append(state)
            depth = state["position"][2]
            down = round(1500 + 400 * max(-1.0, min(1.0, 0.5 * (depth - 2.0))))
            frame += 1


@pytest.mark.parametrize("channels", [16, 32])
def test_ardusub_steers(tmp_path, channels):
    number = free_port(socket.SOCK_DGRAM)
    path = mission_with(tmp_path, f"{{protocol: ardusub, port: 'udp:{number}', timeout: 5}}")
    pilot = ArduSub(number, channels)
    thread = in_thread(lambda: pilot.fly(ticks=500, twice_at=50, noise_at=60))
    result = bathyal.run(path, seed=1, out=tmp_path / "run")
    thread.join(10)
    assert result.status == "done"
    assert result.metrics["deepest"] == pytest.approx(2.0, abs=0.2)
    (found,) = json.loads((tmp_path / "run" / "links.json").read_text())["links"]
    assert found["packets"] == 501
    assert found["refused"] == 1
    assert found["missed"] == found["restarts"] == 0
    last = pilot.states[-1]
    # z of the world is up, down is down; x is east
    truth = result.log.messages("/truth")
    row = np.argmin(np.abs(truth["time"] - last["timestamp"]))
    assert last["position"][2] == pytest.approx(-truth["pose.position.z"][row], abs=1e-9)
    assert last["position"][1] == pytest.approx(truth["pose.position.x"][row], abs=1e-9)
    assert last["attitude"][2] == pytest.approx(0.5 * math.pi, abs=0.1)
    assert last["imu"]["accel_body"][2] == pytest.approx(-9.81, abs=0.2)
    again = bathyal.run(path, seed=1, out=tmp_path / "again", replay=tmp_path / "run")
    assert again.log.path.read_bytes() == result.log.path.read_bytes()


def test_ardusub_is_silent(tmp_path):
    number = free_port(socket.SOCK_DGRAM)
    path = mission_with(tmp_path, f"{{protocol: ardusub, port: 'udp:{number}', timeout: 0.2}}")
    with pytest.raises(bathyal.Error, match=rf"udp:{number}: no answer to tick 0 within 0.2 s"):
        bathyal.run(path, seed=1, out=tmp_path / "run")


def test_channels_that_a_packet_has_not(tmp_path):
    number = free_port(socket.SOCK_DGRAM)
    link = f"{{protocol: ardusub, port: 'udp:{number}', timeout: 5, channels: [1,2,3,4,5,6,7,20]}}"
    path = mission_with(tmp_path, link)
    in_thread(lambda: ArduSub(number).fly(ticks=1))
    with pytest.raises(bathyal.Error, match="channels: expected at most 16, got 20"):
        bathyal.run(path, seed=1, out=tmp_path / "run")


def test_attitudes_are_turned_to_ahead_starboard_down():
    def turned(axis, angle):
        cos, sin = math.cos(angle), math.sin(angle)
        pose = np.eye(4)
        i, j = [(1, 2), (2, 0), (0, 1)][axis]
        pose[i, i] = pose[j, j] = cos
        pose[i, j], pose[j, i] = -sin, sin
        return pose

    north = turned(2, 0.5 * math.pi)
    assert attitude_down(north) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    assert attitude_down(turned(2, 0.2)) == pytest.approx((0.0, 0.0, 0.5 * math.pi - 0.2))
    # about port, bow down: pitch is negative; about ahead, port up: roll is positive
    assert attitude_down(north @ turned(1, 0.3)) == pytest.approx((0.0, -0.3, 0.0), abs=1e-12)
    assert attitude_down(north @ turned(0, 0.3)) == pytest.approx((0.3, 0.0, 0.0), abs=1e-12)


class Px4:
    """Connects, answers each HIL_SENSOR with HIL_ACTUATOR_CONTROLS, its lock-step flag set."""

    def __init__(self, number, flags=1):
        self.mavlink = pytest.importorskip("pymavlink.dialects.v20.common")
        self.number, self.flags = number, flags
        self.sensors, self.positions = [], []

    def fly(self, hang_after=None):
        codec = self.mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        line = None
        while line is None:
            try:
                line = socket.create_connection(("127.0.0.1", self.number))
            except ConnectionRefusedError:
                time.sleep(0.01)
        while given := line.recv(65536):
            for message in codec.parse_buffer(given) or []:
                if message.get_type() == "HIL_GPS":
                    self.positions.append(message)
                if message.get_type() != "HIL_SENSOR":
                    continue
                self.sensors.append(message)
                if len(self.sensors) == hang_after:
                    time.sleep(3.0)
                    return
                depth = (message.abs_pressure - 1013.25) / 100.5
                push = max(-1.0, min(1.0, 0.5 * (depth - 2.0)))
                controls = [0.0] * 4 + [push] * 4 + [0.0] * 8
                answer = self.mavlink.MAVLink_hil_actuator_controls_message(
                    message.time_usec, controls, 128, self.flags
                )
                line.sendall(answer.pack(codec))
        line.close()


def test_px4_steers(tmp_path):
    number = free_port()
    path = mission_with(tmp_path, f"{{protocol: mavlink, port: 'tcp:{number}', timeout: 5}}")
    text = path.read_text().replace(
        "mission:",
        "sensors:\n  - {kind: depth, rate: 50}\n  - {kind: imu, rate: 50}\n"
        "  - {kind: compass, rate: 50}\n"
        "  - {kind: gps, rate: 5, pose: {position: [0, 0, 1]}}\nmission:",
    )
    path.write_text(text)
    pilot = Px4(number)
    thread = in_thread(pilot.fly)
    result = bathyal.run(path, seed=1, out=tmp_path / "run")
    thread.join(10)
    assert result.status == "done"
    assert result.metrics["deepest"] == pytest.approx(2.0, abs=0.2)
    (found,) = json.loads((tmp_path / "run" / "links.json").read_text())["links"]
    assert found["actuators"] >= 499
    assert found["refused"] == found["without_lockstep_flag"] == 0
    first, last = pilot.sensors[0], pilot.sensors[-1]
    assert first.time_usec == 0
    assert last.zacc == pytest.approx(-9.81, abs=0.2)
    assert last.fields_updated & 0b111 == 0b111
    # the bow is to the east: the field of the north comes from port
    assert last.ymag == pytest.approx(-0.21, abs=0.03)
    assert pilot.positions[0].lat == pytest.approx(431000360, abs=2)
    assert pilot.positions[0].lon == pytest.approx(1319000369, abs=2)
    assert pilot.positions[0].fix_type == 3
    again = bathyal.run(path, seed=1, out=tmp_path / "again", replay=tmp_path / "run")
    assert again.log.path.read_bytes() == result.log.path.read_bytes()


def test_px4_hangs(tmp_path):
    number = free_port()
    path = mission_with(tmp_path, f"{{protocol: mavlink, port: 'tcp:{number}', timeout: 0.5}}")
    in_thread(lambda: Px4(number).fly(hang_after=20))
    with pytest.raises(bathyal.Error, match=rf"tcp:{number}: no answer to tick \d+ within 0.5 s"):
        bathyal.run(path, seed=1, out=tmp_path / "run")


def test_actuators_without_the_lock_step_flag_are_counted(tmp_path):
    number = free_port()
    path = mission_with(tmp_path, f"{{protocol: mavlink, port: 'tcp:{number}', timeout: 5}}")
    in_thread(Px4(number, flags=0).fly)
    bathyal.run(path, seed=1, out=tmp_path / "run")
    (found,) = json.loads((tmp_path / "run" / "links.json").read_text())["links"]
    assert found["without_lockstep_flag"] == found["actuators"] > 100
