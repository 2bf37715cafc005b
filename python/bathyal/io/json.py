# SPDX-License-Identifier: BSD-3-Clause
"""JSON as results are written: laid out to be read, without NaN and infinities."""

from __future__ import annotations

import codecs
import json
import math
import os
from collections.abc import Mapping
from typing import Any

import numpy as np


def json_text(value: Any, encoding: str = "utf-8") -> str:
    """JSON in which an object is written on lines of its own and a list on one; NaN and
    infinities are null. What `encoding` cannot hold is escaped, as are the bytes of a file's name
    that are not UTF-8: Python reads them back as they were."""
    text = _lines(_plain(value), "") + "\n"
    return text.encode(encoding, "bathyal_json").decode(encoding)


def _escaped(error: UnicodeError) -> tuple[str, int]:
    """Signs as JSON escapes them, those beyond 16 bits in two halves."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    signs = error.object[error.start : error.end]
    return "".join(json.dumps(sign)[1:-1] for sign in signs), error.end


codecs.register_error("bathyal_json", _escaped)


def _plain(value: Any) -> Any:
    """What JSON can hold: no numpy, no NaN."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value


def _lines(value: Any, indent: str) -> str:
    if not isinstance(value, dict) or not value:
        return json.dumps(value, allow_nan=False, ensure_ascii=False)
    inner = indent + "  "
    items = ",\n".join(
        f"{inner}{json.dumps(key, ensure_ascii=False)}: {_lines(item, inner)}"
        for key, item in value.items()
    )
    return f"{{\n{items}\n{indent}}}"
