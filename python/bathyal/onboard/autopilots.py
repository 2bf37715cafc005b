# SPDX-License-Identifier: BSD-3-Clause
"""Autopilots in the loop: ArduSub by JSON over UDP, PX4 by MAVLink's HIL messages over TCP."""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, ardupilot_json, read_servo_packet
from bathyal.io.files import need
from bathyal.io.poses import pose_of
from bathyal.onboard.links import Inputs, Link, commands_of
from bathyal.onboard.moments import Moment, Reading, RunInProgress
from bathyal.onboard.place import EarthFrame
from bathyal.onboard.ports import DatagramPort, TcpPort

Array = NDArray[np.float64]

TO_DOWN = np.diag([1.0, -1.0, -1.0])  # ahead, port, up → ahead, starboard, down
TO_NORTH = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])  # east, north, up → NED
MAGNETIC = np.array([0.21, 0.0, 0.43])  # of the Earth at middle latitudes, north, east, down [G]
SURFACE, PER_METRE = 1013.25, 100.5  # pressure [hPa] and its growth in sea water [hPa/m]


def attitude_down(pose: Array) -> tuple[float, float, float]:
    """Roll, pitch, yaw [rad] from north, east, down to ahead, starboard, down."""
    turn = TO_NORTH @ pose[:3, :3] @ TO_DOWN
    return (
        math.atan2(turn[2, 1], turn[2, 2]),
        -math.asin(max(-1.0, min(1.0, turn[2, 0]))),
        math.atan2(turn[1, 0], turn[0, 0]),
    )


class _Imu:
    """The last rates and specific force, along ahead, starboard, down."""

    def __init__(self) -> None:
        self.gyro, self.force = np.zeros(3), np.array([0.0, 0.0, -9.81])

    def take(self, reading: Reading) -> None:
        self.gyro = TO_DOWN @ np.array(reading.values[:3])
        self.force = TO_DOWN @ np.array(reading.values[3:])


class ArduSubLink(Link):
    """ArduPilot's software in the loop, started with ``--model JSON:127.0.0.1``.

    Each of its packets is one tick. It receives the true state, with the rates and specific force
    of the mission's IMU where there is one.

    Parameters
    ----------
    port : DatagramPort
    channels : list of int
        Of each thruster, from 1; the first ones unless given.
    timeout : float
        For a packet [s].
    """

    def __init__(self, port: DatagramPort, *, channels: list[int] | None, timeout: float) -> None:
        self.port, self.name, self.timeout = port, port.name, timeout
        self.channels = channels
        self.imu = _Imu()
        self.frame = -1
        self.counts = {"packets": 0, "refused": 0, "repeated": 0, "missed": 0, "restarts": 0}
        self.rate = 0

    def exchange(self, moment: Moment, run: RunInProgress) -> Inputs | None:
        for reading in moment.readings:
            if reading.kind == "imu" and reading.valid:
                self.imu.take(reading)
        state = self._state(moment, run)
        if self.frame >= 0:
            self.port.answer(state)
        deadline = time.monotonic() + self.timeout
        while (left := deadline - time.monotonic()) > 0.0:
            given = self.port.receive(left)
            if given is None:
                break
            try:
                rate, frame, commands = read_servo_packet(given)
            except Error:
                self.counts["refused"] += 1
                continue
            self.rate = rate
            if frame == self.frame:
                self.counts["repeated"] += 1
                self.port.answer(state)
                continue
            if self.frame >= 0:
                self.counts["missed"] += max(0, frame - self.frame - 1)
                self.counts["restarts"] += int(frame < self.frame)
            self.frame = frame
            self.counts["packets"] += 1
            return self._inputs(commands, run)
        raise self.silent(moment)

    def _inputs(self, commands: list[float], run: RunInProgress) -> Inputs | None:
        channels = self.channels or list(range(1, len(run.plan.thrusters) + 1))
        if max(channels) > len(commands):
            raise Error(
                f"{self.name}: channels: expected at most {len(commands)}, got {max(channels)}"
            )
        return commands_of([commands[row - 1] for row in channels], run, "servo packet")

    def _state(self, moment: Moment, run: RunInProgress) -> bytes:
        pose = run.pose
        altimeter = moment.latest("altimeter")
        return ardupilot_json(
            time=moment.time,
            gyro=self.imu.gyro,
            force=self.imu.force,
            position=TO_NORTH @ pose[:3, 3],
            attitude=attitude_down(pose),
            velocity=TO_NORTH @ pose[:3, :3] @ run.velocity[:3],
            altitude=altimeter.values[0] if altimeter and altimeter.valid else None,
        )

    def close(self, status: str) -> None:
        self.port.close()

    def report(self) -> dict[str, int | str]:
        return {"port": self.name, **self.counts, "rate_asked_for": self.rate}


