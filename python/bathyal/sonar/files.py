# SPDX-License-Identifier: BSD-3-Clause
"""Records from and to files, by format."""

from __future__ import annotations

import os
from pathlib import Path

from bathyal._core import Error
from bathyal.errors import argument_error
from bathyal.sonar.record import SonarRecord
from bathyal.sonar.xtf import is_xtf, record_of_xtf, xtf_of_record

_WRITERS = {".xtf": xtf_of_record}


def read_sonar(path: str | os.PathLike[str]) -> SonarRecord:
    """Reads what a sonar recorded, by the file's content: XTF.

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
    data = Path(path).read_bytes()
    if is_xtf(data[:16]):
        return record_of_xtf(data)
    raise Error(f"{path}: not a sonar file that is known (XTF)")


def write_sonar(record: SonarRecord, path: str | os.PathLike[str]) -> None:
    """`SonarRecord.write`."""
    suffix = Path(path).suffix.lower()
    if suffix not in _WRITERS:
        raise argument_error("path", "a name that ends in " + " or ".join(_WRITERS), str(path))
    Path(path).write_bytes(_WRITERS[suffix](record))
