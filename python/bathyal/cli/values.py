# SPDX-License-Identifier: BSD-3-Clause
"""What is written on the command line, and what it becomes inside.

No default is written here: an option that is not given is not handed on, and the engine's own
default holds. The help reads that default from the engine's signature.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal.io.poses import pose_of
from bathyal.io.tables import ANGLES, LENGTHS

_LARGEST_SEED = 2**64 - 1
_LARGEST_COUNT = 2**31 - 1


def engine_default(function: Callable[..., Any], name: str, *, degrees: bool = False) -> str:
    """The default of a keyword as the engine's signature says it, for a line of help."""
    signature = (function.__doc__ or "").split("\n", 1)[0]
    match = re.search(rf"\b{name}: [^=]*? = ([^,)]+)", signature)
    if match is None:
        raise LookupError(f"{function.__name__} has no keyword {name} with a default")
    text = match[1].strip("'\"")
    return f"{math.degrees(float(text)):.4g}" if degrees else text


def default_note(function: Callable[..., Any], name: str, *, degrees: bool = False) -> str:
    """The default as a line of help ends with it."""
    return f"[dim]\\[default: {engine_default(function, name, degrees=degrees)}][/]"


def given(**options: Any) -> dict[str, Any]:
    """Keywords to hand on: the options that were given, a choice by its value."""
    return {
        name: value.value if isinstance(value, Enum) else value
        for name, value in options.items()
        if value is not None
    }


def radians(degrees: float | None) -> float | None:
    """Degrees of the command line as the engine's radians; None stays None."""
    return None if degrees is None else math.radians(degrees)


def pose_matrix(values: tuple[float, ...] | None) -> NDArray[np.float64] | None:
    """x y z [m] and roll, pitch, yaw [deg] as world_from_vehicle (4, 4).

    The vehicle turns by yaw about z, then pitch about y (port), then roll about x: a positive pitch
    is nose down.
    """
    if values is None:
        return None
    return pose_of(values[:3], np.radians(values[3:]))


def column_list(text: str | None) -> list[int | str] | None:
    """ "0,1,2" or "easting,northing,depth": columns by number or by name."""
    if text is None:
        return None
    names = [part.strip() for part in text.split(",")]
    return [int(name) if name.isdigit() else name for name in names]


def length_or_none(text: str) -> float:
    """A length [m], or infinity for "none"."""
    if text.strip().lower() == "none":
        return math.inf
    try:
        return float(text)
    except ValueError:
        raise ValueError(f'expected a length in metres or "none", got {text!r}') from None


def seed_number(text: str) -> int:
    """A seed, as the engine's 64 bits hold it."""
    return _whole(text, 0, _LARGEST_SEED)


def count_number(text: str) -> int:
    """How many of something, one or more."""
    return _whole(text, 1, _LARGEST_COUNT)


def _whole(text: str, low: int, high: int) -> int:
    if re.fullmatch(r"\s*[+-]?[0-9]{1,20}\s*", text) and low <= int(text) <= high:
        return int(text)
    raise ValueError(f"expected a whole number from {low} to {high}, got {text!r}")


def quantity(text: str) -> tuple[float, str]:
    """A number with its unit, "50mm", "0,2 deg": in SI units, and "length" or "angle"."""
    match = re.fullmatch(r"\s*([+-]?\d*[.,]?\d+(?:[eE][+-]?\d+)?)\s*(\D*?)\s*", text)
    for kind, units in (("length", LENGTHS), ("angle", ANGLES)):
        if match is not None and match[2].lower() in units:
            return float(match[1].replace(",", ".")) * units[match[2].lower()], kind
    raise ValueError(f"expected a number with its unit, such as 50mm or 0.1deg, got {text!r}")


def length(text: str) -> float:
    """A length with its unit, "50mm" [m]."""
    value, kind = quantity(text)
    if kind != "length":
        raise ValueError(f"expected a length with its unit, such as 50mm, got {text!r}")
    return value


def angle(text: str) -> float:
    """An angle with its unit, "0.1deg" [rad]."""
    value, kind = quantity(text)
    if kind != "angle":
        raise ValueError(f"expected an angle with its unit, such as 0.1deg, got {text!r}")
    return value


def coordinates(text: str) -> tuple[float, float, float]:
    """Three lengths with one unit behind the last, "500,200,100mm" [m]."""
    *first, last = text.split(",")
    unit = last.strip().lstrip("+-0123456789.eE ")
    if len(first) != 2:
        raise ValueError(f"expected three coordinates, such as 500,200,100mm, got {text!r}")
    return length(f"{first[0]}{unit}"), length(f"{first[1]}{unit}"), length(last)


def named(text: str) -> tuple[str, str]:
    """The two sides of "left,right=50mm"."""
    name, sign, value = text.rpartition("=")
    if not sign or not name.strip() or not value.strip():
        raise ValueError(f'expected a name, "=" and a value, got {text!r}')
    return name.strip(), value.strip()
