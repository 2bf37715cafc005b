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


def refuse_truth_values(value: Any, where: str = "") -> None:
    """Raise `Error` for true and false anywhere in what JSON gave: Python counts them as 1 and 0.

    No file of numbers that is read here has a key for one.
    """
    waiting: list[tuple[Any, str]] = [(value, where)]  # not a recursion: JSON may nest deeply
    while waiting:
        item, name = waiting.pop()
        if isinstance(item, bool):
            raise Error(f"`{name}`: expected a number or a text, got {str(item).lower()}")
        if isinstance(item, dict):
            waiting += [(part, f"{name}.{key}" if name else key) for key, part in item.items()]
        elif isinstance(item, list):
            nested = (list, dict, bool)
            waiting += [
                (part, f"{name}[{i}]") for i, part in enumerate(item) if isinstance(part, nested)
            ]


def lines_of_rows(table: NDArray[Any], *, prefix: str = "", separator: str = " ") -> Iterator[str]:
    """Whole lines in chunks, each number as the shortest text that reads back equal."""
    for start in range(0, len(table), _ROWS_AT_A_TIME):
        rows = table[start : start + _ROWS_AT_A_TIME].tolist()
        yield "".join([prefix + separator.join(map(repr, row)) + "\n" for row in rows])
