# SPDX-License-Identifier: BSD-3-Clause
"""What the report of a diagnosis draws and lists, in numbers: the quantities that residuals are
plotted against, binned; the curve of each joint effect; the ranges of the data."""

from __future__ import annotations

import math
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
    """What residuals are plotted against. `kind` is that of a Structure; `key` is unique: "z",
    "joint 3", "temperature"."""

    key: str
    name: str
    unit: str
    values: Floats
    kind: str
    joint: int | None = None  # coordinate of a joint
    covariate: str | None = None
    component: int | None = None  # column of a covariate that has several

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
    """Residuals, (N, 3) in the world, and (N, n) along the direction in which each joint moves the
    tip, where an error of that joint has one sign [m]."""

    world: Floats
    along: Floats

    def against(self, quantity: Quantity) -> Floats:
        """(N, 1) along a joint's own direction; (N, 3) against anything else."""
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
    """Joints, position, then covariates: all that vary over the data."""
    found = [
        Quantity(
            f"joint {k}", joint_label(k, joint.name), joint.unit, joint.values, "joints", k - 1
        )
        for k, joint in enumerate(joint_values(report.fit.arm, report.data), 1)
    ]
    place = positions(report)
    found += [Quantity(axis, axis, "m", place[:, k], "position") for k, axis in enumerate("xyz")]
    found += _covariates(report.data.covariates)
    if "time" not in report.data.covariates:
        rows = np.arange(len(report.data), dtype=float)
        found.append(Quantity("the order of the rows", "row", "", rows, "order"))
    return [one for one in found if np.ptp(one.values) > 0]


def joint_label(number: int, name: str) -> str:
    """ "joint 3 · elbow": its number and the arm's own name."""
    return f"joint {number}" if name in ("", f"joint_{number}") else f"joint {number} · {name}"


def positions(report: Diagnosis) -> Floats:
    """(N, 3) measured tip positions; of touches, those of the identified arm [m]."""
    if isinstance(report.data, Tracked):
        return np.asarray(report.data.position)
    return np.asarray(report.fit.arm.forward(report.data.q)[:, :3, 3])


def _covariates(covariates: dict[str, Any]) -> Iterator[Quantity]:
    for name, values in covariates.items():
        columns = np.asarray(values, float).reshape(len(values), -1)
        count = columns.shape[1]
        for k in range(count):
            part = _PARTS.get(name, "")[k : k + 1] or (str(k + 1) if count > 1 else "")
            label = f"{name} {part}".strip()
            unit = _UNITS.get(name, "")
            if name in ("time", "session"):
                yield Quantity(label, label, unit, columns[:, k], name)
                continue
            component = k if count > 1 else None
            yield Quantity(
                label, label, unit, columns[:, k], "covariate", covariate=name, component=component
            )


def concerns(structure: Any, quantity: Quantity) -> bool:
    """Whether a structure depends on this quantity alone; of the position, on x, y and z."""
    if structure.kind == "joints":
        return list(structure.coordinates) == [quantity.joint]
    if structure.kind == "covariate":
        return quantity.kind == "covariate" and (quantity.covariate, quantity.component) == (
            structure.covariate, structure.component
        )  # fmt: skip
    return bool(structure.kind == quantity.kind)


def pair_of(structure: Any, known: list[Quantity]) -> tuple[Quantity, Quantity] | None:
    """The two quantities of a structure that depends on two joints together; None for others."""
    if structure.kind != "joints" or len(structure.coordinates) != 2:
        return None
    by_joint = {one.joint: one for one in known if one.joint is not None}
    first, second = (by_joint.get(coordinate) for coordinate in structure.coordinates)
    return None if first is None or second is None else (first, second)


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
    (cells, cells); NaN where there is no pose."""
    edges = [np.linspace(q.values.min(), q.values.max(), _CELLS + 1) for q in pair]
    place = [
        np.clip(np.searchsorted(e, q.values, "right") - 1, 0, _CELLS - 1)
        for e, q in zip(edges, pair, strict=True)
    ]
    index = place[1] * _CELLS + place[0]
    rows = np.bincount(index, minlength=_CELLS**2)
    filled = rows > 0
    sums = [np.bincount(index, r, minlength=_CELLS**2)[filled] for r in residuals.T]
    means = np.column_stack(sums) / rows[filled, None]
    direction = np.linalg.svd(means * np.sqrt(rows[filled, None]), full_matrices=False)[2][0]
    direction *= np.sign(direction[np.argmax(np.abs(direction))])
    cells = np.full(_CELLS**2, np.nan)
    cells[filled] = means @ direction
    return edges[0], edges[1], cells.reshape(_CELLS, _CELLS)


# Support ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Support:
    """The range of the data along one quantity: from `low` to `high`, within `least` to `most`
    (None where nothing limits it)."""

    name: str
    unit: str
    low: float
    high: float
    least: float | None
    most: float | None
    gaps: tuple[tuple[float, float], ...] = ()  # in which the corrected arm holds its effects

    @property
    def share(self) -> float | None:
        """Of the whole range, covered by the data."""
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
