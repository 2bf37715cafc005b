# SPDX-License-Identifier: BSD-3-Clause
"""What software on board is given: readings, tick by tick."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from bathyal._core import MissionPlan

Array = NDArray[np.float64]


class Reading(NamedTuple):
    """What a sensor has reported.

    Attributes
    ----------
    device, kind : str
        The sensor's name and kind: see `bathyal.Sensor` for its values.
    time : float
        At which the values were so [s].
    arrival : float
        At which they were known on board [s].
    number : int
        Of the sample.
    valid : bool
        False: the sensor says itself that it measured nothing.
    values : tuple of float
    """

    device: str
    kind: str
    time: float
    arrival: float
    number: int
    valid: bool
    values: tuple[float, ...]


@dataclass(frozen=True)
class Moment:
    """A tick, as software on board sees it.

    Attributes
    ----------
    number : int
    time : float
        [s]
    readings : list of Reading
        What has arrived since the tick before, in its order.
    """

    number: int
    time: float
    readings: list[Reading]

    def latest(self, kind: str) -> Reading | None:
        """The last reading of a kind, if there is one."""
        for reading in reversed(self.readings):
            if reading.kind == kind:
                return reading
        return None


class RunInProgress(Protocol):
    """What is needed of a run: `bathyal.Run` is one."""

    @property
    def plan(self) -> MissionPlan: ...
    @property
    def number(self) -> int: ...
    @property
    def time(self) -> float: ...
    @property
    def status(self) -> str: ...
    @property
    def arrived(self) -> list[Reading]: ...
    @property
    def pose(self) -> Array: ...
    @property
    def velocity(self) -> Array: ...
    def step(self, inputs: dict[str, object] | None = None, *, count: int = 1) -> bool:
        """Some ticks."""


def moment_of(run: RunInProgress) -> Moment:
    """The tick that comes next."""
    return Moment(run.number, run.time, run.arrived)
