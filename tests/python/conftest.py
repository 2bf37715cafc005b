# SPDX-License-Identifier: BSD-3-Clause
"""What tests of several files start from."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal.toolpath.example_aims import write_aims
from tests.support import scenes


@pytest.fixture(scope="session")
def job(tmp_path_factory):
    """A small survey and aims for it, as files."""
    folder = tmp_path_factory.mktemp("job")
    mesh = scenes.bottom(offset=scenes.UTM).meshes[0]
    used = np.unique(mesh.triangles)
    points = mesh.vertices[used]
    points = points[(points[:, 0] < 621_009) | (points[:, 0] > 621_011)]
    bathyal.write_cloud(bathyal.PointCloud(points, crs="EPSG:32602"), folder / "survey.xyz")
    write_aims(scenes.aims(offset=scenes.UTM), folder / "aims.csv")
    write_aims(scenes.aims(offset=scenes.UTM, miss=False), folder / "found.csv")
    return folder


@pytest.fixture
def write(tmp_path: Path):
    def write_file(content: str | bytes, name: str = "f.xyz") -> Path:
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write_file
