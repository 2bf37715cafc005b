# SPDX-License-Identifier: BSD-3-Clause
"""A line of NMEA 0183 sentences: standard ones for what they exist for, and our own for all.

Ours: ``PBTHR`` a reading (device, kind, time, arrival, number, valid, values), ``PBTHX`` the end of
a tick's (number, time), after which an answer is waited for where the line is in lock-step;
``PBTHC`` commands (number or nothing, thrusters, fins), ``PBTHS`` a stop, ``PBTHN`` what was not
understood, ``PBTHE`` the end (status).
"""

from __future__ import annotations

import math
import time
from datetime import datetime

from bathyal._core import (
    Error,
    NmeaReader,
    SerialLine,
    nmea_dpt,
    nmea_hdt,
    nmea_position,
    nmea_sentence,
    nmea_vbw,
)
from bathyal.onboard.links import Inputs, Link, commands_of
from bathyal.onboard.moments import Moment, Reading, RunInProgress
from bathyal.onboard.place import EarthFrame, compass_degrees, date_and_time
from bathyal.onboard.ports import Port

_AGAIN = 1.0  # after so many seconds the end of a tick is sent again


def reading_body(reading: Reading) -> str:
    """A reading as a body of our own, from which it comes back the same."""
    head = (reading.device, reading.kind, repr(reading.time), repr(reading.arrival))
    values = (repr(value) if math.isfinite(value) else "" for value in reading.values)
    return ",".join(("PBTHR", *head, str(reading.number), str(int(reading.valid)), *values))


def reading_of(body: str) -> Reading:
    """The reading of a body.

    Raises
    ------
    ValueError
        For another body.
    """
    name, device, kind, at, arrival, number, valid, *values = body.split(",")
    if name != "PBTHR":
        raise ValueError(f"expected PBTHR, got {name!r}")
    numbers = tuple(float(value) if value else math.nan for value in values)
    return Reading(device, kind, float(at), float(arrival), int(number), valid == "1", numbers)


