# SPDX-License-Identifier: BSD-3-Clause
"""The prose of a source tree, line by line: comments, docstrings, texts, pages."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

Lines = Iterator[tuple[int, str]]

# C++: a comment, a raw string or a string; whichever begins first hides what is inside it.
_CPP = re.compile(
    r'(?P<comment>//[^\n]*|/\*.*?\*/)|R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"'
    r"|\"(?P<text>(?:\\.|[^\"\\\n])*)\"|'(?:\\.|[^'\\\n])'",
    re.DOTALL,
)


def numbered(text: str, first: int = 1) -> Lines:
    """Its lines with their numbers, without `code` and without what an f-string's braces hold."""
    text = re.sub(r"``[^`]*``|`[^`\n]*`|\{[^{}\n]*\}", "", text)
    yield from enumerate(text.split("\n"), first)


def of_python(source: str, *, names: bool = False) -> Lines:
    """Comments, docstrings and texts of more than one word; with `names`, also those of functions,
    read as sentences."""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        is_text = token.type == tokenize.STRING or "FSTRING_MIDDLE" in tokenize.tok_name[token.type]
        if token.type == tokenize.COMMENT or (is_text and len(token.string.split()) > 1):
            yield from numbered(token.string, token.start[0])
    if names:
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.FunctionDef):
                yield node.lineno, node.name.replace("_", " ")


def of_cpp(source: str) -> Lines:
    """Comments, and texts of more than one word: messages, docstrings of the bindings."""
    for found in _CPP.finditer(source):
        prose = found["comment"] or found["raw"] or found["text"] or ""
        if found["comment"] or len(prose.split()) > 1:
            yield from numbered(prose, 1 + source.count("\n", 0, found.start()))


def of_markdown(page: str) -> Lines:
    """All of a page outside blocks of code and formulas; links by their text."""
    page = re.sub(r"(?ms)^( *)(```|\$\$).*?^ *\2", lambda m: "\n" * m[0].count("\n"), page)
    yield from numbered(re.sub(r"\]\([^)\s]*\)", "]", page))


class _Text(HTMLParser):
    """What a reader of a page sees, and its tool tips."""

    def __init__(self) -> None:
        super().__init__()
        self.texts: list[str] = []
        self.hidden = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.hidden = tag in ("script", "style")
        self.texts += [value or "" for name, value in attrs if name in ("title", "alt")]

    def handle_endtag(self, tag: str) -> None:
        self.hidden = False

    def handle_data(self, data: str) -> None:
        if not self.hidden:
            self.texts.append(data)


def of_html(page: str) -> Lines:
    reader = _Text()
    reader.feed(page)
    yield from enumerate(reader.texts, 1)


def of_file(path: Path, *, names: bool = False) -> Lines:
    """The prose of a source or a page, by its suffix."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        return of_python(text, names=names)
    return of_markdown(text) if path.suffix == ".md" else of_cpp(text)
