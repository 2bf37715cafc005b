# SPDX-License-Identifier: BSD-3-Clause
"""What a report of an identification shows, in numbers: points, pairs of touches, parameters."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bathyal._core import ArmFit, FitParameter, Touches, Tracked
from bathyal.errors import argument_error
from bathyal.io.files import PathLike
from bathyal.io.tables import write_table
from bathyal.view.text import number

Floats = NDArray[np.float64]
Rows = NDArray[np.intp]

INTERVAL = 2.0  # standard deviations: 95 %
_MOST_TRADES = 4
_OFF_SCALE = 1.5  # of the longest bar: longer intervals run out of the picture


@dataclass(frozen=True)
class Group:
    """Rows that belong together: of one point or one plane; of one station when tracked.

    `before` and `after` are √mean‖e‖² of the nominal arm and of the one found [m].
    """

    name: str
    rows: Rows
    before: float
    after: float


@dataclass(frozen=True)
class Pairs:
    """Every pair of touches of one point: rows, and how far apart their tips are [m]."""

    group: str
    first: Rows
    second: Rows
    before: Floats
    after: Floats


@dataclass(frozen=True)
class Line:
    """A parameter as the table lists it: lengths in mm, angles in degrees; what it changed by and
    its standard deviation in mm and mrad, which move a tip a metre away alike."""

    name: str
    description: str
    is_length: bool
    nominal: float
    value: float
    change: float
    std: float
    status: str
    trades: str

    @property
    def unit(self) -> str:
        return "mm" if self.is_length else "°"

    @property
    def changed(self) -> str:
        """ "+0.231 ± 0.052 mrad": what it changed by and its standard deviation."""
        if self.status in ("gauge", "fixed", "pruned"):
            return "held"
        std = "?" if math.isinf(self.std) else number(self.std)
        return f"{number(self.change, sign='+')} ± {std} {'mm' if self.is_length else 'mrad'}"


@dataclass(frozen=True)
class Distance:
    """A known distance and what became of it [m]."""

    first: str
    second: str
    given: float
    found: float


def bar_limit(table: list[Line]) -> float:
    """Where an axis of changes ends, on either side [mm, mrad]."""
    longest = max([abs(line.change) for line in table], default=0.0)
    ends = [abs(line.change) + INTERVAL * line.std for line in table if math.isfinite(line.std)]
    return max(min(1.05 * max(ends, default=0.0), _OFF_SCALE * longest), 1e-9)


def point_name(data: Touches, label: int) -> str:
    """The name of a touched point, or "point 3" where it has none."""
    return str(data.names.get(label, f"point {label}"))


def groups(fit: ArmFit, data: Touches | Tracked) -> list[Group]:
    """Points in the order of their labels, then planes; stations when tracked.

    Raises
    ------
    ValueError
        For other data than those that the fit was found from, where that shows.
    """
    _need_own(fit, data)
    if isinstance(data, Tracked):
        station = data.station if len(data.station) else np.zeros(len(data), int)
        rows = {f"station {k}": np.flatnonzero(station == k) for k in np.unique(station)}
        if len(rows) == 1:
            rows = {"all poses": rows.popitem()[1]}
    else:
        on_plane = np.zeros(len(data), bool)
        for plane in data.planes.values():
            on_plane[plane] = True
        rows = {
            point_name(data, label): np.flatnonzero((data.point == label) & ~on_plane)
            for label in fit.point_labels
        }
        rows |= {f"plane {name}": np.asarray(plane) for name, plane in data.planes.items()}
    return [
        Group(name, some, _rms(fit.residuals_before[some]), _rms(fit.residuals[some]))
        for name, some in rows.items()
    ]


def pair_distances(fit: ArmFit, data: Touches) -> list[Pairs]:
    """Of each point that was touched more than once: the distances that the paper's criterion sums
    up (Yukhimets, Gubankov 2023, eq 7), before and after."""
    found = []
    on_planes = len(data.planes)
    all_groups = groups(fit, data)
    for group in all_groups[: len(all_groups) - on_planes]:
        if len(group.rows) < 2:
            continue
        first, second = (group.rows[index] for index in np.triu_indices(len(group.rows), 1))
        before, after = (
            np.linalg.norm(residuals[first] - residuals[second], axis=1)
            for residuals in (fit.residuals_before, fit.residuals)
        )
        found.append(Pairs(group.name, first, second, before, after))
    return found


def distances(fit: ArmFit, data: Touches | Tracked) -> list[Distance]:
    """Known distances, given and found; as `groups`."""
    _need_own(fit, data)
    if isinstance(data, Tracked):
        return []
    return [
        Distance(point_name(data, a), point_name(data, b), data.known_distances[a, b], found)
        for (a, b), found in fit.distances.items()
    ]


def lines(fit: ArmFit) -> list[Line]:
    """The table of parameters."""
    return [_line(parameter) for parameter in fit.parameters]


def write_parameters(fit: ArmFit, path: PathLike) -> None:
    """Write the table of parameters as .csv, one a row, in the parameters' own units."""
    titles = ("name", "words", "group", "unit", "nominal", "value", "change", "std", "status",
              "trades")  # fmt: skip
    rows = [
        (p.name, p.words, p.group, p.unit, p.nominal, p.value, p.value - p.nominal, p.std, p.status,
         " ".join(f"{trade.name}:{trade.factor:.6g}" for trade in p.trades))
        for p in fit.parameters
    ]  # fmt: skip
    write_table(path, titles, rows)


def write_residuals(fit: ArmFit, data: Touches | Tracked, path: PathLike) -> None:
    """Write how far each touch, or tracked pose, is from where it should be, as .csv: row of the
    data counted from 0, point or station, distance before and after, and the rest by axis [m]."""
    titles = ("row", "group", "before_m", "after_m", "x_m", "y_m", "z_m")
    name = {int(row): group.name for group in groups(fit, data) for row in group.rows}
    before = np.linalg.norm(fit.residuals_before, axis=1).tolist()
    after = np.linalg.norm(fit.residuals, axis=1).tolist()
    rows = [
        (row, name[row], before[row], after[row], *rest)
        for row, rest in enumerate(fit.residuals.tolist())
    ]
    write_table(path, titles, rows)


def _need_own(fit: ArmFit, data: Touches | Tracked) -> None:
    known = set() if isinstance(data, Tracked) else set(data.known_distances)
    if len(data) != len(fit.residuals) or known != set(fit.distances):
        raise argument_error("data", "what the fit was found from", f"other data ({data!r})")


def _rms(residuals: Floats) -> float:
    return math.sqrt(float(np.mean(np.sum(residuals**2, axis=1))))


def _line(p: FitParameter) -> Line:
    is_length = p.unit == "m"
    shown = 1e3 if is_length else math.degrees(1.0)
    return Line(
        name=p.name,
        description=p.words,
        is_length=is_length,
        nominal=shown * p.nominal,
        value=shown * p.value,
        change=1e3 * (p.value - p.nominal),
        std=1e3 * p.std,
        status=p.status,
        trades=_trades(p),
    )


def _trades(p: FitParameter) -> str:
    """ "a_3 +0.93, tool_z −0.43": what moves with it in the null space, per unit of its own."""
    partners = [f"{trade.name} {trade.factor:+.2g}".replace("-", "−") for trade in p.trades]
    rest = len(partners) - _MOST_TRADES
    return ", ".join(partners[:_MOST_TRADES]) + (f" and {rest} more" if rest > 0 else "")
