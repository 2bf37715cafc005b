# SPDX-License-Identifier: BSD-3-Clause
"""Hidden folders in which files are written before they are put in place.

Whoever makes one holds a lock on it as long as it lives. The lock goes with the process, however
that ends, so the next one can distinguish what was abandoned from what is still being written.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_PREFIX = ".bathyal-"


@contextmanager
def aside_in(folder: Path) -> Iterator[Path]:
    """A hidden folder in `folder`, held by this process and gone when the block ends."""
    aside, held = _make(folder)
    try:
        yield aside
    finally:
        shutil.rmtree(aside, ignore_errors=True)
        os.close(held)


def sweep(folder: Path) -> None:
    """Remove what processes that ended while they wrote have left in `folder`; never what a living
    one holds. Where the file system keeps no locks, or another user left it, it stays."""
    try:
        names = os.listdir(folder)
    except PermissionError:  # a folder may be written to and yet not be listed
        return
    for name in names:
        left = folder / name
        if name.startswith(_PREFIX) and left.is_dir() and not left.is_symlink():
            with suppress(OSError), _opened(left) as descriptor:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(left, ignore_errors=True)


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Of several processes that change the files of one folder, one at a time."""
    with _opened(folder) as descriptor:
        _lock(descriptor)
        yield


def _make(folder: Path) -> tuple[Path, int]:
    while True:
        aside = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=folder))
        try:
            held = os.open(aside, os.O_RDONLY)
        except FileNotFoundError:
            continue
        _lock(held)
        if aside.exists():  # else another process swept it before it was held
            return aside, held
        os.close(held)


def _lock(descriptor: int) -> None:
    # Some network file systems know no locks on folders: `sweep` then leaves all as it is, and
    # the hashes in the manifest still show when two runs were mixed.
    with suppress(OSError):
        fcntl.flock(descriptor, fcntl.LOCK_EX)


@contextmanager
def _opened(folder: Path) -> Iterator[int]:
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        yield descriptor
    finally:
        os.close(descriptor)
