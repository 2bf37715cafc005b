# SPDX-License-Identifier: BSD-3-Clause
"""How a caller's mistake is reported, in Python as in the engine."""

from __future__ import annotations


def argument_error(name: str, expected: str, got: object) -> ValueError:
    """The error to raise for an argument: its name, what was expected and what came.

    Examples
    --------
    >>> raise argument_error("z", '"up" or "down"', repr("left"))
    Traceback (most recent call last):
        ...
    ValueError: `z`: expected "up" or "down", got 'left'
    """
    return ValueError(f"`{name}`: expected {expected}, got {got}")
