# SPDX-License-Identifier: BSD-3-Clause
"""YAML from files nobody vouches for: plain data, and the line and column of every value.

Only what JSON could hold comes out: no tag is followed, so that no file makes objects or runs code.
Values read as YAML 1.2's core schema says (``1e-3`` is a number, ``no`` is a word). Aliases are
taken, and what they repeat is counted.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn

from bathyal._core import Error
from bathyal.io.files import PathLike, opened
from bathyal.io.regular_files import shown

MOST_BYTES = 4 << 20
MOST_VALUES = 200_000
_DEEPEST = 40
_LONGEST_NUMBER = 60  # characters

Place = tuple[str | int, ...]


@dataclass(frozen=True)
class Mark:
    """Where a value begins, counted from 1."""

    line: int
    column: int


@dataclass(frozen=True)
class Document:
    """The data of a YAML file.

    Attributes
    ----------
    path : str
        The file, as it was given.
    value : Any
        dict, list, str, int, float, bool or None.
    marks : dict of Mark
        By the keys and rows that lead to a value, ``("keepouts", 0, "radius")``.
    """

    path: str
    value: Any
    marks: dict[Place, Mark] = field(default_factory=dict)

    @property
    def folder(self) -> Path:
        """Where relative names of files start."""
        return Path(os.path.abspath(self.path)).parent

    def where(self, place: Sequence[str | int] = ()) -> str:
        """ "file:line:column" of a value, or of the nearest that contains it."""
        place = tuple(place)
        while place and place not in self.marks:
            place = place[:-1]
        mark = self.marks.get(place, Mark(1, 1))
        return f"{shown(self.path)}:{mark.line}:{mark.column}"


def read_yaml(path: PathLike) -> Document:
    """Read one YAML document.

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        With line and column: for text that is no YAML, a tag, an anchor that contains itself, a key
        that comes twice or is no text, a second document; for more than `MOST_BYTES` bytes or,
        aliases counted as often as they are used, `MOST_VALUES` values.
    """
    with opened(path) as (stream, size):
        if size > MOST_BYTES:
            raise Error(
                f"{shown(path)}: expected a YAML file of at most {MOST_BYTES:,} bytes, got {size:,}"
            )
        content = stream.read(MOST_BYTES + 1)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Error(f"{shown(path)}: expected text, got bytes that are not UTF-8") from error
    reader = _Reader(os.fspath(path))
    marks: dict[Place, Mark] = {}
    value = _spread(reader.root(text), (), marks)
    return Document(os.fspath(path), value, marks)


@dataclass
class _Node:
    """A value as it is in the file; one object where aliases repeat it."""

    mark: Mark
    value: Any  # str, number …; list of nodes; dict of (mark of the key, node)
    size: int = 1
    depth: int = 1
    open: bool = False


class _Reader:
    """Nodes from the events of the parser, with no recursion."""

    def __init__(self, path: str) -> None:
        self.path = shown(path)

    def fail(self, at: Mark, text: str) -> NoReturn:
        raise Error(f"{self.path}:{at.line}:{at.column}: {text}")

    def root(self, text: str) -> _Node:
        import yaml  # type: ignore[import-untyped]

        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
        try:
            return self._read(yaml.parse(text, Loader=loader))
        except yaml.MarkedYAMLError as error:
            reason = " ".join(filter(None, (error.context, error.problem)))
            mark = error.problem_mark or error.context_mark
            if mark is None:
                raise Error(f"{self.path}: not readable YAML: {reason}") from error
            self.fail(_mark(mark), f"not readable YAML: {reason}")
        except yaml.YAMLError as error:
            reason = " ".join(str(error).split())
            raise Error(f"{self.path}: not readable YAML: {reason}") from error

    def _read(self, events: Iterator[Any]) -> _Node:
        from yaml import events as kinds

        anchors: dict[str, _Node] = {}
        stack: list[_Node] = []
        keys: list[_Node | None] = []  # of each open mapping, the key that waits for its value
        done: _Node | None = None
        for event in events:
            if isinstance(event, kinds.DocumentStartEvent) and done is not None:
                self.fail(_mark(event.start_mark), "expected one document, got a second")
            if isinstance(event, (kinds.MappingEndEvent, kinds.SequenceEndEvent)):
                node = stack.pop()
                keys.pop()
                node.open = False
            elif isinstance(event, kinds.AliasEvent):
                if event.anchor not in anchors:
                    self.fail(
                        _mark(event.start_mark), f"alias *{event.anchor} has no anchor before it"
                    )
                node = anchors[event.anchor]
                if node.open:
                    self.fail(_mark(event.start_mark), f"anchor &{event.anchor} contains itself")
            elif isinstance(event, kinds.NodeEvent):
                node = self._begin(event, stack)
                if event.anchor:
                    anchors[event.anchor] = node
                if node.open:
                    stack.append(node)
                    keys.append(None)
                    continue
            else:
                continue
            if stack:
                self._put(stack[-1], node, keys, event)
            else:
                done = node
        if done is None:
            raise Error(f"{self.path}: the file holds no value")
        return done

    def _begin(self, event: Any, stack: list[_Node]) -> _Node:
        from yaml import events as kinds

        if event.tag is not None:
            self.fail(_mark(event.start_mark), f"tags are refused, got {event.tag!r:.60}")
        mark = _mark(event.start_mark)
        if isinstance(event, kinds.ScalarEvent):
            return _Node(mark, event.value if event.style else _plain(event.value))
        if len(stack) >= _DEEPEST:
            self.fail(_mark(event.start_mark), f"expected at most {_DEEPEST} levels, got more")
        value: Any = {} if isinstance(event, kinds.MappingStartEvent) else []
        return _Node(mark, value, open=True)

    def _put(self, into: _Node, node: _Node, keys: list[_Node | None], event: Any) -> None:
        into.size += node.size
        if into.size > MOST_VALUES:
            self.fail(_mark(event.start_mark), f"expected at most {MOST_VALUES:,} values, got more")
        into.depth = max(into.depth, node.depth + 1)
        if into.depth > _DEEPEST:  # by aliases
            self.fail(_mark(event.start_mark), f"expected at most {_DEEPEST} levels, got more")
        if isinstance(into.value, list):
            into.value.append(node)
            return
        key = keys[-1]
        if key is None:
            if not isinstance(node.value, (str, int, float)) or isinstance(node.value, bool):
                self.fail(node.mark, "expected a word as key")
            if str(node.value) in into.value:
                self.fail(node.mark, f"key {node.value!r:.60} comes twice")
            keys[-1] = node
        else:
            into.value[str(key.value)] = (key.mark, node)
            keys[-1] = None


def _mark(mark: Any) -> Mark:
    return Mark(mark.line + 1, mark.column + 1)


def _spread(node: _Node, place: Place, marks: dict[Place, Mark]) -> Any:
    """Plain data, aliases spread out; marks of a mapping's values are those of their keys."""
    marks.setdefault(place, node.mark)
    if isinstance(node.value, list):
        return [_spread(item, (*place, row), marks) for row, item in enumerate(node.value)]
    if isinstance(node.value, dict):
        spread = {}
        for key, (mark, item) in node.value.items():
            marks[(*place, key)] = mark
            spread[key] = _spread(item, (*place, key), marks)
        return spread
    return node.value


_NULL = re.compile(r"~|null|Null|NULL|")
_TRUE, _FALSE = re.compile(r"true|True|TRUE"), re.compile(r"false|False|FALSE")
_INT = re.compile(r"[-+]?[0-9]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_INF = re.compile(r"([-+]?)\.(inf|Inf|INF)")
_NAN = re.compile(r"\.(nan|NaN|NAN)")


def _plain(text: str) -> Any:
    """A value without quotes, by the core schema."""
    if _NULL.fullmatch(text):
        return None
    if _TRUE.fullmatch(text):
        return True
    if _FALSE.fullmatch(text):
        return False
    if len(text) > _LONGEST_NUMBER:
        return text
    if _INT.fullmatch(text):
        return int(text)
    if _FLOAT.fullmatch(text):
        return float(text)
    if _INF.fullmatch(text):
        return float(text.replace(".", ""))
    return float("nan") if _NAN.fullmatch(text) else text
