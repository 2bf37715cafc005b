# SPDX-License-Identifier: BSD-3-Clause
"""Methods in Python for the classes of the engine, which itself imports nothing of the package."""

from __future__ import annotations

from collections.abc import Callable
from inspect import cleandoc
from typing import TypeVar

Carrier = TypeVar("Carrier", bound=type)


def methods_of(cls: type) -> Callable[[Carrier], Carrier]:
    """Give an engine's class the methods and properties of a class derived from it.

    The derived class is only where they are written: there mypy reads `self` as the engine's class
    and compares each signature with the stub.

    Examples
    --------
    >>> class Depth:
    ...     metres = 51.2
    >>> @methods_of(Depth)
    ... class _Depth(Depth):
    ...     def text(self) -> str:
    ...         return f"{self.metres} m"
    >>> Depth().text()
    '51.2 m'
    """

    def attach(carrier: Carrier) -> Carrier:
        for name, member in vars(carrier).items():
            if name.startswith("__") and name != "__str__":
                continue  # of every class
            for function in _functions(member):
                function.__qualname__ = f"{cls.__qualname__}.{name}"
                function.__doc__ = cleandoc(function.__doc__ or "")  # as the stub shows it
            setattr(cls, name, member)
        return carrier

    return attach


def _functions(member: object) -> list[Callable[..., object]]:
    """What a method, static method or property is made of."""
    if isinstance(member, property):
        return [part for part in (member.fget, member.fset) if part is not None]
    if isinstance(member, (staticmethod, classmethod)):
        return [member.__func__]
    return [member] if callable(member) else []
