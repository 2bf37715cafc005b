# SPDX-License-Identifier: BSD-3-Clause
"""How files are opened, refused and replaced: one way for every format."""

from __future__ import annotations

import importlib
import os
import secrets
import shutil
import stat
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, BinaryIO

from bathyal._core import Error
from bathyal.errors import argument_error

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
        An empty file in the same folder, with the same suffix, to write to. When the block ends it
        is renamed to `path` in one step; when the block raises, or is interrupted, it is removed
        and `path` is as it was.

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
    aside = _make_aside(target, os.fspath(path))
    try:
        yield aside
        os.replace(aside, target)
    except BaseException:
        aside.unlink(missing_ok=True)
        raise


def _make_aside(target: Path, name: str) -> Path:
    """An empty file beside `target`, with the rights that `target` has or would get."""
    exists = target.exists()
    if exists and not os.access(target, os.W_OK):
        raise PermissionError(13, "cannot write, the file is write-protected", name)
    aside = target.with_name(f".{target.stem[:80]}-{secrets.token_hex(8)}{target.suffix}")
    try:
        descriptor = os.open(aside, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666)
    except OSError as error:
        reason = f"cannot write, {error.strerror} (folder {target.parent})"
        raise OSError(error.errno, reason, name) from None
    os.close(descriptor)
    if exists:
        os.chmod(aside, stat.S_IMODE(target.stat().st_mode))
    return aside


@contextmanager
def filling(folder: PathLike) -> Iterator[Path]:
    """Write several files aside and move them into `folder` only when all went well.

    Parameters
    ----------
    folder : path
        Made where it is missing; other files in it are left alone.

    Yields
    ------
    pathlib.Path
        A hidden folder inside `folder` to write to. When the block ends its files move up; when the
        block raises, or is interrupted, it is removed, and `folder` too if it was not there.
    """
    folder = Path(folder)
    made = not folder.exists()
    folder.mkdir(parents=True, exist_ok=True)
    aside = Path(tempfile.mkdtemp(prefix=".plan-", dir=folder))
    try:
        yield aside
        for file in sorted(aside.iterdir()):
            os.replace(file, folder / file.name)
    except BaseException:
        shutil.rmtree(aside, ignore_errors=True)
        if made and not any(folder.iterdir()):
            folder.rmdir()
        raise
    shutil.rmtree(aside)


@contextmanager
def reading(path: PathLike, format_name: str) -> Iterator[None]:
    """Tell whatever goes wrong inside as an `Error` that names the file and the reason.

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
    """A file open for reading and its size in bytes.

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read: the operating system's own words.
    Error
        Where the file is empty, or is a pipe or a device.
    """
    with open(path, "rb") as stream:
        status = os.fstat(stream.fileno())
        size = status.st_size
        if not stat.S_ISREG(status.st_mode):
            raise Error(f"{os.fspath(path)}: expected a file, got a pipe or a device")
        if size == 0:
            raise Error(f"{os.fspath(path)}: the file is empty")
        yield stream, size


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
