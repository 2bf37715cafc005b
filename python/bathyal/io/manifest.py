# SPDX-License-Identifier: BSD-3-Clause
"""The manifest of a folder of results: which files are of which run, with their hashes.

It says "incomplete" before the first file of a run is put in place and is written again after the
last, so that files of two runs are never read as one set.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, BinaryIO

from bathyal._core import Error
from bathyal.io.asides import aside_in, locked
from bathyal.io.regular_files import check_document, open_regular

NAME = "bathyal-manifest.json"
_FORMAT = "bathyal results"
_VERSION = 1


@dataclass(frozen=True)
class ResultSet:
    """The files that one run of a job put into a folder, each with its SHA-256."""

    job: str
    run: str
    complete: bool
    files: Mapping[str, str]


def read_manifest(folder: Path) -> list[ResultSet]:
    """The sets of a folder; none where it has no manifest.

    Raises
    ------
    Error
        For a manifest that is broken; the text says what to do about it.
    """
    path = folder / NAME
    try:
        with open_regular(path) as (stream, size):
            check_document(path, size)
            text = stream.read(size).decode("utf-8")
    except FileNotFoundError:
        return []
    except UnicodeDecodeError:
        text = ""
    try:
        content = json.loads(text)
        if content["format"] != _FORMAT or content["version"] != _VERSION:
            raise ValueError
        return [_result_set(entry) for entry in content["sets"]]
    except (AttributeError, KeyError, TypeError, ValueError, RecursionError):
        raise Error(
            f"{path}: not a manifest of version {_VERSION}: delete it to read the files of its "
            "folder unchecked"
        ) from None


def write_manifest(folder: Path, sets: Sequence[ResultSet]) -> None:
    """Replace the manifest of a folder in one step; without sets it goes."""
    if not sets:
        (folder / NAME).unlink(missing_ok=True)
        return
    content = {"format": _FORMAT, "version": _VERSION, "sets": [asdict(one) for one in sets]}
    with aside_in(folder) as aside:
        (aside / NAME).write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
        os.replace(aside / NAME, folder / NAME)


def check_file(path: str | os.PathLike[str], stream: BinaryIO) -> None:
    """Refuse a file that a manifest next to it lists and that is not the one listed.

    Files that no manifest lists are not looked at. The stream is left at its beginning.
    """
    file = Path(os.path.realpath(path))
    for listed in read_manifest(file.parent):
        if file.name not in listed.files:
            continue
        by = f"bathyal {listed.job}, run {listed.run}"
        remedy = (
            f"run bathyal {listed.job} into this folder again, or delete {NAME} to read the file "
            "unchecked"
        )
        if not listed.complete:
            raise Error(
                f"{os.fspath(path)}: expected a whole set of results of {by}, got one that was not "
                f"finished: {remedy}"
            )
        if sha256_of(stream) != listed.files[file.name]:
            raise Error(
                f"{os.fspath(path)}: expected the file as written by {by}, got another: {remedy}"
            )
        stream.seek(0)


def release(path: Path) -> None:
    """A file that was replaced by itself is of no set any longer."""
    if not (path.parent / NAME).exists():
        return
    with locked(path.parent):
        sets = read_manifest(path.parent)
        if any(path.name in one.files for one in sets):
            write_manifest(path.parent, without(sets, [path.name]))


def without(sets: Sequence[ResultSet], names: Sequence[str]) -> list[ResultSet]:
    """The sets without some of their files; a set without files goes."""
    rest = [
        ResultSet(
            one.job,
            one.run,
            one.complete,
            {name: digest for name, digest in one.files.items() if name not in names},
        )
        for one in sets
    ]
    return [one for one in rest if one.files]


def sha256_of(stream: BinaryIO) -> str:
    """The SHA-256 of the rest of a stream."""
    digest = hashlib.sha256()
    while block := stream.read(1 << 20):
        digest.update(block)
    return digest.hexdigest()


def _result_set(entry: Any) -> ResultSet:
    one = ResultSet(**entry)
    texts = [one.job, one.run, *one.files, *one.files.values()]
    if not all(isinstance(text, str) for text in texts) or not isinstance(one.complete, bool):
        raise ValueError
    return one
