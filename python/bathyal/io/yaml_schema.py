# SPDX-License-Identifier: BSD-3-Clause
"""A YAML document against a schema: each mistake by its file, line and column."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeVar

from bathyal._core import Error
from bathyal.io.yaml_documents import Document

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError

Model = TypeVar("Model", bound="BaseModel")

_MOST_SHOWN = 8
_SHOULD = "Input should be "


def validated(model: type[Model], document: Document) -> Model:
    """The document as a model of pydantic.

    Raises
    ------
    Error
        A line for each mistake: ``file:line:column: section.key: expected …, got …``.
    """
    from pydantic import ValidationError

    try:
        return model.model_validate(document.value)
    except ValidationError as error:
        raise Error("\n".join(_lines(error, document))) from None


def at(document: Document, place: Sequence[str | int], error: Exception) -> Error:
    """What went wrong with a value, as an error that names its file, line and column."""
    reason = str(error)
    if isinstance(error, OSError) and error.strerror:
        reason = f"{error.strerror}: {error.filename}" if error.filename else error.strerror
    return Error(f"{document.where(place)}: {name_of(place)}: {reason}")


def name_of(place: Sequence[str | int]) -> str:
    """A place as people write it: ``keepouts[0].radius``, rows counted from 0."""
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in place)
    return text.lstrip(".") or "the document"


def _lines(error: ValidationError, document: Document) -> list[str]:
    found: dict[tuple[str | int, ...], str] = {}
    for one in error.errors(include_url=False):
        place = _place(one["loc"], document, missing=one["type"] == "missing")
        line = f"{document.where(place)}: {name_of(place)}: {_reason(one)}"
        # Of a value that may be one of two kinds there is an error for each: the first says it,
        # unless it is a number that is not finite.
        if one["type"] == "finite_number":
            found[place] = line
        found.setdefault(place, line)
    marks = {place: document.marks.get(place) or document.marks.get(place[:-1]) for place in found}
    order = sorted(found, key=lambda p: (m.line, m.column) if (m := marks[p]) else (0, 0))
    lines = [found[place] for place in order]
    more = len(lines) - _MOST_SHOWN
    return lines[:_MOST_SHOWN] + ([f"and {more} more"] if more > 0 else [])


def _place(
    parts: Sequence[str | int], document: Document, *, missing: bool
) -> tuple[str | int, ...]:
    """Where in the document; what pydantic adds to it, such as the shape of a keep-out, goes. The
    last part of a key that is missing is in no document."""
    place: tuple[str | int, ...] = ()
    for number, part in enumerate(parts):
        if (*place, part) in document.marks or (missing and number == len(parts) - 1):
            place = (*place, part)
    return place


def _reason(error: Any) -> str:
    kind, message, got = error["type"], str(error["msg"]), error["input"]
    if kind == "missing":
        return "it is missing"
    if kind == "extra_forbidden":
        return f"this key is not known: {str(error['loc'][-1])!r:.80}"
    if kind == "value_error":
        return message.removeprefix("Value error, ")
    if kind == "union_tag_not_found":
        key = str(error["ctx"]["discriminator"]).strip("'")
        return f"its key {key!r} is missing"
    if kind == "union_tag_invalid":
        expected = error["ctx"]["expected_tags"]
        return f"expected one of {expected}, got {error['ctx']['tag']!r:.60}"
    if kind in ("model_type", "model_attributes_type", "dict_type"):
        return f"expected a section of keys and values, got {got!r:.60}"
    if kind in ("tuple_type", "list_type"):
        return f"expected a list, got {got!r:.60}"
    if message.startswith(_SHOULD):
        return f"expected {message[len(_SHOULD) :]}, got {got!r:.60}"
    return f"{message}, got {got!r:.60}"
