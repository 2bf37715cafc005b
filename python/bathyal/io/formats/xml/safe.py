# SPDX-License-Identifier: BSD-3-Clause
"""XML from files nobody vouches for."""

from __future__ import annotations

from itertools import count
from typing import NoReturn
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

from bathyal._core import Error, check_bytes

_ELEMENT = 200  # bytes that an element takes at least, with its tag and list of children
_CHECKED_EVERY = 1 << 16


def parse_xml(text: bytes) -> Element:
    """The root element of an XML document that declares no document type.

    Names in a namespace read ``{address}name``, as in the standard library.

    A document type is where entities are declared: the ones that expand without end and the ones
    that fetch other files. No format read here needs it, so it is refused as a whole.

    Raises
    ------
    Error
        For a document type, for text that is not well-formed XML, with the line, and for more
        elements than one file may take in memory.
    """
    tree = TreeBuilder()
    parser = expat.ParserCreate(namespace_separator="}")
    parser.buffer_text = True
    parser.StartDoctypeDeclHandler = _refuse_document_type
    elements = count(1)

    def start(tag: str, attributes: dict[str, str]) -> None:
        if (number := next(elements)) % _CHECKED_EVERY == 0:
            check_bytes("its elements", _ELEMENT * number)
        tree.start(_braced(tag), {_braced(name): value for name, value in attributes.items()})

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: tree.end(_braced(tag))
    parser.CharacterDataHandler = tree.data
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise Error(f"not well-formed XML: {error}") from error
    return tree.close()


def _braced(name: str) -> str:
    return "{" + name if "}" in name else name


def _refuse_document_type(name: str, *_: object) -> NoReturn:
    raise Error(f"XML with a document type ({name}) is refused: entities could be declared in it")
