# SPDX-License-Identifier: BSD-3-Clause
"""What is said of a formula that is used outside the range its authors give."""

from __future__ import annotations

import warnings

from bathyal._core import warn_of_range_with


class RangeWarning(UserWarning):
    """A formula of the water was used outside the range of its authors; its text names what."""


def warn(text: str) -> None:
    """Warn of one call; what `sound_speed`, `absorption` and `Water` do."""
    warnings.warn(RangeWarning(text), stacklevel=2)


warn_of_range_with(warn)
