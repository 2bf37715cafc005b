# SPDX-License-Identifier: BSD-3-Clause
"""What the process runs that `assimp.read_assimp` starts; it imports nothing of the package.

Its arguments are the folder of the library, the most bytes of memory it may take, and the file.
It writes one line of JSON, then the vertices and indices of each mesh as they lie in memory.
"""

from __future__ import annotations

import json
import resource
import sys
from collections.abc import Sequence
from typing import BinaryIO

Rows = Sequence[Sequence[float]]


def main(out: BinaryIO, library: str, most_bytes: str, path: str) -> None:
    """Meshes as the file has them, and [mesh, scene_from_mesh] of each place they are shown at."""
    resource.setrlimit(resource.RLIMIT_AS, (int(most_bytes),) * 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    sys.path.insert(0, library)
    import assimp_py

    flags = assimp_py.Process_Triangulate | assimp_py.Process_SortByPType
    try:
        scene = assimp_py.import_file(path, flags)
    except ValueError as error:  # of what has not three corners
        raise ValueError("it has points or lines among its meshes") from error
    shown = []
    nodes = [(scene.root_node, scene.root_node.transformation)]
    while nodes:
        node, pose = nodes.pop()
        shown += [[row, pose] for row in node.mesh_indices]
        children = [(child, _product(pose, child.transformation)) for child in node.children]
        nodes += reversed(children)
    sizes = [[mesh.num_vertices, mesh.num_indices] for mesh in scene.meshes]
    out.write(json.dumps({"sizes": sizes, "shown": shown}).encode() + b"\n")
    for mesh in scene.meshes:
        out.write(mesh.vertices)
        out.write(mesh.indices)


def _product(left: Rows, right: Rows) -> list[list[float]]:
    """Of (4, 4) matrices, in double; numpy would take longer to start than this does."""
    columns = list(zip(*right, strict=True))
    return [
        [sum(a * b for a, b in zip(row, column, strict=True)) for column in columns] for row in left
    ]


if __name__ == "__main__":
    try:
        main(sys.stdout.buffer, *sys.argv[1:])
    except Exception as error:
        sys.exit(str(error) or type(error).__name__)
