# SPDX-License-Identifier: BSD-3-Clause
"""What a corrected arm says when it is asked beyond the data that taught it."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import CorrectedArm, warn_of_support_with

Floats = NDArray[np.float64]


class SupportWarning(UserWarning):
    """A corrected arm was asked beyond its support: effects were held or left out.

    Attributes
    ----------
    counts : dict of str to int
        Effect to the number of rows in which it does not count.
    beyond : list of str
        What of the rows lies beyond, and what was taught.
    in_support : (N, E) array of bool
        Which effects counted in which row, in the order of ``CorrectedArm.effects``.
    """

    def __init__(self, text: str, counts: dict[str, int], beyond: list[str], mask: Any) -> None:
        super().__init__(text)
        self.counts = counts
        self.beyond = beyond
        self.in_support: NDArray[np.bool_] = mask


def warn(
    model: CorrectedArm, q: Floats, covariates: Mapping[str, Any], mask: NDArray[np.bool_]
) -> None:
    """Warn of one call; what the methods of `CorrectedArm` do."""
    counts: dict[str, int] = {}
    reasons = []
    for found, missing in zip(model.effects, np.count_nonzero(~mask, axis=0), strict=True):
        if missing == 0:
            continue
        name = found.name if found.joint is None else f"{found.name} of joint {found.joint + 1}"
        counts[name] = counts.get(name, 0) + int(missing)
        absent = [need for need in found.effect.needs if need not in covariates]
        if absent:
            reasons.append(f"{name} left out of all rows, for want of {' and '.join(absent)}")
        else:
            reasons.append(f"{name} in {missing} of {len(mask)} rows")
    beyond = _beyond(model, q, covariates)
    text = f"Asked beyond the data that taught it: {'; '.join(reasons)}."
    if beyond:
        text += f" Beyond: {'; '.join(beyond)}."
    text += (
        " There a wave or curve along a joint is held at its average, what is smooth as in the "
        "nearest row that taught it, and what needs a number that is not known is left out; "
        "in_support() gives the rows."
    )
    warnings.warn(SupportWarning(text, counts, beyond, mask), stacklevel=2)


def _beyond(model: CorrectedArm, q: Floats, covariates: Mapping[str, Any]) -> list[str]:
    """Each column that leaves its range, and gaps in which effects are held, as text."""
    support = model.support
    columns = [(f"joint {j + 1}", q[:, j], support.joints[:, j]) for j in range(q.shape[1])]
    for name, values in covariates.items():
        if name == "session":
            continue
        ranges = support.gravity if name == "gravity" else support.covariates.get(name)
        if ranges is None:
            continue
        table = np.asarray(values, dtype=float).reshape(-1, ranges.shape[1])
        columns += [(name, table[:, j], ranges[:, j]) for j in range(table.shape[1])]
    lines = []
    for name, asked, (low, high) in columns:
        known = asked[np.isfinite(asked)]
        if known.size and (known.min() < low or known.max() > high):
            lines.append(
                f"{name}, asked {known.min():.4g} to {known.max():.4g}, taught {low:.4g} to "
                f"{high:.4g}"
            )
    for j, gaps in enumerate(model.gaps):
        rows = np.count_nonzero((q[:, j] > gaps[:, :1]) & (q[:, j] < gaps[:, 1:]), axis=1)
        lines += [
            f"joint {j + 1} in a gap from {low:.4g} to {high:.4g} in {n} of {len(q)} rows"
            for (low, high), n in zip(gaps, rows, strict=True)
            if n
        ]
    if len(support.sessions) and "session" in covariates:
        strange = np.setdiff1d(np.asarray(covariates["session"], dtype=float), support.sessions)
        lines += [f"session {number:g}, never seen" for number in strange if np.isfinite(number)]
    return lines


warn_of_support_with(warn)
