# SPDX-License-Identifier: BSD-3-Clause
"""What a corrected arm says when it is asked beyond the data that taught it."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import CorrectedArm, Support

Floats = NDArray[np.float64]


class SupportWarning(UserWarning):
    """Effects of a corrected arm were left out where it was asked beyond its support.

    Attributes
    ----------
    counts : dict of str to int
        Effect to the number of rows without it.
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
        untold = [need for need in found.effect.needs if need not in covariates]
        if untold:
            reasons.append(f"{name} in all rows, for want of {' and '.join(untold)}")
        else:
            reasons.append(
                f"{name} in {missing} of {len(mask)} rows, beyond the data that taught it"
            )
    beyond = _beyond(model.support, q, covariates)
    text = f"Left out of the answer: {'; '.join(reasons)}."
    if beyond:
        text += f" Beyond: {'; '.join(beyond)}."
    text += " Rows without any effect are the rigid arm's; in_support() tells which they are."
    warnings.warn(SupportWarning(text, counts, beyond, mask), stacklevel=2)


def _beyond(support: Support, q: Floats, covariates: Mapping[str, Any]) -> list[str]:
    """Each column that leaves its range, in words."""
    columns = [(f"joint {j + 1}", q[:, j], support.joints[:, j]) for j in range(q.shape[1])]
    for name, values in covariates.items():
        if name == "session":
            continue
        ranges = support.gravity if name == "gravity" else support.covariates.get(name)
        if ranges is None:
            continue
        table = np.asarray(values, dtype=float).reshape(-1, ranges.shape[1])
        columns += [(name, table[:, j], ranges[:, j]) for j in range(table.shape[1])]
    words = []
    for name, asked, (low, high) in columns:
        known = asked[np.isfinite(asked)]
        if known.size and (known.min() < low or known.max() > high):
            words.append(
                f"{name}, asked {known.min():.4g} to {known.max():.4g}, taught {low:.4g} to "
                f"{high:.4g}"
            )
    if len(support.sessions) and "session" in covariates:
        strange = np.setdiff1d(np.asarray(covariates["session"], dtype=float), support.sessions)
        words += [f"session {number:g}, never seen" for number in strange if np.isfinite(number)]
    return words
