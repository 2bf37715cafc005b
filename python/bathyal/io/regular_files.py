# SPDX-License-Identifier: BSD-3-Clause
"""The one place where files are opened to be read: regular ones only, within one limit."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from typing import BinaryIO

from bathyal._core import Error, check_bytes

# Without it, opening a pipe waits for the other end.
_AT_ONCE = os.O_NONBLOCK | os.O_NOCTTY
# Texts, lists and elements of Python take up to this many times the bytes they were made of.
_MOST_GROWTH = 64


def shown(path: str | os.PathLike[str]) -> str:
    r"""A path as text that every format can hold: bytes of it that are no UTF-8 as ``\xff``.

    Examples
    --------
    >>> print(shown(os.fsdecode(b"survey_\xff.xyz")))
    survey_\xff.xyz
    """
    return os.fsencode(path).decode("utf-8", "backslashreplace")


@contextmanager
def open_regular(path: str | os.PathLike[str]) -> Iterator[tuple[BinaryIO, int]]:
    """A regular file open for reading and its size in bytes; never waits for a pipe's other end.

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read: the operating system's own error.
    Error
        Where the file is a pipe or a device, or has more than BATHYAL_MOST_BYTES.
    """
    with open(path, "rb", opener=lambda name, flags: os.open(name, flags | _AT_ONCE)) as stream:
        status = os.fstat(stream.fileno())  # of what is open, whatever the path names by now
        size = status.st_size
        if not stat.S_ISREG(status.st_mode):
            raise Error(f"{os.fspath(path)}: expected a regular file, got a pipe or a device")
        check_bytes(f"{shown(path)}: the file", size)
        yield stream, size


def check_document(path: str | os.PathLike[str], size: int) -> None:
    """Raise `Error` where a text of `size` bytes is too long to become Python's own objects."""
    check_bytes(f"{shown(path)}: reading it as a document", _MOST_GROWTH * size)
