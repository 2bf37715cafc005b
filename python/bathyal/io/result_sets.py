# SPDX-License-Identifier: BSD-3-Clause
"""How the files of one run come into a folder: as one set, or not at all."""

from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from bathyal._core import Error
from bathyal.io.asides import aside_in, locked, sweep
from bathyal.io.files import PathLike
from bathyal.io.manifest import (
    NAME,
    ResultSet,
    read_manifest,
    sha256_of,
    without,
    write_manifest,
)
from bathyal.io.run_stamp import stamp

_DIGITS = 16  # of a run's id


@contextmanager
def filling(folder: PathLike, job: str) -> Iterator[Path]:
    """Write several files aside and put them into `folder` as one set when all went well.

    Parameters
    ----------
    folder : path
        Made where it is missing. Files that an earlier run of the same job wrote and this one does
        not are removed, unless they were changed since; all others are left alone.
    job : str
        What makes the set, as the command line calls it.

    Yields
    ------
    pathlib.Path
        A hidden folder inside `folder` to write to. When the block ends, its files get the run's id
        (`bathyal.io.run_stamp`) and move up, and the manifest is written last: where the process is
        killed between, the readers refuse the set. When the block raises, or is interrupted, all
        is as it was, and `folder` is gone if it was not there.
    """
    folder = Path(folder)
    made = not folder.exists()
    folder.mkdir(parents=True, exist_ok=True)
    try:
        sweep(folder)
        with aside_in(folder) as aside:
            new, old = aside / "new", aside / "old"
            new.mkdir()
            old.mkdir()
            yield new
            with locked(folder):
                _put_in_place(new, old, folder, job)
    except BaseException:
        if made and not any(folder.iterdir()):
            folder.rmdir()
        raise


def _put_in_place(new: Path, old: Path, folder: Path, job: str) -> None:
    names = sorted(file.name for file in new.iterdir())
    _refuse_folders(folder, names)
    run = _stamped(new, names)
    files = {name: _sha256(new / name) for name in names}
    earlier = _earlier_sets(folder)
    others = without([one for one in earlier if one.job != job], names)
    stale = _stale(folder, [one for one in earlier if one.job == job], names)
    manifest = folder / NAME
    before = manifest.read_bytes() if manifest.exists() else None
    try:
        write_manifest(folder, [*others, ResultSet(job, run, False, {**stale, **files})])
        for name in stale:
            os.replace(folder / name, old / name)
        for name in names:
            if os.path.lexists(folder / name):
                _keep(folder / name, old / name)
            os.replace(new / name, folder / name)
        write_manifest(folder, [*others, ResultSet(job, run, True, files)])
    except BaseException:
        _put_back(new, old, folder, names)
        if before is None:
            manifest.unlink(missing_ok=True)
        else:
            manifest.write_bytes(before)
        raise


def _refuse_folders(folder: Path, names: Sequence[str]) -> None:
    for name in names:
        if (folder / name).is_dir():
            raise IsADirectoryError(21, "cannot write, it is a folder", os.fspath(folder / name))


def _stamped(new: Path, names: Sequence[str]) -> str:
    """The run's id, which is put into the files: of their contents, so that the same results are
    the same bytes."""
    digest = hashlib.sha256()
    for name in names:
        digest.update(f"{_sha256(new / name)}  {name}\n".encode())
    run = digest.hexdigest()[:_DIGITS]
    for name in names:
        stamp(new / name, run)
    return run


def _earlier_sets(folder: Path) -> list[ResultSet]:
    try:
        return read_manifest(folder)
    except Error:  # what a broken one said is lost; the new one is whole
        return []


def _stale(folder: Path, earlier: Sequence[ResultSet], names: Sequence[str]) -> dict[str, str]:
    """What an earlier run of the job wrote, this one does not, and nobody changed."""
    return {
        name: digest
        for one in without(earlier, names)
        for name, digest in one.files.items()
        if (folder / name).is_file() and _sha256(folder / name) == digest
    }


def _keep(file: Path, copy: Path) -> None:
    try:
        os.link(file, copy, follow_symlinks=False)
    except OSError:  # a file system without hard links
        shutil.copy2(file, copy, follow_symlinks=False)


def _put_back(new: Path, old: Path, folder: Path, names: Sequence[str]) -> None:
    for name in names:
        if not (new / name).exists():
            (folder / name).unlink(missing_ok=True)
    for file in old.iterdir():
        os.replace(file, folder / file.name)


def _sha256(file: Path) -> str:
    with open(file, "rb") as stream:
        return sha256_of(stream)