class NmeaLink(Link):
    """Readings as sentences, commands from sentences.

    Parameters
    ----------
    port : Port
    devices : list of str
        Whose readings go out.
    lockstep : bool
        Each tick waits for an answer.
    timeout : float
        For an answer [s].
    standard, own : bool
        Which sentences go out.
    line : SerialLine, optional
        That carries them; without one all arrives at once.
    earth : EarthFrame, optional
        Needed for positions.
    start : datetime
        At which the run begins, UTC.

    Raises
    ------
    ValueError
        For names of devices that no sentence can carry.
    """

    def __init__(
        self,
        port: Port,
        *,
        devices: dict[str, str],
        lockstep: bool,
        timeout: float,
        standard: bool,
        own: bool,
        line: SerialLine | None,
        earth: EarthFrame | None,
        start: datetime,
    ) -> None:
        for device in devices:
            if "," in device:
                raise ValueError(f"devices: expected names without commas, got {device!r}")
            nmea_sentence(f"PBTHR,{device}")
        self.port, self.name, self.timeout = port, port.name, timeout
        self.devices, self.lockstep = devices, lockstep
        self.standard, self.own, self.line = standard, own, line
        self.earth, self.start = earth, start
        self.reader = NmeaReader()
        self.counts = {"sentences": 0, "unread_bytes": 0, "answers": 0, "refused": 0}

    def exchange(self, moment: Moment, run: RunInProgress) -> Inputs | None:
        if self.lockstep and not self.port.ready(self.timeout):
            raise Error(f"{self.name}: no program has connected within {self.timeout:g} s")
        text = b"".join(
            self._sentences(reading, run)
            for reading in moment.readings
            if reading.device in self.devices
        )
        if self.line is not None:
            text = self.line.carry(text, run.plan.tick)
        end = nmea_sentence(f"PBTHX,{moment.number},{moment.time!r}")
        self._send(text + end if self.lockstep or self.own else text)
        if not self.lockstep:
            return self._commands(moment, run)[1]
        deadline = time.monotonic() + self.timeout
        while time.monotonic() < deadline:
            if not self.port.wait(min(_AGAIN, deadline - time.monotonic())):
                self._send(end)
                continue
            answered, inputs = self._commands(moment, run)
            if answered:
                return inputs
        raise self.silent(moment)

    def _send(self, text: bytes) -> None:
        """In lock-step a slow program is waited for; otherwise what it leaves unread is lost."""
        deadline = time.monotonic() + self.timeout
        self.counts["sentences"] += text.count(b"\n")
        while text:
            text = text[self.port.write(text) :]
            if text and (not self.lockstep or time.monotonic() > deadline):
                self.counts["unread_bytes"] += len(text)
                return
            if text:
                time.sleep(0.0005)

    def _sentences(self, reading: Reading, run: RunInProgress) -> bytes:
        text = self._standard(reading, run) if self.standard else b""
        return text + nmea_sentence(reading_body(reading)) if self.own else text

    def _standard(self, reading: Reading, run: RunInProgress) -> bytes:
        first = reading.values[0]
        if reading.kind == "gps" and self.earth is not None:
            return self._position(reading, self.earth, run)
        if reading.kind == "compass" and reading.valid:
            return nmea_hdt(compass_degrees(reading.values[2]))
        if reading.kind == "altimeter" and reading.valid:
            return nmea_dpt(max(0.0, first))
        if reading.kind == "dvl":
            return nmea_vbw(first, reading.values[1], reading.valid)
        return b""

    def _position(self, reading: Reading, earth: EarthFrame, run: RunInProgress) -> bytes:
        date, seconds = date_and_time(self.start, reading.time)
        x, y, z = reading.values if reading.valid else (0.0, 0.0, 0.0)
        latitude, longitude = earth.place(x, y)
        east, north = (run.pose[:3, :3] @ run.velocity[:3])[:2]
        return nmea_position(
            date=date,
            time=seconds,
            latitude=latitude,
            longitude=longitude,
            altitude=z,
            speed=math.hypot(east, north),
            course=math.degrees(math.atan2(east, north)) % 360.0,
            valid=reading.valid,
        )

    def _commands(self, moment: Moment, run: RunInProgress) -> tuple[bool, Inputs | None]:
        """Whether this tick is answered, and with what; of several answers the last."""
        answered, inputs = False, None
        for body in self.reader.feed(self.port.read()):
            kind, *fields = body.split(",")
            if kind not in ("PBTHC", "PBTHS"):
                continue
            try:
                number = int(fields[0]) if fields and fields[0] else None
                if self.lockstep and number is not None and number < moment.number:
                    continue  # to a tick's end that was sent twice
                if number is not None and number > moment.number:
                    raise ValueError(f"expected tick {moment.number}, got {number}")
                if kind == "PBTHS":
                    inputs = {"stop": True}
                else:
                    values = [float(value) for value in fields[1:]]
                    inputs = commands_of(values, run, "PBTHC")
            except ValueError as error:
                self.counts["refused"] += 1
                self._send(nmea_sentence("PBTHN," + _plain(str(error))))
                if self.lockstep:
                    raise Error(f"{self.name}: {body[:100]!r}: {error}") from error
                continue
            self.counts["answers"] += 1
            answered = True
        return answered, inputs

    def close(self, status: str) -> None:
        if self.own or self.lockstep:
            self.port.write(nmea_sentence(f"PBTHE,{status}"))
        self.port.close()

    def report(self) -> dict[str, int | str]:
        found: dict[str, int | str] = {"port": self.name, **self.counts}
        read = self.reader.counts
        found |= {key: read[key] for key in ("wrong_checksum", "broken")}
        if self.line is not None:
            carried = self.line.counts
            found |= {"overrun_bytes": carried["lost"], "turned_bits": carried["turned_bits"]}
        return found


def _plain(text: str) -> str:
    return "".join(
        c if c.isascii() and c.isprintable() and c not in "$!*\\^~" else "?" for c in text
    )
