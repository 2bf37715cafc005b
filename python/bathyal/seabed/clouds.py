# SPDX-License-Identifier: BSD-3-Clause
"""Soundings from and to files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal import _core
from bathyal._core import PointCloud
from bathyal.arrays import unmasked
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, known_suffix, opened, reading
from bathyal.io.formats.attributes import canonical_attributes, columns_of
from bathyal.io.formats.crs import check_metric, check_scale, units_of
from bathyal.io.formats.gsf import read_gsf_soundings
from bathyal.io.formats.meshes.ply import read_ply, write_ply
from bathyal.io.formats.notes import notes_of, notes_of_fields
from bathyal.io.formats.points.bag import read_bag
from bathyal.io.formats.points.geotiff import read_geotiff
from bathyal.io.formats.points.las import read_las
from bathyal.io.formats.points.soundings import Soundings
from bathyal.io.formats.points.text import Columns, read_text, write_text
from bathyal.io.formats.vtp.reader import read_vtp
from bathyal.io.formats.vtp.writer import write_vtp

_TEXT = (".asc", ".csv", ".txt", ".xyz")
_GRIDS = (".tif", ".tiff")


def read_cloud(
    path: PathLike,
    *,
    columns: Columns | None = None,
    scale: float | Sequence[float] | None = None,
    z: str | None = None,
    band: int | None = None,
    crs: str | None = None,
    vertical_datum: str | None = None,
    **text: Any,
) -> PointCloud:
    """Read soundings.

    Parameters
    ----------
    path : path
        Text in columns or an ESRI grid (``.xyz .txt .csv .asc``), ``.ply``, ``.pcd``, ``.las``,
        ``.laz``, ``.vtp``, BAG (``.bag``), GeoTIFF (``.tif .tiff``) or GSF (``.gsf``).
    columns : sequence of int or str, or dict, optional
        For text: where x, y, z are, and after them what rides along, by number from 0 or by name;
        or a dict of names to columns with ``x``, ``y`` and ``z`` among them. By default found by
        the names in the file (x, easting, …, z, elevation, height, depth), else the first three;
        all further columns ride along.
    scale : float or three of them, optional
        Metres in one unit of the file, of all coordinates or of x, y and z; `uncertainty` is
        scaled as z is. To be said where the file, or its reference system, names a unit other
        than the metre.
    z : {"up", "down"}, optional
        Which way z grows in the file. Up by default, but a file that calls it a depth needs
        this argument: "down" turns the sign, "up" says that its depths are negative already.
    band : int, optional
        For GeoTIFF: the band of heights, counted from 1; the first by default.
    crs, vertical_datum : str, optional
        Coordinate reference system, in metres, and vertical datum, in place of what the file says.
    **text
        For text: ``separator``, ``decimal``, ``comments``, ``header_lines``, ``skip_lines``,
        ``empty_is_nan``, ``num_threads``.

    Returns
    -------
    PointCloud
        [m], z up, in double, in the order of the file (grids row by row from the north). Cells
        without data are left out. A reference system in another unit than the metre is not kept:
        the points are no longer in it. Attributes ride along: ``uncertainty`` [m], ``intensity``,
        ``classification``, ``red``, ``green``, ``blue`` (0 to 255), others by the file's name.
        Points that are not finite are kept for `clean_cloud` to count.

    Raises
    ------
    ValueError
        For a suffix that is not read, a keyword of another format, columns that the file lacks, a
        depth whose direction is not said, a unit that is not the metre and no `scale`, or a `crs`
        that is not in metres.
    OSError
        Where there is no such file, or it may not be read.
    Error
        For a file that is broken, empty, or of another format than its suffix says, for positions
        in longitude and latitude, and where the library for a format is not installed.

    Examples
    --------
    >>> import bathyal, tempfile
    >>> path = tempfile.mkdtemp() + "/line.csv"
    >>> _ = open(path, "w").write("easting,northing,depth\\n620153.873,7246503.912,51.987\\n")
    >>> bathyal.read_cloud(path, z="down").points.tolist()
    [[620153.873, 7246503.912, -51.987]]
    """
    suffix = known_suffix(path, (*_TEXT, *_GRIDS, *_READERS), "point")
    _check_keywords(suffix, columns, band, text)
    if z not in (None, "up", "down"):
        raise argument_error("z", '"up" or "down"', repr(z))
    factors = _factors(scale)
    if crs is not None:
        check_metric("crs", crs)
    if suffix in _TEXT:
        with opened(path):
            soundings = read_text(path, columns, text)
    elif suffix in _GRIDS:
        soundings = read_geotiff(path, band)
    else:
        soundings = _READERS[suffix](path)
    if soundings.depth and z is None:
        raise argument_error(
            "z",
            f'"down" where depths are positive or "up" where they are negative, for the file '
            f"calls it {soundings.depth!r}",
            z,
        )
    if soundings.unit and scale is None:
        raise argument_error(
            "scale", f"metres in one unit of the file, for it names {soundings.unit!r}", scale
        )
    with reading(path, "point"):
        units = soundings.units or units_of(soundings.crs, soundings.vertical_datum)
    check_scale(units, scale)
    file_crs = soundings.crs if units.metric else ""
    with reading(path, "point"):
        return PointCloud(
            _in_metres(soundings.points, factors, z),
            attributes=_attributes(soundings, factors[2]),
            crs=file_crs if crs is None else crs,
            vertical_datum=soundings.vertical_datum if vertical_datum is None else vertical_datum,
        )


def write_cloud(cloud: PointCloud, path: PathLike) -> None:
    """Write soundings.

    Parameters
    ----------
    cloud : PointCloud
    path : path
        ``.ply`` and ``.vtp`` (binary), ``.xyz``, ``.txt`` (blanks between columns) or ``.csv``:
        each keeps coordinates and attributes in full double, the coordinate reference system and
        the vertical datum. The file appears whole or not at all.

    Raises
    ------
    ValueError
        For a suffix that is not written.
    OSError
        Where the file cannot be written.

    Examples
    --------
    >>> import bathyal, tempfile
    >>> path = tempfile.mkdtemp() + "/line.xyz"
    >>> cloud = bathyal.PointCloud([[620153.873, 7246503.912, -51.987]], crs="EPSG:32602")
    >>> bathyal.write_cloud(cloud, path)
    >>> print(open(path).read().rstrip())
    # metres, z up
    # crs EPSG:32602
    # x y z
    620153.873 7246503.912 -51.987
    """
    _WRITERS[known_suffix(path, _WRITERS, "point")](cloud, path)


def _check_keywords(
    suffix: str, columns: Columns | None, band: int | None, text: Mapping[str, Any]
) -> None:
    for name in (["columns"] if columns is not None else []) + list(text):
        if suffix not in _TEXT:
            raise argument_error(name, "with text files only", f"it with {suffix}")
    if unknown := set(text) - _TEXT_KEYWORDS:
        name = min(unknown)
        known = ", ".join(sorted(_TEXT_KEYWORDS))
        raise argument_error(name, f"a keyword of read_cloud or one of {known}", repr(name))
    if band is not None and suffix not in _GRIDS:
        raise argument_error("band", "with GeoTIFF only", f"it with {suffix}")


_TEXT_KEYWORDS = {
    "separator", "decimal", "comments", "header_lines", "skip_lines", "empty_is_nan", "num_threads",
}  # fmt: skip


def _factors(scale: float | Sequence[float] | None) -> NDArray[np.float64]:
    try:
        factors = unmasked("scale", 1.0 if scale is None else scale).astype(np.float64)
    except (TypeError, ValueError):
        factors = np.empty(0)
    if factors.shape not in ((), (3,)) or not np.all((factors > 0) & np.isfinite(factors)):
        raise argument_error("scale", "one or three finite numbers above 0", repr(scale))
    return np.broadcast_to(factors, (3,))


def _in_metres(
    points: NDArray[np.float64], factors: NDArray[np.float64], z: str | None
) -> NDArray[np.float64]:
    signed = factors * [1.0, 1.0, -1.0 if z == "down" else 1.0]
    return points if np.all(signed == 1.0) else points * signed


def _attributes(soundings: Soundings, z_factor: float) -> dict[str, NDArray[np.float64]]:
    attributes = canonical_attributes(soundings.attributes)
    if "uncertainty" in attributes and z_factor != 1.0:
        attributes["uncertainty"] = attributes["uncertainty"] * z_factor
    return attributes


def _read_ply(path: PathLike) -> Soundings:
    ply = read_ply(path)
    notes = notes_of_fields(ply.notes)
    return Soundings(ply.points, dict(ply.attributes), notes["crs"], notes["vertical_datum"])


def _read_pcd(path: PathLike) -> Soundings:
    with opened(path):
        cloud = _core.read_pcd(path)
    return Soundings(cloud.points, dict(cloud.attributes))


def _read_vtp(path: PathLike) -> Soundings:
    data = read_vtp(path)
    notes = notes_of_fields(data.field_data)
    attributes = columns_of(data.point_data)
    return Soundings(data.points, attributes, notes["crs"], notes["vertical_datum"])


def _write_ply(cloud: PointCloud, path: PathLike) -> None:
    write_ply(path, cloud.points, attributes=cloud.attributes, notes=notes_of(cloud))


def _write_vtp(cloud: PointCloud, path: PathLike) -> None:
    write_vtp(
        path,
        cloud.points,
        vertices=np.arange(len(cloud)),
        point_data=cloud.attributes,
        field_data=notes_of(cloud),
    )


def _write_columns(cloud: PointCloud, path: PathLike) -> None:
    write_text(path, cloud, separator=" ", notes=notes_of(cloud))


def _write_csv(cloud: PointCloud, path: PathLike) -> None:
    write_text(path, cloud, separator=",", notes=notes_of(cloud))


# Of the formats that take no keyword of their own.
_READERS: dict[str, Callable[[PathLike], Soundings]] = {
    ".bag": read_bag,
    ".gsf": read_gsf_soundings,
    ".las": read_las,
    ".laz": read_las,
    ".pcd": _read_pcd,
    ".ply": _read_ply,
    ".vtp": _read_vtp,
}

_WRITERS: dict[str, Callable[[PointCloud, PathLike], None]] = {
    ".csv": _write_csv,
    ".ply": _write_ply,
    ".txt": _write_columns,
    ".vtp": _write_vtp,
    ".xyz": _write_columns,
}
