# SPDX-License-Identifier: BSD-3-Clause
"""What rides along with points has one name here, whatever a file calls it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

COLOURS = ("red", "green", "blue")
BYTE_ATTRIBUTES = (*COLOURS, "alpha", "classification")

_LETTERS = {"r": "red", "g": "green", "b": "blue", "a": "alpha"}  # where r, g and b are there
_ALIASES = {
    "diffuse_red": "red", "diffuse_green": "green", "diffuse_blue": "blue",
    "diffuse_alpha": "alpha",
    "scalar_intensity": "intensity", "reflectance": "intensity", "backscatter": "intensity",
    "class": "classification", "scalar_classification": "classification",
    "tpu": "uncertainty", "tvu": "uncertainty", "sigma_z": "uncertainty",
    "scalar_uncertainty": "uncertainty",
}  # fmt: skip
_KNOWN = {"uncertainty", "intensity", "classification", *COLOURS, "alpha"}


def _canonical_name(name: str, aliases: Mapping[str, str]) -> str:
    """Lower case for the names known here ("Intensity", "TVU"); others stay as they are."""
    lower = name.strip().lower()
    return aliases.get(lower, lower if lower in _KNOWN else name.strip())


def canonical_attributes(columns: Mapping[str, NDArray[Any]]) -> dict[str, NDArray[np.float64]]:
    """Columns under their canonical names, in float64, colours from 0 to 255.

    A name that is taken already keeps the file's own spelling. Colours in 16 bits and in float32
    (0 to 1 by custom) are scaled; in other types they are taken to run from 0 to 255.
    """
    lower = {name.strip().lower() for name in columns}
    aliases = {**_ALIASES, **_LETTERS} if {"r", "g", "b"} <= lower else _ALIASES
    result: dict[str, NDArray[np.float64]] = {}
    for name, values in columns.items():
        canonical = _canonical_name(name, aliases)
        key = name if canonical in result else canonical
        double = np.ascontiguousarray(values, np.float64)
        if key in (*COLOURS, "alpha"):
            double = double * _colour_scale(values)
        result[key] = double
    return result


def _colour_scale(values: NDArray[Any]) -> float:
    if values.dtype.kind == "u" and values.dtype.itemsize == 2:
        return 1 / 257  # 65535 becomes 255
    if values.dtype.kind == "f" and values.dtype.itemsize == 4:
        return 255.0
    return 1.0


def columns_of(data: Mapping[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Arrays of several columns taken apart; texts, which are no attributes, are left out.

    Three or four bytes a point are a colour; other columns are numbered: ``normal_0``…
    """
    columns: dict[str, NDArray[Any]] = {}
    for name, values in data.items():
        if values.dtype.kind == "U":
            continue
        if values.ndim == 1:
            columns[name] = values
        elif values.dtype == np.uint8 and values.shape[1] in (3, 4):
            columns.update(zip((*COLOURS, "alpha"), values.T, strict=False))
        else:
            columns.update({f"{name}_{i}": column for i, column in enumerate(values.T)})
    return columns
