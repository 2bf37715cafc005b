# SPDX-License-Identifier: BSD-3-Clause
"""Maps of an arm's reach to and from files."""

from __future__ import annotations

import os
import zipfile
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import ReachMap
from bathyal.io.files import opened, reading, replacing

_FORMAT = "bathyal reach map 1"
_FIELDS = {
    "format": "U",
    "origin": "f",
    "voxel": "f",
    "approach": "f",
    "reached_along": "b",
    "reached": "b",
    "free": "b",
    "manipulability": "f",
    "clearance": "f",
}
_MOST_BYTES = 2**31  # of all arrays together, unpacked
_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}


def write_reach_map(reach: ReachMap, path: str | os.PathLike[str]) -> None:
    """Write a map, the whole file or none of it; the same bytes for the same map.

    Parameters
    ----------
    reach : ReachMap
    path : path
        ``.npz``: numpy's arrays in a zip, by the names of the map's properties.
    """
    fields: dict[str, Any] = {
        name: np.asarray(getattr(reach, name)) for name in _FIELDS if name != "format"
    }
    with replacing(path) as aside, open(aside, "wb") as file:
        np.savez_compressed(file, format=np.array(_FORMAT), **fields)


def read_reach_map(path: str | os.PathLike[str]) -> ReachMap:
    """Read a map that `ReachMap.save` wrote.

    Nothing in the file is run, and no array is unpacked that is larger than it may be.

    Parameters
    ----------
    path : path

    Returns
    -------
    ReachMap

    Raises
    ------
    bathyal.Error
        For a file that is truncated, no map, of another version, or more than 2 GiB unpacked.
    """
    with opened(path) as (file, _), reading(path, "reach map"):
        fields = _read_fields(file)
        return ReachMap(**{**fields, "voxel": float(fields["voxel"])})  # type: ignore[arg-type]


def _read_fields(file: IO[bytes]) -> dict[str, NDArray[np.generic]]:
    with zipfile.ZipFile(file) as archive:
        members = {info.filename: info for info in archive.infolist()}
        if set(members) != {f"{name}.npy" for name in _FIELDS}:
            raise ValueError("other arrays than those of a map")
        if sum(info.file_size for info in members.values()) > _MOST_BYTES:
            raise ValueError("arrays of more than 2 GiB")
        found = {
            name: _read_array(archive, members[f"{name}.npy"], kind)
            for name, kind in _FIELDS.items()
        }
    if str(found.pop("format")) != _FORMAT:
        raise ValueError(f"expected the format {_FORMAT!r}")
    return found


def _read_array(archive: zipfile.ZipFile, info: zipfile.ZipInfo, kind: str) -> NDArray[np.generic]:
    """An array of a kind of numbers, whose header has been compared with its size first."""
    with archive.open(info) as member:
        version = np.lib.format.read_magic(member)
        if version not in _HEADERS:
            raise ValueError(f"{info.filename}: version {version}")
        shape, _, dtype = _HEADERS[version](member)
        if dtype.hasobject or dtype.kind != kind:
            raise ValueError(f"{info.filename}: numbers of another kind, {dtype}")
        count = 1
        for size in shape:
            count *= int(size)
        if count * dtype.itemsize + member.tell() != info.file_size:
            raise ValueError(f"{info.filename}: another size than its header has")
    with archive.open(info) as member:
        return np.asarray(np.lib.format.read_array(member, allow_pickle=False))
