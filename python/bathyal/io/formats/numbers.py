# SPDX-License-Identifier: BSD-3-Clause
"""Numbers from text, all of them or an error, and text from numbers without a loss."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error

_ROWS_AT_A_TIME = 50_000


def numbers_of_text(text: bytes | str) -> NDArray[np.float64]:
    """All numbers of a text that holds nothing but numbers and white space.

    Raises
    ------
    Error
        For anything else, with the place.
    """
    if not text.strip():
        return np.empty(0)
    with warnings.catch_warnings():
        # numpy only warns where it stops in the middle of a text
        warnings.simplefilter("error", DeprecationWarning)
        try:
            return np.fromstring(text, np.float64, sep=" ")
        except (DeprecationWarning, ValueError) as error:
            raise Error(f"not a number: {_first_word_that_is_none(text)!r}") from error


def _first_word_that_is_none(text: bytes | str) -> str:
    words = text.decode("latin-1").split() if isinstance(text, bytes) else text.split()
    for word in words:
        try:
            float(word)
        except ValueError:
            return word[:40]
    return ""


def lines_of_rows(table: NDArray[Any], *, prefix: str = "", separator: str = " ") -> Iterator[str]:
    """Whole lines in chunks, each number as the shortest text that reads back equal."""
    for start in range(0, len(table), _ROWS_AT_A_TIME):
        rows = table[start : start + _ROWS_AT_A_TIME].tolist()
        yield "".join([prefix + separator.join(map(repr, row)) + "\n" for row in rows])
