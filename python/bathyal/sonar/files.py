# SPDX-License-Identifier: BSD-3-Clause
"""Records from and to files, by format."""

from __future__ import annotations

import os
from pathlib import Path

from bathyal._core import Error
from bathyal.errors import argument_error
from bathyal.sonar.record import SonarRecord
from bathyal.sonar.store import RecordStore, write_store
from bathyal.sonar.xtf import is_xtf, record_of_xtf, xtf_of_record


def _write_xtf(record: SonarRecord, path: Path) -> None:
    path.write_bytes(xtf_of_record(record))


_WRITERS = {".xtf": _write_xtf, ".zarr": write_store}


def read_sonar(path: str | os.PathLike[str]) -> SonarRecord:
    """Reads what a sonar recorded, by the content: an XTF file, or the folder of a survey.

    What lies in a folder is read when it is asked for.

    Parameters
    ----------
    path : path

    Returns
    -------
    SonarRecord

    Raises
    ------
    OSError
        For a file that cannot be opened.
    bathyal.Error
        For a file of another format, or a broken one.
    """
    if Path(path).is_dir():
        return RecordStore(Path(path)).record()
    data = Path(path).read_bytes()
    if is_xtf(data[:16]):
        return record_of_xtf(data)
    raise Error(f"{path}: not a sonar file that is known (XTF)")


def write_sonar(record: SonarRecord, path: str | os.PathLike[str]) -> None:
    """`SonarRecord.write`."""
    suffix = Path(path).suffix.lower()
    if suffix not in _WRITERS:
        raise argument_error("path", "a name that ends in " + " or ".join(_WRITERS), str(path))
    _WRITERS[suffix](record, Path(path))
