# SPDX-License-Identifier: BSD-3-Clause
"""glTF (`.glb`, `.gltf`) and 3D Studio (`.3ds`), through assimp, in a process of its own.

A broken file may bring a C++ library down; it brings down that process, and is an `Error` here.
"""

from __future__ import annotations

import io
import os
import subprocess
import sys

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, check_bytes
from bathyal.io.files import PathLike, need, opened, reading

_MOST_SECONDS = 300
_CHILD = """
import io, resource, sys
import assimp_py, numpy as np
limit = int(sys.argv[2])
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
scene = assimp_py.import_file(sys.argv[1], assimp_py.Process_Triangulate
    | assimp_py.Process_PreTransformVertices | assimp_py.Process_SortByPType)
points, triangles, first = [np.empty((0, 3))], [np.empty((0, 3), np.int64)], 0
for mesh in scene.meshes:
    if mesh.num_indices != 3 * mesh.num_faces or mesh.num_faces == 0:
        continue  # points and lines
    corners = np.array(mesh.vertices, np.float64).reshape(-1, 3)
    points.append(corners)
    triangles.append(np.array(mesh.indices, np.int64).reshape(-1, 3) + first)
    first += len(corners)
whole = io.BytesIO()
np.savez(whole, points=np.concatenate(points), triangles=np.concatenate(triangles))
sys.stdout.buffer.write(whole.getvalue())
"""
_LIMIT = 8 << 30  # bytes of address space, shared libraries among them


def read_with_assimp(path: PathLike) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """(N, 3) corners with the transforms of the file's nodes applied, y up, and (T, 3) triangles;
    points, lines, materials and animations are left out.
    """
    need("assimp_py", "assimp-py", "reading glTF and 3DS", extra="assimp")
    with opened(path), reading(path, "mesh"):
        name = os.path.realpath(path)
        try:
            done = subprocess.run(
                [sys.executable, "-c", _CHILD, name, str(_LIMIT)],
                capture_output=True, timeout=_MOST_SECONDS, check=False,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            raise Error(f"assimp does not read it in {_MOST_SECONDS} s") from None
        if done.returncode != 0:
            lines = done.stderr.decode(errors="replace").strip().splitlines()
            raise Error(lines[-1] if lines else f"assimp ended with {done.returncode}")
        check_bytes("its triangles", len(done.stdout))
        with np.load(io.BytesIO(done.stdout), allow_pickle=False) as found:
            points, triangles = found["points"], found["triangles"]
        if triangles.size and not (0 <= triangles.min() <= triangles.max() < len(points)):
            raise Error("a triangle has a corner that is not there")
        return points, triangles
