# SPDX-License-Identifier: BSD-3-Clause
"""What a file says once of all its points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

_NAMES = ("crs", "vertical_datum")


def notes_of(data: Any) -> dict[str, str]:
    """Coordinate reference system and vertical datum of a cloud or mesh, where known."""
    notes = {name: str(getattr(data, name)) for name in _NAMES}
    return {name: text for name, text in notes.items() if text}


def notes_of_fields(fields: Mapping[str, Any]) -> dict[str, str]:
    """The same from named texts, or arrays of one text."""
    notes = dict.fromkeys(_NAMES, "")
    for name in _NAMES:
        values = fields.get(name, "")
        if isinstance(values, str):
            notes[name] = values
        elif values.dtype.kind == "U" and len(values) == 1:
            notes[name] = str(values[0])
    return notes
