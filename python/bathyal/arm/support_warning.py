# SPDX-License-Identifier: BSD-3-Clause
"""What a corrected arm says when it is asked beyond the data that taught it."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import CorrectedArm, warn_of_support_with

Floats = NDArray[np.float64]


_USES = ("within", "extrapolated", "held", "omitted")  # EffectUse of the engine, by its numbers
_LENGTH = 500  # of a warning, in characters
_SAMPLE = 64  # rows by which it is found out whether effects depend on a joint


class SupportWarning(UserWarning):
    """A corrected arm was asked beyond its support: effects were extrapolated, held or omitted.

    Its text has one line for each joint or covariate that lies beyond, and at most 500 characters.

    Attributes
    ----------
    counts : dict of str to int
        Effect to the number of rows in which it lies beyond.
    beyond : list of str
        A line for each joint or covariate that lies beyond, or is missing.
    in_support : (N,) array of bool
        Which rows lie within, as `CorrectedArm.in_support`.
    effects_in_support : (N, E) array of bool
        Which effects lie within in which row, in the order of ``CorrectedArm.effects``.
    """

    def __init__(
        self, text: str, counts: dict[str, int], beyond: list[str], mask: NDArray[np.bool_]
    ) -> None:
        super().__init__(text)
        self.counts = counts
        self.beyond = beyond
        self.in_support: NDArray[np.bool_] = np.asarray(mask.all(axis=1))
        self.effects_in_support = mask


def warn(
    model: CorrectedArm, q: Floats, covariates: Mapping[str, Any], uses: NDArray[np.int8]
) -> None:
    """Warn of one call; what the methods of `CorrectedArm` do."""
    mask = uses == _USES.index("within")
    counts: dict[str, int] = {}
    for found, rows in zip(model.effects, np.count_nonzero(~mask, axis=0), strict=True):
        if rows:
            name = found.name if found.joint is None else f"{found.name} of joint {found.joint + 1}"
            counts[name] = counts.get(name, 0) + int(rows)
    outside = ~mask.all(axis=1)
    beyond = _missing(model, covariates) + _beyond(model, q, covariates, outside)
    text = _text(_heading(uses, outside), beyond)
    warnings.warn(SupportWarning(text, counts, beyond, mask), stacklevel=2)


def _heading(uses: NDArray[np.int8], outside: NDArray[np.bool_]) -> str:
    effects = [
        f"{number} {_USES[use]}"
        for use in range(1, len(_USES))
        if (number := np.count_nonzero((uses == use).any(axis=0)))
    ]
    return (
        f"{np.count_nonzero(outside)} of {len(uses)} rows lie beyond the data of this model; "
        f"effects: {', '.join(effects)} (support_reasons() tells each row's)."
    )


def _text(heading: str, lines: list[str]) -> str:
    """All lines, or as many as fit and the number of the others."""
    for shown in range(len(lines), -1, -1):
        rest = [f"and {len(lines) - shown} more"] if shown < len(lines) else []
        text = "\n".join([heading, *lines[:shown], *rest])
        if len(text) <= _LENGTH:
            break
    return text


def _missing(model: CorrectedArm, covariates: Mapping[str, Any]) -> list[str]:
    """What effects need and the call did not give."""
    needed = dict.fromkeys(need for found in model.effects for need in found.effect.needs)
    return [f"{name}: not given" for name in needed if name not in covariates]


def _beyond(
    model: CorrectedArm, q: Floats, covariates: Mapping[str, Any], outside: NDArray[np.bool_]
) -> list[str]:
    """A line for each joint and covariate that leaves its range in the rows `outside`, or lies in a
    gap in which effects are held."""
    support = model.support
    lines = []
    for j, (values, gaps) in enumerate(zip(q[outside].T, model.gaps, strict=True)):
        asked = _range_text(values, *support.joints[:, j])
        if asked and not _matters(model, q, covariates, j):
            asked = []
        in_gap = (values > gaps[:, :1]) & (values < gaps[:, 1:])
        if in_gap.any():
            low, high = max(gaps[in_gap.any(axis=1)], key=np.ptp)
            asked.append(f"gaps up to {low:.4g} to {high:.4g}, {in_gap.any(axis=0).sum()} rows")
        lines += _line(f"joint {j + 1}", asked)
    for name, given in covariates.items():
        table = np.asarray(given, dtype=float)
        table = table.reshape(1 if table.ndim == 0 else len(table), -1)
        values = np.broadcast_to(table, (len(outside), table.shape[1]))[outside]
        if name == "session":
            lines += _line(name, _strange_text(values, support.sessions) + _unknown_text(values))
            continue
        ranges = support.gravity if name == "gravity" else support.covariates.get(name)
        if ranges is None:
            continue
        parts = [_range_text(column, *ranges[:, k]) for k, column in enumerate(values.T)]
        lines += _line(name, [*chain(*parts), *_unknown_text(values)])
    return lines


def _matters(model: CorrectedArm, q: Floats, covariates: Mapping[str, Any], joint: int) -> bool:
    """Whether any effect depends on a joint beyond its range: by some of the rows where it is."""
    low, high = model.support.joints
    rows = np.flatnonzero((q[:, joint] < low[joint]) | (q[:, joint] > high[joint]))[:_SAMPLE]
    known = {name: v[rows] if len(v) == len(q) else v for name, v in covariates.items()}
    inside = np.clip(q[rows], low, high)
    alone = inside.copy()
    alone[:, joint] = q[rows, joint]
    one, other = (model.effects_in_support(at, covariates=known) for at in (inside, alone))
    return not np.array_equal(one, other)


def _line(name: str, parts: list[str]) -> list[str]:
    return [f"{name}: {'; '.join(parts)}"] if parts else []


def _range_text(asked: Floats, low: float, high: float) -> list[str]:
    """What was asked, where any of it lies beyond the range of the data."""
    slack = 1e-9 * (1.0 + high - low)
    rows = np.count_nonzero((asked < low - slack) | (asked > high + slack))
    if not rows:
        return []
    least, most = np.nanmin(asked), np.nanmax(asked)
    return [f"{least:.4g} to {most:.4g}, data {low:.4g} to {high:.4g}, {rows} rows"]


def _unknown_text(values: Floats) -> list[str]:
    rows = np.count_nonzero(np.isnan(values).any(axis=1))
    return [f"unknown, {rows} rows"] if rows else []


def _strange_text(asked: Floats, known: Floats) -> list[str]:
    """Sessions that the data do not have; where they have none, nothing depends on it."""
    strange = np.setdiff1d(asked[np.isfinite(asked)], known)
    if not len(known) or not len(strange):
        return []
    return [f"{', '.join(f'{number:g}' for number in strange)} not in the data"]


warn_of_support_with(warn)
