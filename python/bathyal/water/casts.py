# SPDX-License-Identifier: BSD-3-Clause
"""Casts from files."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from bathyal._core import Error, Profile
from bathyal.io.files import PathLike, read_document, reading
from bathyal.io.formats.profiles import headed, sectioned, speeds

Reader = Callable[[str, str], Profile]

# A file is known by what it says, not by its ending: the first of these that its text shows.
_FORMATS: tuple[tuple[str, re.Pattern[str], Reader], ...] = (
    ("CastAway", re.compile(r"\A% Device,"), headed.read_castaway),
    ("AML csv", re.compile(r"\A\[cast header\]"), sectioned.read_aml_csv),
    ("AML", re.compile(r"^\[MeasurementMetadata\]", re.M), sectioned.read_aml),
    ("Valeport", re.compile(r"^Title=Valeport|^Instrument=.*SV|^\[Data\]", re.M),
     sectioned.read_valeport),
    ("Sea-Bird cnv", re.compile(r"\A\* Sea-Bird"), headed.read_seabird),
    ("Hypack", re.compile(r"\AFTP NEW "), speeds.read_hypack),
    ("Kongsberg asvp", re.compile(r"\A\( ?SoundVelocity "), speeds.read_asvp),
    ("Sippican", re.compile(r"\A// This is a MK21 EXPORT"), headed.read_sippican),
    ("Oceanscience", re.compile(r"^\*scan# ", re.M), headed.read_oceanscience),
)  # fmt: skip


def read_profile(path: PathLike) -> Profile:
    """Read a cast: sound speed, temperature and salinity by depth.

    The format is known by the content: YSI CastAway (.csv), AML Base.X (.csv) and AML-3 (.aml),
    Valeport (.vpd), Sea-Bird (.cnv), Hypack (.vel), Kongsberg (.asvp), Sippican (.EDF),
    Oceanscience (.asc), or a plain table whose header names ``depth`` (or ``pressure``),
    ``temperature``, ``salinity``, ``sound_speed``, with units in brackets; without a header two
    columns are depth and sound speed.

    Parameters
    ----------
    path : path

    Returns
    -------
    Profile
        Every row of the file, in its order. Depth is computed from pressure (TEOS-10, at the
        cast's latitude, else 45°) and salinity from conductivity (PSS-78) where the file has
        neither; `Profile.source` says so. Times of a file are taken as UTC.

    Raises
    ------
    Error
        For a file that is broken, cut off, binary or of no known format; the text says where.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> file = pathlib.Path(tempfile.mkdtemp()) / "cast.csv"
    >>> _ = file.write_text("depth [m],sound_speed [m/s]\\n0,1502.1\\n12.5,1498.0\\n")
    >>> bathyal.read_profile(file).sound_speed.tolist()
    [1502.1, 1498.0]
    """
    name = Path(path)
    text = _text_of(path)
    for title, pattern, reader in _FORMATS:
        if pattern.search(text):
            with reading(path, f"{title} cast"):
                return reader(text, name.name)
    with reading(path, "cast"):
        return speeds.read_plain(name, name.name)


def _text_of(path: PathLike) -> str:
    """The text of a file, UTF-8 or, as instruments write degrees and cubes, Latin-1."""
    content = read_document(path)
    if b"\0" in content or sum(byte < 9 or 13 < byte < 32 for byte in content[:4096]) > 4:
        raise Error(f"{path}: expected the text of a cast, got binary data")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")
