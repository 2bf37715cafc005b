# SPDX-License-Identifier: BSD-3-Clause
"""glTF (`.glb`, `.gltf`) and 3DS: every mesh that the scene shows, in its place, by assimp.

assimp is C++ that trusts its files further than this package does: nested deep enough they end the
process. It therefore runs in a process of its own, with bounded memory and time.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, check_bytes
from bathyal.io.files import PathLike, need, opened, reading
from bathyal.io.regular_files import check_document, open_regular

Corners = tuple[NDArray[np.float64], NDArray[Any]]

_FORMATS = {".3ds": "3DS", ".glb": "glTF", ".gltf": "glTF"}
_GROWTH = 64  # bytes of memory for one of the file
_START = 1 << 30  # bytes that the process may take for a file of none
_SECONDS = 60.0  # for a file of none
_BYTES_PER_SECOND = 1e6
_SAID = "': "  # between the file's name and the reason

# assimp hands out y up: of glTF's axes as they are, of 3DS turned from its z up.
_FILE_FROM_SCENE = {
    ".3ds": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    ".glb": np.eye(3),
    ".gltf": np.eye(3),
}


def read_assimp(path: PathLike) -> Corners:
    """Points (N, 3) in the axes and the unit of the file, and triangles (T, 3) of its scene.

    Points are not joined across meshes. A part that a transform mirrors is turned round, so that it
    faces outward as before.

    Raises
    ------
    OSError, Error
        As `opened`; `Error` where the library is missing, and for a file that is broken, shows
        anything but triangles and polygons, or refers to files outside of its folder.
    """
    suffix = Path(path).suffix.lower()
    name = _FORMATS[suffix]
    library = need("assimp_py", "assimp-py", f"reading {name}", extra="meshes")
    with opened(path) as (stream, size), reading(path, name):
        if suffix == ".3ds":
            if stream.read(2) != b"MM":
                raise Error("it does not begin as a 3DS file does")
        else:
            size += _check_gltf(path, stream.read(), binary=suffix == ".glb")
        header, data = _imported(path, size, str(Path(library.__file__).parents[1]))
        points, triangles = _scene(header, data)
        return points @ _FILE_FROM_SCENE[suffix].T + 0.0, triangles


def _check_gltf(path: PathLike, content: bytes, *, binary: bool) -> int:
    """What assimp would not refuse: other formats, and other people's files. Bytes of its files."""
    if binary:
        if content[:4] != b"glTF" or content[16:20] != b"JSON":
            raise Error("it does not begin as a binary glTF file of version 2 does")
        content = content[20 : 20 + int.from_bytes(content[12:16], "little")]
    check_document(path, len(content))
    document = json.loads(content.decode("utf-8-sig"))
    version = str(document["asset"]["version"])
    if not version.startswith("2."):
        raise Error(f"expected glTF of version 2, got {version!r}")
    folder = Path(path).resolve().parent
    size = 0
    for buffer in document.get("buffers", []):
        uri = buffer.get("uri", "data:")
        if uri.startswith("data:"):
            continue
        if "%" in uri:  # assimp would look for a file of that very name
            raise Error(f"its buffer {uri!r} has an escaped name: rename it, or save a .glb")
        named = (folder / uri).resolve()
        if not named.is_relative_to(folder) or "\\" in uri:
            raise Error(f"its buffer {uri!r} lies outside of its folder")
        if not named.is_file():
            raise Error(f"its buffer {uri!r} is missing")
        with open_regular(named) as (_, bytes_of_buffer):
            size += bytes_of_buffer
    return size


def _imported(path: PathLike, size: int, library: str) -> tuple[dict[str, Any], bytes]:
    """What assimp makes of a file, by a process of its own: sizes and places, vertices, indices."""
    script = Path(__file__).with_name("assimp_process.py")
    most_bytes, seconds = _START + _GROWTH * size, _SECONDS + size / _BYTES_PER_SECOND
    mesh = os.path.realpath(path)
    call = [sys.executable, "-I", os.fspath(script), library, str(most_bytes), mesh]
    try:
        done = subprocess.run(
            call, stdin=subprocess.DEVNULL, capture_output=True, timeout=seconds, check=False
        )
    except subprocess.TimeoutExpired:
        raise Error(f"assimp did not read it within {seconds:.0f} s") from None
    if done.returncode < 0:
        raise Error(f"assimp cannot read it: signal {-done.returncode} ended it")
    if done.returncode > 0:
        said = done.stderr.decode(errors="replace").strip() or "it gives no reason"
        raise Error(f"assimp cannot read it: {said.rpartition(_SAID)[2]}")
    header, _, data = done.stdout.partition(b"\n")
    return json.loads(header), data


def _scene(header: dict[str, Any], data: bytes) -> Corners:
    """Each mesh where it is shown, one after the other."""
    local: list[Corners] = []
    start = 0
    for vertices, indices in header["sizes"]:
        single = np.frombuffer(data, np.float32, 3 * vertices, start).reshape(-1, 3)
        corners = np.frombuffer(data, np.uint32, indices, start + single.nbytes).reshape(-1, 3)
        start += single.nbytes + corners.nbytes
        local.append((single.astype(np.float64), corners.astype(np.int64)))
    placed: list[Corners] = []
    count = taken = 0
    for row, rows_of_pose in header["shown"]:
        (own, corners), pose = local[row], np.array(rows_of_pose)
        taken += own.nbytes + corners.nbytes
        check_bytes("what its scene shows", taken)
        mirrored = np.linalg.det(pose[:3, :3]) < 0
        outward = corners[:, ::-1] if mirrored else corners
        placed.append((own @ pose[:3, :3].T + pose[:3, 3], outward + count))
        count += len(own)
    if not placed:
        raise Error("its scene shows no triangles and no polygons")
    points, triangles = zip(*placed, strict=True)
    return np.concatenate(points), np.concatenate(triangles)
