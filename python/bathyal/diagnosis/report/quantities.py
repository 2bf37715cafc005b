# SPDX-License-Identifier: BSD-3-Clause
"""What the report of a diagnosis draws and lists, in numbers: what the residuals are laid against,
binned; the curve of each joint effect; where the data lie."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Tracked
from bathyal.arm.joint_values import joint_values

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

Floats = NDArray[np.float64]

_BINS = 20  # along one quantity, of equal counts
_FEWEST_IN_BIN = 8
_CELLS = 14  # of a map, to a side
_MOST_VALUES = 8  # a quantity with no more of them is drawn value by value
_STILL = 1e-6  # [m/rad]; a joint whose axis the tip lies on moves it nowhere
_UNITS = {
    "temperature": "°C", "time": "s", "payload": "kg", "gravity": "m/s²", "session": "",
    "direction": "",
}  # fmt: skip
_PARTS = {"gravity": "xyz"}


@dataclass(frozen=True)
class Quantity:
    """Something that residuals are laid against, as people read it. `key` is what structures call
    it: "joint 3", "temperature", "z"; `joint` is the coordinate of a joint."""

    key: str
    name: str
    unit: str
    values: Floats
    joint: int | None = None

    @property
    def label(self) -> str:
        return f"{self.name} [{self.unit}]" if self.unit else self.name


@dataclass(frozen=True)
class Binned:
    """Means of residuals along a quantity: (B,) places, (B, K) means and their standard errors."""

    place: Floats
    mean: Floats
    error: Floats
    by_value: bool


@dataclass(frozen=True)
class Residuals:
    """What is left, (N, 3) in the world, and (N, n) along the way in which each joint moves the
    tip: an error of a joint points everywhere in the world, and one way along the joint [m]."""

    world: Floats
    along: Floats

    def against(self, quantity: Quantity) -> Floats:
        """(N, 1) along a joint's own way; (N, 3) against anything else."""
        return self.world if quantity.joint is None else self.along[:, [quantity.joint]]


def residuals_of(report: Diagnosis, residuals: Any) -> Residuals:
    """Of a report's residuals (N, 3)."""
    world = np.asarray(residuals, float)
    jacobian = np.asarray(report.fit.arm.jacobian(report.data.q))[:, :3]
    bases = report.fit.bases
    if len(bases) > 1:
        turn = np.array([base[:3, :3] @ bases[0][:3, :3].T for base in bases])
        jacobian = turn[np.asarray(report.data.station)] @ jacobian
    lever = np.linalg.norm(jacobian, axis=1)
    along = np.einsum("nij,ni->nj", jacobian, world) / np.where(lever > _STILL, lever, np.inf)
    return Residuals(world, along)


def quantities(report: Diagnosis) -> list[Quantity]:
    """Joints, position, then what was recorded beside: all that changes over the data."""
    found = [
        Quantity(f"joint {k}", joint_label(k, joint.name), joint.unit, joint.values, k - 1)
        for k, joint in enumerate(joint_values(report.fit.arm, report.data), 1)
    ]
    place = positions(report)
    found += [Quantity(axis, axis, "m", place[:, k]) for k, axis in enumerate("xyz")]
    found += _covariates(report.data.covariates)
    if "time" not in report.data.covariates:
        rows = np.arange(len(report.data), dtype=float)
        found.append(Quantity("the order of the rows", "row", "", rows))
    return [one for one in found if np.ptp(one.values) > 0]


def joint_label(number: int, name: str) -> str:
    """ "joint 3 · elbow": as structures call it, then as the arm does."""
    return f"joint {number}" if name in ("", f"joint_{number}") else f"joint {number} · {name}"


def positions(report: Diagnosis) -> Floats:
    """(N, 3) where the tip was measured; of touches, where the arm that was found has it [m]."""
    if isinstance(report.data, Tracked):
        return np.asarray(report.data.position)
    return np.asarray(report.fit.arm.forward(report.data.q)[:, :3, 3])


def _covariates(covariates: dict[str, Any]) -> Iterator[Quantity]:
    for name, values in covariates.items():
        columns = np.asarray(values, float).reshape(len(values), -1)
        count = columns.shape[1]
        for k in range(count):
            part = _PARTS.get(name, "")[k : k + 1] or (str(k + 1) if count > 1 else "")
            told = f"{name} {part}".strip()
            yield Quantity(told, told, _UNITS.get(name, ""), columns[:, k])


def against_text(structure: Any) -> str:
    """What a structure goes with. One that has the shape of an effect goes with what that effect
    needs: "joint 3" of a wave along it."""
    told = str(structure.against)
    if told not in _EFFECTS_GO_WITH and not told.startswith("joint_"):
        return told
    joint = re.search(r"\bjoint \d+", structure.words)
    return _EFFECTS_GO_WITH.get(told) or (joint[0] if joint else told)


_EFFECTS_GO_WITH = {
    "base_shift": "session", "tool_change": "session", "tool_slip": "time", "drift": "time",
    "clock_shift": "time", "thermal": "temperature", "payload": "the load of gravity",
    "base_compliance": "the load of gravity", "link_compliance": "", "backlash": "",
}  # fmt: skip


