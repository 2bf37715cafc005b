# SPDX-License-Identifier: BSD-3-Clause
"""How files are opened, refused and replaced: one way for every format."""

from __future__ import annotations

import importlib
import os
import stat
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any, BinaryIO

from bathyal._core import Error
from bathyal.errors import argument_error
from bathyal.io.asides import aside_in, sweep
from bathyal.io.manifest import check_file, release
from bathyal.io.regular_files import check_document, open_regular
from bathyal.io.regular_files import shown as shown

PathLike = str | os.PathLike[str]


@contextmanager
def replacing(path: PathLike) -> Iterator[Path]:
    """Write a file aside and put it in the place of `path` only when all went well.

    Parameters
    ----------
    path : path
        The file to make or to replace. A link is followed: what it points at is replaced. A device
        (``/dev/null``) cannot be replaced and is written as it is.

    Yields
    ------
    pathlib.Path
        An empty file of the same name in a hidden folder next to it, to write to. When the block
        ends it is moved to `path` in one step; when the block raises, or is interrupted, it is
        removed and `path` is as it was.

    Raises
    ------
    OSError
        That names `path`, where its folder is missing or may not be written, or where `path` is a
        folder or a file that is write-protected.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> with replacing(folder / "depths.txt") as aside:
    ...     _ = aside.write_text("-51.2")
    >>> [file.name for file in folder.iterdir()]
    ['depths.txt']
    """
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise IsADirectoryError(21, "cannot write, it is a folder", os.fspath(path))
    if target.exists() and not target.is_file():
        yield target
        return
    if target.exists() and not os.access(target, os.W_OK):
        reason = "cannot write, the file is write-protected"
        raise PermissionError(13, reason, os.fspath(path))
    with _aside(target, os.fspath(path)) as aside:
        yield aside
        os.replace(aside, target)
    release(target)


@contextmanager
def _aside(target: Path, name: str) -> Iterator[Path]:
    """An empty file near `target`, with the rights that `target` has or would get."""
    with ExitStack() as folder:
        try:
            _sweep_once(target.parent)
            aside = folder.enter_context(aside_in(target.parent)) / target.name
            aside.touch()
        except OSError as error:
            reason = f"cannot write, {error.strerror} (folder {target.parent})"
            raise OSError(error.errno, reason, name) from None
        if target.exists():
            aside.chmod(stat.S_IMODE(target.stat().st_mode))
        yield aside


@lru_cache(maxsize=64)
def _sweep_once(folder: Path) -> None:
    """A job may write many files into a folder of many: it looks for abandoned files only once."""
    sweep(folder)


@contextmanager
def reading(path: PathLike, format_name: str) -> Iterator[None]:
    """Report whatever goes wrong inside as an `Error` that names the file and the reason.

    Libraries report a broken file by whatever it broke in them (``struct.error``, ``KeyError``,
    ``OSError``…); the caller gets one kind, with the library's own error chained to it.
    """
    try:
        yield
    except Error as error:
        if str(error).startswith(os.fspath(path)):
            raise
        raise Error(f"{os.fspath(path)}: {error}") from error.__cause__
    except BaseException as error:
        # A library in Rust that gives up raises what is no Exception.
        if not isinstance(error, Exception) and type(error).__name__ != "PanicException":
            raise
        reason = str(error).strip() or type(error).__name__
        if isinstance(error, KeyError):
            reason = f"{reason} is missing"
        raise Error(f"{os.fspath(path)}: not a readable {format_name} file: {reason}") from error


@contextmanager
def opened(path: PathLike) -> Iterator[tuple[BinaryIO, int]]:
    """A regular file open for reading and its size in bytes; never waits for a pipe's other end.

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read: the operating system's own error.
    Error
        Where the file is empty, is a pipe or a device, has more than BATHYAL_MOST_BYTES, or lies in
        a folder of results and is not the file that its manifest lists.
    """
    with open_regular(path) as (stream, size):
        if size == 0:
            raise Error(f"{os.fspath(path)}: the file is empty")
        check_file(path, stream)
        yield stream, size


def read_document(path: PathLike) -> bytes:
    """A text that becomes Python's own objects as a whole (JSON, XML, small tables).

    Raises
    ------
    OSError, Error
        As `opened`; also where those objects could take more than BATHYAL_MOST_BYTES.
    """
    with opened(path) as (stream, size):
        check_document(path, size)
        return stream.read(size)


def read_document_text(path: PathLike) -> str:
    """`read_document` of UTF-8, with or without a byte order mark.

    Raises
    ------
    OSError, Error
        As `read_document`, and where it is not UTF-8.
    """
    try:
        return read_document(path).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Error(
            f"{os.fspath(path)}: expected text, got bytes that are not UTF-8 (a spreadsheet "
            "program saves it as CSV UTF-8)"
        ) from error


def need(module: str, package: str, purpose: str, *, extra: str = "") -> Any:
    """Import an optional library, or say what it is for and how to get it.

    `extra` is the one of bathyal's own that brings it along.
    """
    try:
        imported: ModuleType = importlib.import_module(module)
    except ImportError as error:
        with_extra = f", or bathyal with its extra [{extra}]" if extra else ""
        raise Error(
            f"{purpose} needs the Python package {package}: pip install '{package}'{with_extra}"
        ) from error
    return imported


def known_suffix(path: PathLike, known: Iterable[str], thing: str) -> str:
    """The suffix of `path` in lower case, or a `ValueError` that lists what there is."""
    suffix = Path(path).suffix.lower()
    if suffix not in known:
        names = " ".join(sorted(known))
        raise argument_error("path", f"a {thing} file ({names})", repr(os.fspath(path)))
    return suffix
