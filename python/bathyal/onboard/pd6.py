# SPDX-License-Identifier: BSD-3-Clause
"""A line of a Doppler velocity log: Teledyne RDI's PD6 text."""

from __future__ import annotations

import math
from datetime import datetime

from bathyal._core import SerialLine, pd6_text
from bathyal.onboard.links import Inputs, Link
from bathyal.onboard.moments import Moment, Reading, RunInProgress
from bathyal.onboard.place import compass_degrees, date_and_time
from bathyal.onboard.ports import Port

_FASTEST, _FARTHEST, _LONGEST = 99.999, 9999.99, 999.99  # that its digits hold


class Pd6Link(Link):
    """Ensembles of a velocity log, one a reading; attitude, depth and altitude are the last ones.

    Parameters
    ----------
    port : Port
    device : str
        The log.
    line : SerialLine, optional
    start : datetime
        At which the run begins, UTC.
    """

    def __init__(
        self, port: Port, *, device: str, line: SerialLine | None, start: datetime
    ) -> None:
        self.port, self.name, self.timeout = port, port.name, 0.0
        self.device, self.line, self.start = device, line, start
        self.last: dict[str, Reading] = {}
        self.good = 0.0
        self.counts = {"ensembles": 0, "unread_bytes": 0}

    def exchange(self, moment: Moment, run: RunInProgress) -> Inputs | None:
        text = b""
        for reading in moment.readings:
            if reading.valid:
                self.last[reading.kind] = reading
            if reading.device == self.device:
                text += self._ensemble(reading)
                self.counts["ensembles"] += 1
        if self.line is not None:
            text = self.line.carry(text, run.plan.tick)
        self.counts["unread_bytes"] += len(text) - self.port.write(text)
        self.port.read()  # commands to an instrument are not answered
        return None

    def _ensemble(self, reading: Reading) -> bytes:
        date, seconds = date_and_time(self.start, reading.time)
        valid = reading.valid and max(map(abs, reading.values)) <= _FASTEST
        if valid:
            self.good = reading.time
        compass, depth, altimeter = map(self.last.get, ("compass", "depth", "altimeter"))
        roll, pitch, yaw = compass.values if compass else (0.0, 0.0, 0.5 * math.pi)
        return pd6_text(
            date=date,
            time=seconds,
            heading=compass_degrees(yaw),
            pitch=-math.degrees(pitch),
            roll=math.degrees(roll),
            depth=depth.values[0] if depth else 0.0,
            velocity=reading.values if valid else (0.0, 0.0, 0.0),
            altitude=min(max(0.0, altimeter.values[0]), _FARTHEST) if altimeter else None,
            age=min(reading.time - self.good, _LONGEST),
            valid=valid,
        )

    def close(self, status: str) -> None:
        self.port.close()

    def report(self) -> dict[str, int | str]:
        found: dict[str, int | str] = {"port": self.name, **self.counts}
        if self.line is not None:
            carried = self.line.counts
            found |= {"overrun_bytes": carried["lost"], "turned_bits": carried["turned_bits"]}
        return found