def concerns(structure: Any, quantity: Quantity) -> bool:
    """Whether a structure is one against this quantity alone: "joint 3", "time, period 12.1 s",
    "position"."""
    against = against_text(structure).split(",")[0].strip().lower()
    key = quantity.key.lower()
    if key in ("x", "y", "z"):
        return against in (key, f"position {key}", "position")
    return bool(against == key)


def pair_of(structure: Any, known: list[Quantity]) -> tuple[Quantity, Quantity] | None:
    """The two quantities of a structure against a pair, "joints 2 and 3"; None for others."""
    against = against_text(structure).split(",")[0].strip().lower()
    sides = against.split(" and ")
    if len(sides) != 2:
        return None
    if sides[0].startswith("joints "):
        sides = [sides[0].replace("joints", "joint"), f"joint {sides[1].removeprefix('joint ')}"]
    by_key = {one.key.lower(): one for one in known}
    found = [by_key.get(side.removeprefix("position ")) for side in sides]
    return None if found[0] is None or found[1] is None else (found[0], found[1])


def binned(quantity: Quantity, residuals: Floats) -> Binned:
    """Means over bins of equal counts, or over each value where there are few."""
    values = quantity.values
    distinct = np.unique(values)
    by_value = len(distinct) <= _MOST_VALUES
    if by_value:
        index = np.searchsorted(distinct, values)
        count = len(distinct)
    else:
        count = int(np.clip(len(values) // _FEWEST_IN_BIN, 1, _BINS))
        index = np.empty(len(values), np.intp)
        index[np.argsort(values, kind="stable")] = np.arange(len(values)) * count // len(values)
    rows = np.bincount(index, minlength=count)
    place = np.bincount(index, values, minlength=count) / rows
    mean = np.column_stack([np.bincount(index, r, minlength=count) / rows for r in residuals.T])
    square = np.column_stack(
        [np.bincount(index, r, minlength=count) / rows for r in ((residuals - mean[index]) ** 2).T]
    )
    error = np.sqrt(square / np.maximum(rows - 1, 1)[:, None])
    return Binned(place, mean, error, by_value)


def mapped(pair: tuple[Quantity, Quantity], residuals: Floats) -> tuple[Floats, Floats, Floats]:
    """Edges along both, and the mean component along the direction in which cells differ most
    (cells, cells); NaN where no pose lies."""
    edges = [np.linspace(q.values.min(), q.values.max(), _CELLS + 1) for q in pair]
    place = [
        np.clip(np.searchsorted(e, q.values, "right") - 1, 0, _CELLS - 1)
        for e, q in zip(edges, pair, strict=True)
    ]
    index = place[1] * _CELLS + place[0]
    rows = np.bincount(index, minlength=_CELLS**2)
    some = rows > 0
    sums = [np.bincount(index, r, minlength=_CELLS**2)[some] for r in residuals.T]
    means = np.column_stack(sums) / rows[some, None]
    direction = np.linalg.svd(means * np.sqrt(rows[some, None]), full_matrices=False)[2][0]
    direction *= np.sign(direction[np.argmax(np.abs(direction))])
    cells = np.full(_CELLS**2, np.nan)
    cells[some] = means @ direction
    return edges[0], edges[1], cells.reshape(_CELLS, _CELLS)


# Support ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Support:
    """Where the data lie along something that may be asked for: from `low` to `high`, of what can
    be asked, `least` to `most` (None where nothing limits it)."""

    name: str
    unit: str
    low: float
    high: float
    least: float | None
    most: float | None
    gaps: tuple[tuple[float, float], ...] = ()  # in which the corrected arm holds its effects

    @property
    def share(self) -> float | None:
        """Of the whole range that the data cover."""
        if self.least is None or self.most is None or self.most <= self.least:
            return None
        return (self.high - self.low) / (self.most - self.least)


def supports(report: Diagnosis) -> list[Support]:
    """Joints against their limits, then temperature and load as far as they were recorded."""
    arm = report.fit.arm
    found = []
    joints = zip(joint_values(arm, report.data), arm.joint_types, arm.lower, arm.upper, strict=True)
    for number, (joint, kind, lower, upper) in enumerate(joints, 1):
        factor = 1e3 if kind == "prismatic" else math.degrees(1.0)
        least, most = (
            factor * float(end) if math.isfinite(end) else None for end in (lower, upper)
        )
        low, high = float(joint.values.min()), float(joint.values.max())
        name = joint_label(number, joint.name)
        gaps = tuple((factor * a, factor * b) for a, b in report.model.gaps[number - 1].tolist())
        found.append(Support(name, joint.unit, low, high, least, most, gaps))
    for name in ("temperature", "payload"):
        values = report.data.covariates.get(name)
        if values is not None:
            low, high = float(np.min(values)), float(np.max(values))
            found.append(Support(name, _UNITS[name], low, high, None, None))
    return found
