# SPDX-License-Identifier: BSD-3-Clause
"""Every public function, class and member has a docstring."""

from __future__ import annotations

import ast
import dataclasses
import inspect
import pydoc
import re
from pathlib import Path
from types import FunctionType
from typing import Any

import pytest

import bathyal

ROOT = Path(__file__).parents[3]
STUB = ROOT / "python" / "bathyal" / "_core.pyi"


def without_docstring(stub: str) -> list[str]:
    """Public classes, members and functions of a stub that have none. Setters share that of their
    property."""
    found = []
    for node in ast.parse(stub).body:
        if not isinstance(node, (ast.ClassDef, ast.FunctionDef)) or node.name.startswith("_"):
            continue
        if not ast.get_docstring(node):
            found.append(node.name)
        for member in node.body if isinstance(node, ast.ClassDef) else ():
            if isinstance(member, ast.FunctionDef):
                setter = any(ast.unparse(d).endswith(".setter") for d in member.decorator_list)
                if not (member.name.startswith("_") or setter or ast.get_docstring(member)):
                    found.append(f"{node.name}.{member.name}")
    return found


def documented() -> list[Any]:
    """What docs/api.md lists: every class and function that a user may hold or call."""
    page = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
    names = re.findall(r"^\.\. auto(?:class|exception|function):: (\S+)$", page, re.M)
    return [pydoc.locate(name) for name in names]


def described(doc: str) -> set[str]:
    """Names of the sections Attributes and Parameters."""
    sections = re.findall(r"(?:Attributes|Parameters)\n-+\n(.*?)(?=\n\n|\Z)", doc, re.DOTALL)
    lines = re.findall(r"^([*\w][\w, ]*?)(?: :|$)", "\n".join(sections), re.M)
    return {name.strip() for line in lines for name in line.split(",")}


def members_without_docstring(cls: type) -> list[str]:
    doc = inspect.getdoc(cls) or ""
    fields = (
        {one.name for one in dataclasses.fields(cls)} if dataclasses.is_dataclass(cls) else set()
    )
    fields |= set(getattr(cls, "_fields", ()))
    missing = [name for name in sorted(fields) if name not in described(doc)]
    for name, value in vars(cls).items():
        member: Any = getattr(value, "__func__", value)
        is_member = isinstance(member, (FunctionType, property))
        if is_member and not name.startswith("_") and not inspect.getdoc(member):
            missing.append(name)
    return [name for name in missing if not name.startswith("_")]


def test_what_has_none_is_found() -> None:
    stub = 'def f(): ...\nclass A:\n    """A."""\n    @property\n    def b(self): ...\n'
    assert without_docstring(stub) == ["f", "A.b"]

    @dataclasses.dataclass
    class Two:
        """Two numbers.

        Attributes
        ----------
        a, c : float
        """

        a: float
        b: float

        def d(self) -> None: ...

    assert members_without_docstring(Two) == ["b", "d"]


def test_every_member_of_the_engine_has_a_docstring() -> None:
    assert without_docstring(STUB.read_text(encoding="utf-8")) == []


def test_everything_documented_has_a_docstring() -> None:
    assert None not in documented()
    assert [thing.__name__ for thing in documented() if not inspect.getdoc(thing)] == []
    listed = {f"bathyal.{name}" for name in bathyal.__all__}
    assert not [name for name in listed if not inspect.getdoc(pydoc.locate(name))]


@pytest.mark.parametrize(
    "cls",
    [one for one in documented() if inspect.isclass(one) and one.__module__ != "bathyal._core"],
    ids=lambda cls: cls.__name__,
)
def test_every_field_and_method_of_a_record_is_described(cls: type) -> None:
    assert members_without_docstring(cls) == []
