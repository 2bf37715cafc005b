# SPDX-License-Identifier: BSD-3-Clause
"""The id of a run inside the files that it wrote, where their formats have a place for it.

JSON: the key "run". HTML: the meta element "bathyal-run". PNG: a text chunk. URDF and VTP: an XML
comment. Text that begins with notes (#): one more note. Tables without notes have no place, because
other programs would take a note for their header; the manifest's hashes hold them.
"""

from __future__ import annotations

import os
import re
import shutil
import struct
import zlib
from collections.abc import Callable
from pathlib import Path

_HEAD = 4096  # bytes of a file within which its place for the id lies


def stamp(file: Path, run: str) -> None:
    """Put the id into a file of results, or leave the file as it is where there is no place."""
    if file.suffix not in _PLACES:
        return
    begin, text = _PLACES[file.suffix]
    with open(file, "rb") as source:
        place = begin.match(source.read(_HEAD))
        if place is None:
            return
        aside = file.with_name(f"{file.name}.stamped")
        with open(aside, "wb") as stream:
            stream.write(place[0] + text(run.encode("ascii")))
            source.seek(place.end())
            shutil.copyfileobj(source, stream, 1 << 20)
    shutil.copymode(file, aside)
    os.replace(aside, file)


def _key(run: bytes) -> bytes:
    return b'  "run": "' + run + b'",\n'


def _meta(run: bytes) -> bytes:
    return b'<meta name="bathyal-run" content="' + run + b'">\n'


def _chunk(run: bytes) -> bytes:
    body = b"tEXtbathyal-run\0" + run
    return struct.pack(">I", len(body) - 4) + body + struct.pack(">I", zlib.crc32(body))


def _comment(run: bytes) -> bytes:
    return b"<!-- bathyal run " + run + b" -->\n"


def _note(run: bytes) -> bytes:
    return b"# bathyal run " + run + b"\n"


_XML = (re.compile(rb"<\?xml[^>]*\?>\n"), _comment)
_NOTED = (re.compile(rb"#[^\n]*\n"), _note)

# By suffix: what a file begins with, up to the place of the id, and how the id is written there.
_PLACES: dict[str, tuple[re.Pattern[bytes], Callable[[bytes], bytes]]] = {
    ".json": (re.compile(rb"\{\n"), _key),
    ".html": (re.compile(rb".*?<head>\n", re.DOTALL), _meta),
    ".png": (re.compile(rb"\x89PNG.{29}", re.DOTALL), _chunk),  # signature and IHDR
    ".urdf": _XML,
    ".vtp": _XML,
    ".csv": _NOTED,
    ".yaml": _NOTED,
    ".conf": _NOTED,
}
