# SPDX-License-Identifier: BSD-3-Clause
"""LAS and LAZ, through laspy."""

from __future__ import annotations

import math
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, check_bytes
from bathyal.io.files import PathLike, need, opened, reading
from bathyal.io.formats.crs import Unit, Units, refuse_degrees, units_of, vertical_datum_of_wkt
from bathyal.io.formats.points.laz import check_chunks
from bathyal.io.formats.points.soundings import Soundings

_BYTES_AT_A_TIME = 1 << 25
_KEPT = ("intensity", "classification", "gps_time")
_COLOURS = ("red", "green", "blue")
_USER_DEFINED = 32767  # a reference system without a number
_COMPRESSED = 0x80  # in the number of the point format
# Of the GeoTIFF directory.
_MODEL_KEY, _GEOGRAPHIC_MODELS = 1024, (2, 3)
_PROJECTED_KEY, _GEOGRAPHIC_KEY, _VERTICAL_KEY = 3072, 2048, 4096
_PROJECTED_UNIT_KEY, _VERTICAL_UNIT_KEY = 3076, 4099
_UNITS = {
    9001: Unit("metre", 1.0), 9002: Unit("foot", 0.3048), 9003: Unit("US survey foot", 1200 / 3937),
    9036: Unit("kilometre", 1000.0),
}  # fmt: skip
_EXTENDED_RECORD = 60  # bytes of its header


def read_las(path: PathLike) -> Soundings:
    """Points with intensity, classification, time, colours and what the file adds as extra bytes.

    Colours of 16 bits are brought to 0 to 255; files that hold 8-bit ones, against the format, are
    known by having none above 255.
    """
    laspy = need("laspy", "laspy[lazrs]", "reading LAS and LAZ")
    with opened(path) as (stream, size), reading(path, "LAS"):
        count, record, first_point = _check_header(head := stream.read(375), size)
        if head[104] & _COMPRESSED:
            check_chunks(stream, size, first_point, record, count)
        stream.seek(0)
        # The parallel decompressor takes memory for whatever the table of chunks says.
        backend = laspy.LazBackend.Lazrs
        with laspy.open(stream, closefd=False, laz_backend=backend) as reader:
            names = _names(reader.header.point_format)
            check_bytes(f"its {count} points", 8 * (3 + len(names)) * count)
            at_a_time = max(1, _BYTES_AT_A_TIME // record)
            chunks = [
                [np.asarray(chunk[name], np.float64) for name in ("x", "y", "z", *names)]
                for chunk in reader.chunk_iterator(at_a_time)
            ]
            reference = _reference([*reader.header.vlrs, *(reader.header.evlrs or [])])
        columns = [np.concatenate(parts) for parts in zip(*chunks, strict=True)]
        if len(columns[0] if columns else []) != count:
            raise Error(
                f"its header announces {count} points, "
                f"{len(columns[0] if columns else [])} are there"
            )
        points = np.column_stack(columns[:3]) if columns else np.empty((0, 3))
        attributes = dict(zip(names, columns[3:], strict=True)) if columns else {}
        crs, vertical, units = reference
        return Soundings(points, _with_byte_colours(attributes), crs, vertical, units=units)


def _check_header(head: bytes, size: int) -> tuple[int, int, int]:
    """How many points are announced, the bytes of one, and where the first one is."""
    if len(head) < 227 or head[:4] != b"LASF":
        raise Error("it does not start with a LAS header")
    first_point, variable_records, point_format, record, count = struct.unpack_from(
        "<IIBHI", head, 96
    )
    if head[24:26] >= b"\x01\x04" and len(head) >= 255:
        extended_at, extended, count = struct.unpack_from("<QIQ", head, 235)
        if extended and extended_at + _EXTENDED_RECORD * extended > size:
            raise Error(f"its header announces {extended} extended records beyond its end")
    compressed = point_format & _COMPRESSED
    # LAZ makes at best some hundred points of a byte (equal points, an adaptive range coder)
    least = count // 1000 if compressed else count * record
    if first_point + least > size or first_point + 54 * variable_records > size + first_point:
        raise Error(
            f"its header announces {count} points of {record} bytes and {variable_records} "
            f"records, too many for {size} bytes"
        )
    if record < 20:
        raise Error(f"its points have {record} bytes, at least 20 are needed")
    return count, record, first_point


def _names(point_format: Any) -> list[str]:
    there = set(point_format.dimension_names)
    extra = [d.name for d in point_format.extra_dimensions if d.num_elements == 1]
    colours = _COLOURS if there.issuperset(_COLOURS) else ()
    return [name for name in _KEPT if name in there] + [*colours, *extra]


def _with_byte_colours(attributes: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    colours = [attributes[name] for name in _COLOURS if name in attributes]
    if any(np.any(colour > 255) for colour in colours):
        attributes |= {name: attributes[name] / 257 for name in _COLOURS}
    return attributes


def _reference(records: Any) -> tuple[str, str, Units]:
    """WKT where the file has it, else "EPSG:…" from its GeoTIFF keys; and their units."""
    projection = {
        r.record_id: r.record_data_bytes()
        for r in records
        if r.user_id.strip("\0 ") == "LASF_Projection"
    }
    if 2112 in projection:
        wkt = projection[2112].rstrip(b"\0").decode("utf-8", "replace")
        return wkt, vertical_datum_of_wkt(wkt), units_of(wkt)
    directory = projection.get(34735, b"")
    shorts = np.frombuffer(directory[: len(directory) // 8 * 8], "<u2").reshape(-1, 4)[1:]
    keys = {int(key): int(value) for key, where, _, value in shorts if where == 0}
    geographic = keys.get(_GEOGRAPHIC_KEY) and not keys.get(_PROJECTED_KEY)
    if geographic or keys.get(_MODEL_KEY) in _GEOGRAPHIC_MODELS:
        refuse_degrees(f"EPSG:{keys.get(_GEOGRAPHIC_KEY, 0)}")
    codes = [keys.get(key, 0) for key in (_PROJECTED_KEY, _VERTICAL_KEY)]
    horizontal, vertical = (
        f"EPSG:{code}" if 1024 <= code < _USER_DEFINED else "" for code in codes
    )
    units = units_of(horizontal, vertical)
    return (
        horizontal,
        vertical,
        Units(
            _unit(keys.get(_PROJECTED_UNIT_KEY), units.horizontal),
            _unit(keys.get(_VERTICAL_UNIT_KEY), units.vertical),
        ),
    )


def _unit(key: int | None, of_code: Unit | None) -> Unit | None:
    """The unit that a key names, else that of the system's code."""
    return of_code if not key else _UNITS.get(key, Unit(f"the unit EPSG:{key}", math.nan))
