# SPDX-License-Identifier: BSD-3-Clause
"""What the cases of bad input start from: a small grid that is valid, and the kinds of error."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import bathyal
from bathyal import Error

FAR = 1e7
GRID = np.array([[x, y, 0.01 * x * y] for x in range(6) for y in range(5)], dtype=float)
BROKEN = (Error,)
ANY = (ValueError, TypeError, Error, OSError)


def same(left: object, right: object, tolerance: float = 1e-9) -> None:
    np.testing.assert_allclose(np.asarray(left), np.asarray(right), rtol=0, atol=tolerance)


def bottom(offset: float = 0.0) -> bathyal.TriangleMesh:
    return bathyal.triangulate(GRID + offset)


def scene(offset: float = 0.0) -> bathyal.Scene:
    return bathyal.Scene(bottom(offset))


def down(x: float, y: float, z: float = 5.0) -> list[float]:
    return [x, y, z, 0.0, 0.0, -1.0]


def is_grid(mesh: bathyal.TriangleMesh) -> None:
    assert len(mesh.triangles) == 2 * 5 * 4
    report = bathyal.mesh_report(mesh)
    assert abs(report.planar_area - 20.0) < 1e-6, report.planar_area


def written(name: str, content: str | bytes) -> Path:
    path = Path(name)
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


TWO = [down(1.1, 1.2), down(4.1, 3.3)]
