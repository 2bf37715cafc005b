# SPDX-License-Identifier: BSD-3-Clause
"""Queries of a run base: a text becomes SQL whose values are all bound, never pasted in."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import NoReturn

_TOKEN = re.compile(
    r"\s*(?:(?P<number>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)"
    r"|(?P<text>'[^']*'|\"[^\"]*\")"
    r"|(?P<sign><=|>=|!=|=|<|>|\(|\))"
    r"|(?P<name>[A-Za-z_][\w.]*))"
)
_NUMBERS = {"id", "seed", "duration"}
_TEXTS = {"name", "status", "folder", "scenario_sha256"}
_MARKS = {"event", "fault"}
_FIELDS = "metric NAME, event, fault, " + ", ".join(sorted(_NUMBERS | _TEXTS))
_COMPARISONS = {"<", ">", "<=", ">=", "=", "!="}
_DEEPEST, _MOST = 50, 200  # below the limits of SQLite's parser


@dataclass(frozen=True)
class _Token:
    kind: str  # number, text, sign, name, end
    text: str
    column: int


def compile_query(text: str) -> tuple[str, list[float | str]]:
    """The condition of a query as SQL on the table ``runs``, and the values to bind.

    Parameters
    ----------
    text : str
        As `RunBase.query` takes it.

    Returns
    -------
    tuple of str and list

    Raises
    ------
    ValueError
        What was expected and what came, with the column, counted from 1.

    Examples
    --------
    >>> compile_query("status = 'done' and seed < 3")
    ('(status = ? AND seed < ?)', ['done', 3])
    """
    parser = _Parser(_tokens(text))
    sql = parser.either(0)
    if parser.token.kind != "end":
        parser.fail("`and`, `or` or the end")
    return sql, parser.values


def _tokens(text: str) -> list[_Token]:
    found, at = [], 0
    end = len(text.rstrip())
    while at < end:
        match = _TOKEN.match(text, at)
        if match is None or match.lastgroup is None:
            column = at + len(text[at:]) - len(text[at:].lstrip())
            _fail("a name, a number, a quoted text or a sign", repr(text[column]), column)
        found.append(_Token(match.lastgroup, match[match.lastgroup], match.start(match.lastgroup)))
        at = match.end()
    return [*found, _Token("end", "", end)]


def _fail(expected: str, got: str, column: int) -> NoReturn:
    raise ValueError(f"`query`: expected {expected}, got {got} at column {column + 1}")


class _Parser:
    """Recursive descent: or, and, not, comparison."""

    def __init__(self, tokens: list[_Token]) -> None:
        self._tokens = tokens
        self._at = 0
        self._comparisons = 0
        self.values: list[float | str] = []

    @property
    def token(self) -> _Token:
        return self._tokens[self._at]

    def fail(self, expected: str) -> NoReturn:
        got = "the end" if self.token.kind == "end" else repr(self.token.text[:40])
        _fail(expected, got, self.token.column)

    def either(self, depth: int) -> str:
        return self._joined("or", depth)

    def _joined(self, word: str, depth: int) -> str:
        def part() -> str:
            return self._joined("and", depth) if word == "or" else self._inverted(depth)

        parts = [part()]
        while self._take("name", word):
            parts.append(part())
        return parts[0] if len(parts) == 1 else f"({f' {word.upper()} '.join(parts)})"

    def _inverted(self, depth: int) -> str:
        if depth > _DEEPEST:
            self.fail(f"at most {_DEEPEST} levels")
        if self._take("name", "not"):
            return f"(NOT {self._inverted(depth + 1)})"
        if self._take("sign", "("):
            inner = self.either(depth + 1)
            if not self._take("sign", ")"):
                self.fail("`)`")
            return inner
        return self._comparison()

    def _comparison(self) -> str:
        self._comparisons += 1
        if self._comparisons > _MOST:
            self.fail(f"at most {_MOST} comparisons")
        field = self.token.text
        if self.token.kind != "name" or field not in {"metric", *_MARKS, *_NUMBERS, *_TEXTS}:
            self.fail(_FIELDS)
        self._at += 1
        if field in _MARKS:
            return self._mark(field)
        metric = self._metric() if field == "metric" else ""
        sign = self.token.text
        if self.token.kind != "sign" or sign not in _COMPARISONS:
            self.fail("<, <=, >, >=, = or !=")
        self._at += 1
        if metric:
            self.values += [metric, self._number()]
            return f"id IN (SELECT run FROM metrics WHERE name = ? AND value {sign} ?)"
        self.values.append(self._number() if field in _NUMBERS else self._text())
        return f"{field} {sign} ?"

    def _metric(self) -> str:
        if self.token.kind != "name":
            self.fail("a metric's name")
        self._at += 1
        return self._tokens[self._at - 1].text

    def _mark(self, field: str) -> str:
        if not self._take("sign", "="):
            self.fail("`=`")
        self.values += [field, self._text()]
        return "id IN (SELECT run FROM marks WHERE what = ? AND value = ?)"

    def _number(self) -> float:
        if self.token.kind != "number":
            self.fail("a number")
        text = self.token.text
        self._at += 1
        whole = text.lstrip("+-").isdecimal() and len(text) < 19  # of 63 bits
        return int(text) if whole else float(text)

    def _text(self) -> str:
        if self.token.kind != "text":
            self.fail("a text in quotes")
        self._at += 1
        return self._tokens[self._at - 1].text[1:-1]

    def _take(self, kind: str, text: str) -> bool:
        if self.token.kind == kind and self.token.text == text:
            self._at += 1
            return True
        return False
