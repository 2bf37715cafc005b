# SPDX-License-Identifier: BSD-3-Clause
"""A scenario's targets and start, looked at before anything moves: what `bathyal check` does."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Clearances, TargetChecks
from bathyal.io.files import PathLike
from bathyal.io.tables import write_table
from bathyal.view.brief import MOST_NUMBERS, Brief
from bathyal.workspace.scenario import Scenario

Floats = NDArray[np.float64]

STATUSES = {
    "hull": "inside the hull",
    "keepout": "in a keep-out",
    "ground": "in the ground",
    "unreachable": "out of reach",
    "collision": "reached only in collision",
    "limit": "reached only at a joint's limit",
    "free": "free",
}
"""What a target's status says, for people."""

ALLOWED = ("free", "limit")


@dataclass(frozen=True)
class Checked:
    """Each target's status and how near the start comes to anything.

    Attributes
    ----------
    scenario : Scenario
    targets : TargetChecks
    start : Clearances
        Of `scenario.q_start`.
    within : bool
        Whether the start is within the joints' limits.
    """

    scenario: Scenario
    targets: TargetChecks
    start: Clearances
    within: bool

    @property
    def start_free(self) -> bool:
        """Whether the arm may begin there: within limits, and nothing is touched."""
        near = min(float(self.start.distance), float(self.start.self_distance))
        return self.within and near >= 0

    @property
    def free(self) -> bool:
        """Whether the start is free and each target may be approached."""
        return self.start_free and all(one in ALLOWED for one in self.targets.status)

    @property
    def summary(self) -> dict[str, Any]:
        """Numbers for programs, SI units in the names."""
        keepouts = [keepout.name for keepout in self.scenario.keepouts]
        checks = self.targets
        return {
            "scenario": self.scenario.name,
            "free": self.free,
            "start": {
                "free": self.start_free,
                "within_limits": self.within,
                "clearance_m": float(self.start.distance),
                "self_clearance_m": float(self.start.self_distance),
                "link": str(self.start.link),
                "against": str(self.start.against),
            },
            "targets": [
                {
                    "name": name,
                    "point_m": point,
                    "status": str(status),
                    "keepout": keepouts[keepout] if keepout >= 0 else None,
                    "distance_m": float(distance),
                    "q": None if np.isnan(q).any() else q,
                }
                for name, point, status, keepout, distance, q in zip(
                    self.scenario.target_names, self.scenario.targets, checks.status,
                    checks.keepout, checks.distance, checks.q, strict=True,
                )
            ],
            "warnings": self.scenario.warnings,
        }  # fmt: skip

    @property
    def brief(self) -> Brief:
        """The check at first sight."""
        rows = self.summary["targets"]
        numbers = {row["name"]: target_text(row) for row in rows}
        if len(numbers) > MOST_NUMBERS - 1:
            counts = Counter(row["status"] for row in rows)
            ordered = [name for name in STATUSES if name in counts]
            numbers = {STATUSES[name]: f"{counts[name]} targets" for name in ordered}
            numbers = dict(list(numbers.items())[: MOST_NUMBERS - 1])
        return Brief(self._verdict(), {"start": self._start_text(), **numbers}, self._next())

    def _verdict(self) -> str:
        count = len(self.targets)
        refused = sum(status not in ALLOWED for status in self.targets.status)
        if not self.start_free:
            return "Refused: the arm may not begin where it is."
        if refused:
            what = (
                "target is" if count == 1 else f"{count} targets {'is' if refused == 1 else 'are'}"
            )
            return f"Refused: {refused} of {what} not free."
        if not count:
            return "Free: the start; the scenario has no targets."
        return "Free: the target." if count == 1 else f"Free: all {count} targets."

    def _start_text(self) -> str:
        if not self.within:
            return "outside the joints' limits"
        distance, own = float(self.start.distance), float(self.start.self_distance)
        if own < min(distance, 0.0):
            return "the arm touches itself"
        if math.isinf(distance):
            return "clear, there is nothing to touch"
        pair = f"{self.start.link} to {self.start.against}"
        if distance < 0:
            return f"in contact, {pair} overlap by {-distance:.3f} m"
        return f"clear by {distance:.3f} m, {pair}"

    def _next(self) -> str:
        if not self.start_free:
            return "Choose another q_start: in arm, q_start_deg."
        found = [str(status) for status in self.targets.status if status not in ALLOWED]
        if "unreachable" in found or "collision" in found:
            return "See where the arm reaches: bathyal reach."
        if found:
            return "Move the target, or see where the arm reaches: bathyal reach."
        return "Plan the sample: bathyal sample."

    def write_table(self, path: PathLike) -> None:
        """Write the targets as .csv, one a row, units in the header.

        Raises
        ------
        OSError
            Where the file cannot be written.
        """
        titles = ["target", "x_m", "y_m", "z_m", "status", "keepout", "distance_m"]
        write_table(
            path,
            titles,
            (
                [row["name"], *np.asarray(row["point_m"]).tolist(), row["status"],
                 row["keepout"] or "", row["distance_m"]]
                for row in self.summary["targets"]
            ),
        )  # fmt: skip


def target_text(row: dict[str, Any]) -> str:
    """A target's row of `Checked.summary` in a line."""
    distance = float(row["distance_m"])
    text = f"in keep-out {row['keepout']}" if row["keepout"] else STATUSES[row["status"]]
    if math.isinf(distance):
        return text
    if distance < 0 and row["status"] in ("hull", "keepout", "ground"):
        return f"{text}, {-distance:.3f} m deep"
    # A point on the bottom is at most rounding off it.
    where = "on a surface" if abs(distance) < 5e-4 else f"{distance:.3f} m from the nearest surface"
    return f"{text}, {where}"


def check_scenario(scenario: Scenario) -> Checked:
    """Look at the targets and the start of a scenario.

    Parameters
    ----------
    scenario : Scenario

    Returns
    -------
    Checked
    """
    workspace, q = scenario.workspace, scenario.q_start
    lower, upper = np.asarray(scenario.arm.lower), np.asarray(scenario.arm.upper)
    return Checked(
        scenario,
        workspace.check_target(scenario.targets),
        workspace.clearance(q),
        bool(np.all((q >= lower) & (q <= upper))),
    )
