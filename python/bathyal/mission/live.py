# SPDX-License-Identifier: BSD-3-Clause
"""Runs that go on with what comes from outside: links, functions, records; real time."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bathyal._core import mcap_messages
from bathyal.onboard.links import Inputs, Link
from bathyal.onboard.moments import Moment, moment_of

if TYPE_CHECKING:
    from bathyal.mission.files import Mission
    from bathyal.mission.run import Run

_TICKS = 100  # between two looks, where nothing comes from outside


def recorded_inputs(log: Path) -> dict[int, Inputs]:
    """Inputs by the number of their tick, as a log has them.

    Raises
    ------
    OSError
        Where there is no such file.
    Error
        For one that is no log.
    """
    found: dict[int, Inputs] = {}
    for topic, data in mcap_messages(log.read_bytes()):
        if topic != "/inputs":
            continue
        row = json.loads(data)
        given = {key: row[key] for key in ("wrench", "thrusters", "fins") if row[key]}
        found[row["number"]] = {"stop": True, **given} if row["stop"] else given
    return found


class Pace:
    """Keeps a run at a multiple of real time, and counts what comes late.

    Parameters
    ----------
    speed : float, optional
        None: as fast as it goes.

    Raises
    ------
    ValueError
        For a speed that is not above 0.
    """

    def __init__(self, speed: float | None) -> None:
        if speed is not None and not (speed > 0 and math.isfinite(speed)):
            raise ValueError(f"speed: expected a number above 0, got {speed!r}")
        self.speed = speed
        self.began: float | None = None  # the clock at the run's time 0
        self.late, self.worst = 0, 0.0

    def wait(self, now: float, tick: float) -> None:
        """Until it is time for a tick; one that is a whole tick late is counted, and its delay
        not made up for."""
        if self.speed is None:
            return
        clock = time.monotonic()
        if self.began is None:
            self.began = clock - now / self.speed
        due = self.began + now / self.speed
        if clock < due:
            time.sleep(due - clock)
        elif clock - due > tick / self.speed:
            self.late += 1
            self.worst = max(self.worst, clock - due)
            self.began += clock - due


class LiveRun:
    """What a run is given from outside; its links are open from now on.

    Parameters
    ----------
    mission : Mission
    seed : int
    folder : Path
        For pseudo-terminals.
    speed : float, optional
        Times real time.
    inputs : function, optional
        In place of links.
    replay : bool
        Neither links nor function: all inputs are recorded ones.

    Raises
    ------
    Error
        Where a link cannot be opened.
    ValueError
        For a speed that is not above 0.
    """

    def __init__(
        self,
        mission: Mission,
        folder: Path,
        *,
        seed: int,
        speed: float | None,
        inputs: Callable[[Moment], Inputs | None] | None,
        replay: bool,
    ) -> None:
        self.inputs = inputs
        self.pace = Pace(speed)
        self.links: list[Link] = []
        self.ticks = 0
        self.asking = False  # while software outside is: the run is whole then, between two ticks
        sections = mission.sections
        if sections.links and inputs is None and not replay:
            from bathyal.onboard.opening import open_links

            self.links = open_links(sections, mission.plan, folder=folder, seed=seed)
        self.is_live = bool(self.links) or speed is not None

    def finish(self, run: Run, recorded: dict[int, Inputs], look: Callable[[], None]) -> None:
        """Runs to the end; calls `look` now and then.

        Parameters
        ----------
        run : Run
        recorded : dict
            Inputs by tick, before those from outside.
        look : function
        """
        status, last = "failed", max(recorded, default=-1)
        try:
            while self._step(run, recorded, last):
                if run.number % _TICKS == 0:
                    look()
            status = run.status
        finally:
            for link in self.links:
                link.close(status)

    def _step(self, run: Run, recorded: dict[int, Inputs], last: int) -> bool:
        number = run.number
        self.pace.wait(run.time, run.plan.tick)
        self.ticks += 1
        if number in recorded:
            return run.step(recorded[number])
        if self.inputs is not None or (self.links and number > last):
            self.asking = True
            given = self._asked(run)
            self.asking = False
            return run.step(given)
        quiet = number > last and self.pace.speed is None
        return run.step(count=_TICKS - number % _TICKS if quiet else 1)

    def _asked(self, run: Run) -> Inputs:
        moment = moment_of(run)
        if self.inputs is not None:
            return self.inputs(moment) or {}
        given: Inputs = {}
        for link in self.links:
            given |= link.exchange(moment, run) or {}
        return given

    def report(self) -> dict[str, Any]:
        """What the links have carried and lost, and how late ticks were."""
        return {
            "ticks": self.ticks,
            "late_ticks": self.pace.late,
            "worst_delay": self.pace.worst,
            "links": [link.report() for link in self.links],
        }
