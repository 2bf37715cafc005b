# SPDX-License-Identifier: BSD-3-Clause
"""What a LAZ file announces, checked before the decompressor takes memory for it."""

from __future__ import annotations

import struct
from itertools import pairwise
from typing import BinaryIO

import numpy as np

from bathyal._core import Error
from bathyal.io.files import need

# Of the layered compressors (LAS 1.4): how many layers an item of that type has, by its number;
# those of extra bytes (14) have one a byte.
_LAYERS = {10: 9, 11: 1, 12: 2, 13: 1}
_EXTRA_BYTES = 14
_LAYERED = 3  # the compressor's number


def check_chunks(stream: BinaryIO, size: int, first_point: int, record: int, count: int) -> None:
    """Raise `Error` where the chunks, or the layers in one, are larger than the file.

    The decompressor takes memory for as many chunks as the table announces (each holds a point at
    least), and for layers as long as each chunk announces.
    """
    lazrs = need("lazrs", "laspy[lazrs]", "reading LAZ")
    laspy = need("laspy", "laspy[lazrs]", "reading LAZ")
    _check_table(stream, size, first_point, record)
    stream.seek(0)
    records = laspy.LasHeader.read_from(stream).vlrs.get("LasZipVlr")
    if not records:
        raise Error("its points are compressed, but nothing says how")
    content = bytes(records[0].record_data)
    stream.seek(first_point)
    table = lazrs.read_chunk_table(stream, lazrs.LazVlr(content))
    starts = first_point + 8 + np.cumsum([0, *(byte_count for _, byte_count in table)])
    if int(starts[-1]) > size or np.any(np.diff(starts) < 0):
        raise Error(f"its chunks end at byte {int(starts[-1])} of {size}: it is cut short")
    if sum(point_count for point_count, _ in table) < count:
        raise Error(f"its chunks hold fewer than the {count} points announced: it is cut short")
    layers = _layer_count(content)
    for start, end in pairwise(starts.tolist() if layers else []):
        stream.seek(start + record + 4)  # a first point, and how many there are
        lengths = np.frombuffer(stream.read(4 * layers), "<u4")
        if len(lengths) < layers or int(lengths.sum(dtype=np.uint64)) > end - start:
            raise Error(f"the layers of the chunk at byte {start} are longer than it is")


def _check_table(stream: BinaryIO, size: int, first_point: int, record: int) -> None:
    """Where the points start, or at the end of the file, is the offset of the table of chunks."""
    stream.seek(first_point)
    where = int.from_bytes(stream.read(8), "little", signed=True)
    if where == -1:
        stream.seek(size - 8)
        where = int.from_bytes(stream.read(8), "little", signed=True)
    if not first_point + 8 <= where <= size - 8:
        raise Error("the table of its chunks is not in the file: it is cut short")
    stream.seek(where + 4)  # a version, and how many there are
    chunks = int.from_bytes(stream.read(4), "little")
    if chunks * record > size:
        raise Error(f"it announces {chunks} chunks, too many for {size} bytes")


def _layer_count(content: bytes) -> int:
    """Layers of a chunk, 0 for compressors that have none."""
    compressor, items = struct.unpack_from("<H30xH", content)
    if compressor != _LAYERED:
        return 0
    kinds = [struct.unpack_from("<HH", content, 34 + 6 * i) for i in range(items)]
    return sum(length if kind == _EXTRA_BYTES else _LAYERS.get(kind, 0) for kind, length in kinds)
