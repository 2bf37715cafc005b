# SPDX-License-Identifier: BSD-3-Clause
"""Well-known text of reference systems (WKT 1, WKT 2 and ESRI's), as a tree of keywords."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

_TOKEN = re.compile(r'\s*(?:("(?:[^"]|"")*")|([\[(])|([\])])|(,)|([^\s,"()\[\]]+))')
_DEEPEST = 32


@dataclass
class Node:
    """``KEYWORD[value, …, CHILD[…], …]``; values are texts and numbers, without quotes."""

    keyword: str
    values: list[str] = field(default_factory=list)
    children: list[Node] = field(default_factory=list)

    def named(self, *keywords: str) -> Iterator[Node]:
        """The children of these keywords."""
        return (child for child in self.children if child.keyword in keywords)


def parse_wkt(text: str) -> list[Node] | None:
    """The trees of a text: one, or several where a comma parts them; None where it is no WKT."""
    top = Node("")
    open_nodes = [top]
    word = ""
    at = 0
    end = len(text.rstrip())
    while at < end:
        token = _TOKEN.match(text, at, end)
        if token is None:
            return None
        at = token.end()
        quoted, opening, closing, _, bare = token.groups()
        if word and not opening:
            open_nodes[-1].values.append(word)
        if opening:
            if not word or len(open_nodes) > _DEEPEST:
                return None
            node = Node(word.upper())
            open_nodes[-1].children.append(node)
            open_nodes.append(node)
        elif closing:
            if len(open_nodes) == 1:
                return None
            open_nodes.pop()
        elif quoted:
            open_nodes[-1].values.append(quoted[1:-1].replace('""', '"'))
        word = bare or ""
    if word or len(open_nodes) != 1 or top.values:
        return None
    return top.children
