# SPDX-License-Identifier: BSD-3-Clause
"""Arrays in folders as Zarr's version 2 lays them out: chunks along the first axis.

A chunk is a file that is put in place in one step, so that whatever ends a process leaves whole
chunks, and several processes fill one array. Chunks are raw or deflated; `zarr`, xarray and others
open them.
"""

from __future__ import annotations

import json
import os
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import DTypeLike, NDArray

from bathyal._core import Error, check_bytes
from bathyal.io.files import reading, shown
from bathyal.io.regular_files import open_regular

_TYPES = ("<f4", "<f8", "<i4")
_LEVEL = 1  # of zlib


@dataclass(frozen=True)
class ArrayLayout:
    """How an array lies in its folder."""

    shape: tuple[int, ...]
    chunk: int
    """Rows of a chunk."""
    dtype: np.dtype[Any]
    fill: float | int
    """Of rows that are not there."""
    deflated: bool = False

    @property
    def chunks(self) -> int:
        """How many there are."""
        return -(-self.shape[0] // self.chunk)

    @property
    def chunk_shape(self) -> tuple[int, ...]:
        """Of each, the last one too."""
        return (self.chunk, *self.shape[1:])

    def name(self, chunk: int) -> str:
        """Of a chunk's file."""
        return ".".join([str(chunk), *("0" for _ in self.shape[1:])])

    def empty(self, rows: int) -> NDArray[Any]:
        """Rows that are not there."""
        shape = (rows, *self.shape[1:])
        if self.dtype.kind == "S":
            return np.zeros(shape, self.dtype)
        return np.full(shape, self.fill, self.dtype)

    def metadata(self) -> dict[str, Any]:
        """As in ``.zarray``."""
        fill = "" if self.dtype.kind == "S" else "NaN" if np.isnan(self.fill) else self.fill
        return {
            "chunks": list(self.chunk_shape),
            "compressor": {"id": "zlib", "level": _LEVEL} if self.deflated else None,
            "dtype": self.dtype.str,
            "fill_value": fill,
            "filters": None,
            "order": "C",
            "shape": list(self.shape),
            "zarr_format": 2,
        }


def read_layout(folder: Path) -> ArrayLayout:
    """The layout of an array's folder.

    Raises
    ------
    Error
        For what is no array of version 2, or one of another kind than are written here.
    """
    path = folder / ".zarray"
    content = read_json(path)
    with reading(path, "Zarr"):
        dtype, shape, chunks = content["dtype"], content["shape"], content["chunks"]
        whole = all(isinstance(n, int) and 0 <= n < 2**40 for n in [*shape, *chunks])
        if not whole or len(shape) == 0 or len(chunks) != len(shape) or chunks[0] == 0:
            raise Error(f"not a shape and its chunks: {shape!r:.60}, {chunks!r:.60}")
        if chunks[1:] != shape[1:]:
            raise Error("expected chunks along the first axis only")
        if dtype not in _TYPES and not (str(dtype)[:2] == "|S" and str(dtype)[2:].isdigit()):
            raise Error(f"values of the type {dtype!r:.20}")
        compressor = content["compressor"]
        if content["zarr_format"] != 2 or content["order"] != "C" or content["filters"]:
            raise Error("expected version 2 of Zarr, in the order C and without filters")
        if compressor is not None and compressor["id"] != "zlib":
            raise Error(f"expected chunks that are raw or of zlib, got {compressor['id']!r:.20}")
        fill = content["fill_value"]
        layout = ArrayLayout(
            tuple(shape), chunks[0], np.dtype(dtype),
            np.nan if fill == "NaN" else 0 if not isinstance(fill, int | float) else fill,
            compressor is not None,
        )  # fmt: skip
        check_bytes(
            "a chunk", int(np.prod(layout.chunk_shape, dtype=float) * layout.dtype.itemsize)
        )
    return layout


def read_json(path: Path) -> dict[str, Any]:
    """An object of JSON, of no more than some megabytes."""
    with open_regular(path) as (stream, size), reading(path, "JSON"):
        if size > 1 << 24:
            raise Error(f"expected at most 16 MiB, got {size} bytes")
        content = json.loads(stream.read(size))
        if not isinstance(content, dict):
            raise Error("expected an object")
        return content


def write_whole(path: Path, data: bytes) -> None:
    """A file, whole or not at all.

    Raises
    ------
    OSError
        That names it.
    """
    aside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        aside.write_bytes(data)
        os.replace(aside, path)
    except OSError as error:
        aside.unlink(missing_ok=True)
        raise OSError(error.errno, f"cannot write, {error.strerror}", os.fspath(path)) from None


def write_chunk(folder: Path, layout: ArrayLayout, chunk: int, rows: NDArray[Any]) -> None:
    """The rows of a chunk; after the array's end it is filled up."""
    whole = layout.empty(layout.chunk)
    whole[: len(rows)] = rows
    data = whole.tobytes()
    write_whole(
        folder / layout.name(chunk), zlib.compress(data, _LEVEL) if layout.deflated else data
    )


def read_chunk(folder: Path, layout: ArrayLayout, chunk: int) -> NDArray[Any]:
    """A chunk's rows; those of a chunk that is not there are `ArrayLayout.fill`.

    Raises
    ------
    Error
        For a file of another size.
    """
    path = folder / layout.name(chunk)
    size = int(np.prod(layout.chunk_shape)) * layout.dtype.itemsize
    try:
        with open_regular(path) as (stream, _), reading(path, "Zarr chunk"):
            data = stream.read(size + 1 if not layout.deflated else -1)
            if layout.deflated:
                data = zlib.decompressobj().decompress(data, size + 1)
    except FileNotFoundError:
        return layout.empty(layout.chunk)
    if len(data) != size:
        raise Error(f"{shown(path)}: expected a chunk of {size} bytes, got {len(data)}")
    return np.frombuffer(data, layout.dtype).reshape(layout.chunk_shape)


class StoredArray(NDArrayOperatorsMixin):
    """An array that lies on disk: indexing reads the rows that are asked for, ``np.asarray`` all.

    Parameters
    ----------
    folder : path
    rows : (P,) array, optional
        Which rows of it; all unless given.
    """

    def __init__(self, folder: Path, rows: NDArray[np.int64] | None = None) -> None:
        self._folder = folder
        self._layout = read_layout(folder)
        self._rows = np.arange(self._layout.shape[0]) if rows is None else rows
        self._last: tuple[int, NDArray[Any]] | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the array."""
        return (len(self._rows), *self._layout.shape[1:])

    @property
    def dtype(self) -> np.dtype[Any]:
        """Of its values."""
        return self._layout.dtype

    @property
    def ndim(self) -> int:
        """Axes."""
        return len(self._layout.shape)

    @property
    def size(self) -> int:
        """Values."""
        return int(np.prod(self.shape))

    def __len__(self) -> int:
        return len(self._rows)

    def __repr__(self) -> str:
        return f"StoredArray({self.shape}, {self.dtype}, {shown(self._folder)})"

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        if copy is False:
            raise ValueError("a stored array is read from disk: it cannot be had without a copy")
        return self._read(np.arange(len(self))).astype(dtype or self.dtype, copy=False)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        arrays = [np.asarray(x) if isinstance(x, StoredArray) else x for x in inputs]
        return getattr(ufunc, method)(*arrays, **options)

    def __getitem__(self, key: Any) -> Any:
        keys = list(key) if isinstance(key, tuple) else [key]
        for at, one in enumerate(keys):
            if one is Ellipsis:
                keys[at : at + 1] = [slice(None)] * (self.ndim - len(keys) + 1)
                break
        first, *rest = keys or [slice(None)]
        if any(one is None for one in keys):
            return np.asarray(self)[key]
        wanted = np.arange(len(self))[first]
        if isinstance(first, slice):
            return self._read(wanted)[(slice(None), *rest)]
        needed, places = np.unique(wanted, return_inverse=True)
        place: Any = (
            int(places.reshape(-1)[0]) if np.ndim(wanted) == 0 else places.reshape(np.shape(wanted))
        )
        return self._read(needed)[(place, *rest)]

    def _read(self, wanted: NDArray[np.int64]) -> NDArray[Any]:
        """Rows in the order that is asked for."""
        found = np.empty((len(wanted), *self.shape[1:]), self.dtype)
        rows = self._rows[wanted]
        for chunk in np.unique(rows // self._layout.chunk):
            here = rows // self._layout.chunk == chunk
            found[here] = self._chunk(int(chunk))[rows[here] % self._layout.chunk]
        return found

    def _chunk(self, chunk: int) -> NDArray[Any]:
        """The last one is kept, for who goes through the rows one by one."""
        if self._last is None or self._last[0] != chunk:
            self._last = (chunk, read_chunk(self._folder, self._layout, chunk))
        return self._last[1]


def write_group(folder: Path, attributes: Mapping[str, Any], arrays: Mapping[str, Any]) -> None:
    """The metadata of a group of arrays: layouts and attributes by name, and all of it once more
    in one file, from which xarray reads it.

    Parameters
    ----------
    folder : path
    attributes : mapping
        Of the group.
    arrays : mapping of name to (ArrayLayout, mapping)
    """
    files: dict[str, Any] = {".zgroup": {"zarr_format": 2}, ".zattrs": dict(attributes)}
    for name, (layout, notes) in arrays.items():
        files[f"{name}/.zarray"] = cast(ArrayLayout, layout).metadata()
        files[f"{name}/.zattrs"] = dict(notes)
    for name in arrays:
        (folder / name).mkdir(parents=True, exist_ok=True)
    together = {"metadata": files, "zarr_consolidated_format": 1}
    for name, content in [*files.items(), (".zmetadata", together)]:
        text = json.dumps(content, indent=1, sort_keys=True, ensure_ascii=False) + "\n"
        write_whole(folder / name, text.encode())
