# SPDX-License-Identifier: BSD-3-Clause
"""Tool paths to files: rows for a controller, JSON for a program, VTP for ParaView."""

from __future__ import annotations

import os
from collections.abc import Mapping
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bathyal.errors import argument_error
from bathyal.io.files import replacing
from bathyal.io.formats.vtp.writer import write_vtp
from bathyal.io.json import json_text
from bathyal.io.tables import write_table

if TYPE_CHECKING:
    from bathyal._core import Targets, ToolPath

_AXES = ("x", "y", "z")

# Every array of a path: its name, its unit as it is written in a column's name, its parts.
_COLUMNS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("position", "m", _AXES),
    ("quaternion", "", (*_AXES, "w")),
    ("time", "s", ()),
    ("arc_length", "m", ()),
    ("segment", "", ()),
    ("gap", "", ()),
    ("approach", "", _AXES),
    ("travel", "", _AXES),
    ("side", "", _AXES),
    ("surface", "m", _AXES),
    ("normal_std", "rad", ()),
    ("crossing", "", ()),
    ("contact", "", ()),
    ("mesh", "", ()),
    ("triangle", "", ()),
)
_TARGET_COLUMNS = (
    ("status", "", ()),
    ("point", "m", _AXES),
    ("normal", "", _AXES),
    ("range", "m", ()),
    ("incidence", "rad", ()),
    ("mesh", "", ()),
    ("triangle", "", ()),
    ("barycentric", "", ("u", "v", "w")),
)


def write_path(path: ToolPath, filename: str | os.PathLike[str], **provenance: Any) -> None:
    """Write a tool path; every number keeps its full double precision.

    Parameters
    ----------
    path : ToolPath
    filename : path
        ``.csv``: one row a sample, units in the names of the columns, notes in lines that begin
        with ``#``. ``.json``: path, targets and provenance; what is not finite is null. ``.vtp``:
        polylines parted at gaps, with the vectors as point data, for ParaView. The file appears
        whole or not at all.
    **provenance
        What rides along: ``crs`` and ``vertical_datum`` in all three, and anything else that JSON
        can hold in ``.json``.

    Raises
    ------
    ValueError
        For another suffix.
    OSError
        Where the file cannot be written.

    Examples
    --------
    >>> import bathyal, tempfile
    >>> aims = [[0, 0, 0, 0, 0, -1], [2, 0, 0, 0, 0, -1]]
    >>> path = bathyal.plan_toolpath(bathyal.Plane((0, 0, 1), -5.0), aims)
    >>> file = tempfile.mkdtemp() + "/path.csv"
    >>> write_path(path, file, crs="EPSG:32602")
    >>> open(file).read().splitlines()[:2]
    ['# tool path in metres, z up', '# crs EPSG:32602']
    """
    suffix = Path(filename).suffix.lower()
    if suffix not in _WRITERS:
        raise argument_error("filename", "a .csv, .json or .vtp file", os.fspath(filename))
    _WRITERS[suffix](path, filename, provenance)


def path_columns(path: ToolPath) -> dict[str, NDArray[Any]]:
    """One array (M,) for each column of the .csv, by its name: ``position_x_m``, ``time_s``, …"""
    return _flat(path, _COLUMNS)


def target_columns(targets: Targets) -> dict[str, NDArray[Any]]:
    """One array (K,) for each number of a target, by its name: ``status``, ``point_x_m``, …"""
    return _flat(targets, _TARGET_COLUMNS)


def _flat(
    source: Any, columns: tuple[tuple[str, str, tuple[str, ...]], ...]
) -> dict[str, NDArray[Any]]:
    flat: dict[str, NDArray[Any]] = {}
    for name, unit, parts in columns:
        values = np.asarray(getattr(source, name))
        tail = f"_{unit}" if unit else ""
        if not parts:
            flat[name + tail] = values
        for part, column in zip(parts, values.T if parts else (), strict=True):
            flat[f"{name}_{part}{tail}"] = column
    return flat


def _write_csv(
    path: ToolPath, filename: str | os.PathLike[str], provenance: Mapping[str, Any]
) -> None:
    columns = path_columns(path)
    notes = ["tool path in metres, z up", *_datum_notes(provenance)]
    as_numbers = (
        values.astype(np.int8) if values.dtype == bool else values for values in columns.values()
    )
    rows = zip(*(values.tolist() for values in as_numbers), strict=True)
    write_table(filename, columns, rows, comments=notes)


def _write_json(
    path: ToolPath, filename: str | os.PathLike[str], provenance: Mapping[str, Any]
) -> None:
    content = {
        "format": "bathyal tool path",
        "version": version("bathyal"),
        "conventions": {
            "position": "tool centre point [m], z up",
            "approach": "a, unit, out of the bottom; the tool's z is -a",
            "travel": "n, unit, along the travel",
            "side": "b = a x n",
            "quaternion": "x y z w of the rotation with columns n, -b, -a",
            "gap": "the stretch from this sample to the next crosses a gap of the bottom",
        },
        **provenance,
        "warnings": provenance.get("warnings", list(path.warnings)),
        "targets": target_columns(path.targets),
        "path": path_columns(path),
    }
    with replacing(filename) as aside:
        aside.write_text(json_text(content), encoding="utf-8")


def _write_vtp(
    path: ToolPath, filename: str | os.PathLike[str], provenance: Mapping[str, Any]
) -> None:
    ends = np.flatnonzero(np.asarray(path.gap)) + 1
    lines = [run.tolist() for run in np.split(np.arange(len(path.position)), ends)]
    write_vtp(
        filename,
        path.position,
        lines=[run for run in lines if len(run) > 1] or None,
        vertices=[run[0] for run in lines if len(run) == 1] or None,
        point_data={name: getattr(path, name) for name, _, _ in _COLUMNS if name != "position"},
        field_data={name: provenance[name] for name in _DATUM if provenance.get(name)},
    )


_WRITERS = {".csv": _write_csv, ".json": _write_json, ".vtp": _write_vtp}
_DATUM = ("crs", "vertical_datum")


def _datum_notes(provenance: Mapping[str, Any]) -> list[str]:
    """Each on one line: WKT may come on several."""
    return [
        f"{name} {' '.join(provenance[name].split())}" for name in _DATUM if provenance.get(name)
    ]
