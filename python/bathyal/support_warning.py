# SPDX-License-Identifier: BSD-3-Clause
"""What a corrected arm says when it is asked beyond the data that taught it."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

# What an effect is, in how many rows it was left out, and the covariates that were not told.
LeftOut = tuple[str, int, Sequence[str]]


class SupportWarning(UserWarning):
    """Effects of a corrected arm were left out where it was asked beyond its support.

    Attributes
    ----------
    counts : dict of str to int
        Effect to the number of rows without it.
    in_support : (N, E) array of bool
        Which effects counted in which row, in the order of ``CorrectedArm.effects``.
    """

    def __init__(self, left_out: Sequence[LeftOut], rows: int, mask: NDArray[np.bool_]) -> None:
        super().__init__(_words(left_out, rows))
        self.counts = {effect: count for effect, count, _ in left_out}
        self.in_support = mask


def warn(left_out: Sequence[LeftOut], rows: int, mask: NDArray[np.bool_]) -> None:
    """Warn of one call; what the methods of `CorrectedArm` do."""
    warnings.warn(SupportWarning(left_out, rows, mask), stacklevel=2)


def _words(left_out: Sequence[LeftOut], rows: int) -> str:
    reasons = []
    for effect, count, untold in left_out:
        if untold:
            reasons.append(f"{effect} in all rows, for want of {' and '.join(untold)}")
        else:
            reasons.append(f"{effect} in {count} of {rows} rows, beyond the data that taught it")
    return (
        f"Left out, so that rows without any effect are the rigid arm's: {'; '.join(reasons)}. "
        "in_support() tells which rows, .support the ranges."
    )