class MavlinkLink(Link):
    """PX4's software in the loop: HIL_SENSOR and HIL_GPS out, HIL_ACTUATOR_CONTROLS in.

    In lock-step each tick waits for its actuators, from the first ones on that have come.

    Parameters
    ----------
    port : TcpPort
    earth : EarthFrame, optional
        Needed for positions.
    channels : list of int
        Of each thruster, from 1; the first ones unless given.
    lockstep : bool
    timeout : float
        For an answer, and for the connection [s].

    Raises
    ------
    Error
        Without the package pymavlink.
    """

    def __init__(
        self,
        port: TcpPort,
        *,
        earth: EarthFrame | None,
        channels: list[int] | None,
        lockstep: bool,
        timeout: float,
    ) -> None:
        self.mavlink: Any = need(
            "pymavlink.dialects.v20.common", "pymavlink", "protocol: mavlink", extra="mavlink"
        )
        self.port, self.name, self.timeout = port, port.name, timeout
        self.earth, self.channels, self.lockstep = earth, channels, lockstep
        self.codec = self.mavlink.MAVLink(None, srcSystem=1, srcComponent=51)
        self.codec.robust_parsing = True
        self.imu = _Imu()
        self.answering = False
        self.counts = {"messages": 0, "actuators": 0, "refused": 0, "without_lockstep_flag": 0}

    def exchange(self, moment: Moment, run: RunInProgress) -> Inputs | None:
        if not self.port.ready(self.timeout):
            raise Error(f"{self.name}: no program has connected within {self.timeout:g} s")
        self.port.write(b"".join(self._messages(moment, run)))
        if not (self.lockstep and self.answering):
            return self._inputs(run)
        deadline = time.monotonic() + self.timeout
        while (left := deadline - time.monotonic()) > 0.0:
            if self.port.wait(left) and (inputs := self._inputs(run)) is not None:
                return inputs
        raise self.silent(moment)

    def _messages(self, moment: Moment, run: RunInProgress) -> list[bytes]:
        stamp = round(moment.time * 1e6)
        messages = []
        updated = 0
        for reading in moment.readings:
            if reading.kind == "imu" and reading.valid:
                self.imu.take(reading)
                updated |= 0b111111
            elif reading.kind == "depth" and reading.valid:
                updated |= 1 << 9
            elif reading.kind == "compass" and reading.valid:
                updated |= 0b111 << 6
            elif reading.kind == "gps" and reading.valid and self.earth is not None:
                messages.append(self._gps(reading, self.earth, stamp, run))
        depth, compass = moment.latest("depth"), moment.latest("compass")
        pressure = SURFACE + PER_METRE * (depth.values[0] if depth else 0.0)
        field = np.zeros(3)
        if compass:
            turn = pose_of((0.0, 0.0, 0.0), compass.values)[:3, :3]
            field = (TO_NORTH @ turn @ TO_DOWN).T @ MAGNETIC
        sensor = self.mavlink.MAVLink_hil_sensor_message(
            stamp,
            *self.imu.force,
            *self.imu.gyro,
            *field,
            pressure,
            0.0,
            0.0,
            15.0,
            updated,
        )
        return [self._packed(sensor), *messages]

    def _gps(self, reading: Reading, earth: EarthFrame, stamp: int, run: RunInProgress) -> bytes:
        x, y, z = reading.values
        latitude, longitude = earth.place(x, y)
        north, east, down = TO_NORTH @ run.pose[:3, :3] @ run.velocity[:3]
        course = math.degrees(math.atan2(east, north)) % 360.0
        return self._packed(
            self.mavlink.MAVLink_hil_gps_message(
                stamp,
                3,
                round(latitude * 1e7),
                round(longitude * 1e7),
                round(z * 1e3),
                90,
                120,
                round(100.0 * math.hypot(north, east)),
                round(100.0 * north),
                round(100.0 * east),
                round(100.0 * down),
                round(100.0 * course) % 36000,
                9,
            )
        )

    def _packed(self, message: Any) -> bytes:
        self.counts["messages"] += 1
        packed = bytes(message.pack(self.codec))
        self.codec.seq = (self.codec.seq + 1) % 256
        return packed

    def _inputs(self, run: RunInProgress) -> Inputs | None:
        """Of the last actuators that have come."""
        found: Inputs | None = None
        for message in self.codec.parse_buffer(self.port.read()) or []:
            if message.get_type() == "BAD_DATA":
                self.counts["refused"] += 1
            if message.get_type() != "HIL_ACTUATOR_CONTROLS":
                continue
            if not message.flags & 1:
                self.counts["without_lockstep_flag"] += 1
            channels = self.channels or list(range(1, len(run.plan.thrusters) + 1))
            values = [float(message.controls[row - 1]) for row in channels]
            if not all(math.isfinite(value) for value in values):
                self.counts["refused"] += 1
                continue
            self.counts["actuators"] += 1
            self.answering = True
            found = commands_of(values, run, "HIL_ACTUATOR_CONTROLS")
        return found

    def close(self, status: str) -> None:
        self.port.close()

    def report(self) -> dict[str, int | str]:
        return {"port": self.name, **self.counts}
