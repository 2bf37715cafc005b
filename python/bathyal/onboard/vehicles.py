# SPDX-License-Identifier: BSD-3-Clause
"""The vehicle as software on board sees it: simulated, at the end of a line, or from a log.

One program runs on all three:

>>> def keep_down(vehicle):
...     for moment in vehicle:
...         depth = moment.latest("depth")
...         if depth is not None:
...             push = max(-1.0, min(1.0, 0.5 * (depth.values[0] - 2.0)))
...             vehicle.command([0, 0, 0, 0, push, push, push, push])
"""

from __future__ import annotations

import json
import math
import os
import select
import socket
import tty
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from bathyal._core import Error, NmeaReader, mcap_messages, nmea_sentence
from bathyal.io.files import PathLike
from bathyal.onboard.moments import Moment, Reading, RunInProgress, moment_of
from bathyal.onboard.nmea import reading_of

_PIECE = 65536


class OnboardVehicle(ABC):
    """What software on board reads and commands: iterate over its moments, command within."""

    def __init__(self) -> None:
        self._thrusters: list[float] | None = None
        self._fins: list[float] | None = None

    @abstractmethod
    def __iter__(self) -> Iterator[Moment]:
        """Tick by tick, to the end of the run."""

    def command(self, thrusters: Sequence[float], fins: Sequence[float] | None = None) -> None:
        """For this tick, in place of the pilot's; without a call the pilot steers.

        Parameters
        ----------
        thrusters : (n,) sequence
            −1 to 1.
        fins : (m,) sequence, optional
            [rad]

        Raises
        ------
        ValueError
            For commands that are not finite, or out of −1 to 1.
        """
        values = [float(value) for value in thrusters]
        for value in values:
            if not -1.0 <= value <= 1.0:
                raise ValueError(f"thrusters: expected commands from -1 to 1, got {value!r}")
        angles = None if fins is None else [float(angle) for angle in fins]
        if angles is not None and not all(map(math.isfinite, angles)):
            raise ValueError(f"fins: expected finite angles, got {angles}")
        self._thrusters, self._fins = values, angles

    def _taken(self) -> tuple[list[float] | None, list[float] | None]:
        taken = self._thrusters, self._fins
        self._thrusters = self._fins = None
        return taken


class SimulatedVehicle(OnboardVehicle):
    """A run of this process.

    Parameters
    ----------
    run : Run

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> from bathyal.mission.example import write_mission_example
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "mission.yaml"
    >>> _ = write_mission_example(path)
    >>> vehicle = bathyal.SimulatedVehicle(bathyal.Run(path, seed=1))
    >>> for moment in vehicle:
    ...     vehicle.command([0.5] * 4 + [0.0] * 4)
    ...     if moment.time >= 1.0:
    ...         break
    >>> moment.number, sorted({reading.device for reading in moment.readings})
    (10, ['altimeter', 'compass', 'depth', 'dvl', 'gps', 'imu', 'leak'])
    """

    def __init__(self, run: RunInProgress) -> None:
        super().__init__()
        self.run = run

    def __iter__(self) -> Iterator[Moment]:
        while self.run.status == "running":
            yield moment_of(self.run)
            thrusters, fins = self._taken()
            inputs: dict[str, object] = {}
            if thrusters is not None:
                inputs["thrusters"] = thrusters
            if fins is not None:
                inputs["fins"] = fins
            self.run.step(inputs)


class ReplayedVehicle(OnboardVehicle):
    """A run's log: the readings of then; commands change nothing, and are kept.

    Parameters
    ----------
    log : path
        ``log.mcap``, whole or cut.

    Attributes
    ----------
    commands : list of tuples
        Number of the tick, thrusters, fins: what the program has commanded.

    Raises
    ------
    OSError
        Where there is no such file.
    Error
        For a file that is no log of a mission.
    """

    def __init__(self, log: PathLike) -> None:
        super().__init__()
        self.path = Path(log)
        self.commands: list[tuple[int, list[float], list[float] | None]] = []
        self._rows = list(mcap_messages(self.path.read_bytes()))
        if not any(topic == "/state" for topic, _ in self._rows):
            raise Error(f"{self.path}: expected a log of a mission, got one without /state")

    def __iter__(self) -> Iterator[Moment]:
        readings: list[Reading] = []
        for topic, data in self._rows:
            device = topic.removeprefix("/sensors/")
            if device != topic:
                readings.append(_logged(device, json.loads(data)))
            elif topic == "/state":
                state = json.loads(data)
                number = int(state["number"])
                yield Moment(number, float(state["elapsed"]), readings)
                thrusters, fins = self._taken()
                if thrusters is not None:
                    self.commands.append((number, thrusters, fins))
                readings = []


class SerialVehicle(OnboardVehicle):
    """A vehicle, or its simulator, at the end of a line of NMEA sentences in lock-step.

    Parameters
    ----------
    port : str
        A path (a pseudo-terminal, a serial device that is set up), or ``tcp:10110`` on this
        machine.
    timeout : float
        For the next tick [s].

    Attributes
    ----------
    status : str
        How the run has ended; "running" until then.
    reader : NmeaReader
        Its ``counts`` tell what was broken on the line.

    Raises
    ------
    OSError
        Where the port cannot be opened.
    """

    def __init__(self, port: PathLike, *, timeout: float = 60.0) -> None:
        super().__init__()
        self.port, self.timeout = str(port), timeout
        self.status = "running"
        self.reader = NmeaReader()
        self._handle = _opened(self.port)

    def __iter__(self) -> Iterator[Moment]:
        readings: list[Reading] = []
        answered, answer = -1, b""
        while self.status == "running":
            for body in self.reader.feed(self._read()):
                kind, *fields = body.split(",")
                if kind == "PBTHR":
                    readings.append(reading_of(body))
                elif kind == "PBTHE":
                    self.status = fields[0]
                elif kind == "PBTHN":
                    raise Error(f"{self.port}: not understood: {','.join(fields)}")
                elif kind == "PBTHX":
                    number = int(fields[0])
                    if number != answered:
                        yield Moment(number, float(fields[1]), readings)
                        readings = []
                        answered, answer = number, self._answer(number)
                    self._write(answer)

    def _answer(self, number: int) -> bytes:
        thrusters, fins = self._taken()
        values = [*(thrusters or []), *(fins or [])]
        return nmea_sentence(",".join(["PBTHC", str(number), *map(repr, values)]))

    def _read(self) -> bytes:
        if not select.select([self._handle], [], [], self.timeout)[0]:
            raise Error(f"{self.port}: nothing has come for {self.timeout:g} s")
        given = os.read(self._handle, _PIECE)
        if not given:
            self.status = "closed"
        return given

    def _write(self, given: bytes) -> None:
        while given:
            given = given[os.write(self._handle, given) :]

    def close(self) -> None:
        """Closes the port."""
        os.close(self._handle)


def _opened(port: str) -> int:
    if port.startswith("tcp:"):
        connection = socket.create_connection(("127.0.0.1", int(port[4:])))
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return connection.detach()
    handle = os.open(port, os.O_RDWR | os.O_NOCTTY)
    if os.isatty(handle):
        tty.setraw(handle, when=0)
    return handle


def _logged(device: str, row: dict[str, Any]) -> Reading:
    values = tuple(math.nan if value is None else float(value) for value in row["values"])
    return Reading(
        device, row["kind"], row["sampled"], row["arrival"], row["index"], row["valid"], values
    )
