# SPDX-License-Identifier: BSD-3-Clause
"""The simulator's ends of the lines to software on board."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

from bathyal._core import Error
from bathyal.onboard.moments import Moment, RunInProgress

Inputs = dict[str, Any]


class Link(ABC):
    """A line to a program: each tick readings go out, commands come in.

    Attributes
    ----------
    name : str
        The port, as a program opens it.
    timeout : float
        How long a program may take for an answer that is waited for [s].
    """

    name: str
    timeout: float

    @abstractmethod
    def exchange(self, moment: Moment, run: RunInProgress) -> Inputs | None:
        """What the program commands for this tick; None: nothing.

        Raises
        ------
        Error
            For a program that does not answer in time, or answers what is not understood.
        """

    @abstractmethod
    def close(self, status: str) -> None:
        """Says that the run has ended, and closes the port."""

    @abstractmethod
    def report(self) -> dict[str, int | str]:
        """What was carried, lost and not understood."""

    def silent(self, moment: Moment) -> Error:
        """The error of a program that does not answer."""
        return Error(
            f"{self.name}: no answer to tick {moment.number} within {self.timeout:g} s; "
            "the run can be resumed"
        )


def commands_of(values: list[float], run: RunInProgress, what: str) -> Inputs | None:
    """Commands of all thrusters, or of them and of all fins; None for no values.

    Raises
    ------
    ValueError
        For another number of them, or commands out of −1 to 1.
    """
    thrusters, fins = len(run.plan.thrusters), len(run.plan.fins)
    if not values:
        return None
    if len(values) not in (thrusters, thrusters + fins):
        expected = f"{thrusters} commands" + (f", or {thrusters + fins}" if fins else "")
        raise ValueError(f"{what}: expected {expected}, got {len(values)}")
    for value in values[:thrusters]:
        if not -1.0 <= value <= 1.0:
            raise ValueError(f"{what}: expected commands from -1 to 1, got {value!r}")
    inputs: Inputs = {"thrusters": values[:thrusters]}
    if len(values) > thrusters:
        inputs["fins"] = values[thrusters:]
    return inputs
