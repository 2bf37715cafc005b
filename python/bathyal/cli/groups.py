# SPDX-License-Identifier: BSD-3-Clause
"""Options that several commands share are written once: as the fields of a dataclass."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import is_dataclass
from functools import wraps
from typing import Any, get_type_hints


def spread(command: Callable[..., None]) -> Callable[..., None]:
    """The command as typer is to see it: a parameter that is a dataclass is spread out into its
    fields, each an option of its own. The command is called with the dataclass filled in.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @dataclass
    ... class Size:
    ...     length: float = 1.0
    ...     width: float = 2.0
    >>> @spread
    ... def area(name: str, size: Size) -> None:
    ...     print(name, size.length * size.width)
    >>> list(inspect.signature(area).parameters)
    ['name', 'length', 'width']
    >>> area(name="field", width=5.0)
    field 5.0
    """
    hints = get_type_hints(command)
    groups: dict[str, Any] = {name: hint for name, hint in hints.items() if is_dataclass(hint)}
    members = {name: _parameters(group) for name, group in groups.items()}
    parameters = [option for own in _parameters(command) for option in members.get(own.name, [own])]

    @wraps(command)
    def called(**values: Any) -> None:
        for name, group in groups.items():
            own = {option.name for option in members[name]} & values.keys()
            values[name] = group(**{option: values.pop(option) for option in own})
        command(**values)

    called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    called.__annotations__ = {p.name: p.annotation for p in parameters}
    return called


def _parameters(function: Any) -> list[inspect.Parameter]:
    """Of a function or a dataclass, all by keyword and with their annotations evaluated."""
    hints = get_type_hints(function, include_extras=True)
    return [
        parameter.replace(annotation=hints[parameter.name], kind=inspect.Parameter.KEYWORD_ONLY)
        for parameter in inspect.signature(function).parameters.values()
    ]
