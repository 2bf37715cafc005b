# SPDX-License-Identifier: BSD-3-Clause
"""glTF and 3DS: in place, upright, and broken in many ways."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

import bathyal

pytest.importorskip("assimp_py", reason="assimp-py is not installed")
trimesh = pytest.importorskip("trimesh", reason="trimesh is not installed")


def chunk(kind: int, *parts: bytes) -> bytes:
    body = b"".join(parts)
    return struct.pack("<HI", kind, 6 + len(body)) + body


def write_3ds(path: Path, vertices: np.ndarray, triangles: np.ndarray) -> Path:
    """A 3D Studio file of one object, z up."""
    corners = struct.pack("<H", len(vertices)) + np.asarray(vertices, "<f4").tobytes()
    flagged = np.column_stack([triangles, np.full(len(triangles), 7)]).astype("<u2")
    faces = struct.pack("<H", len(triangles)) + flagged.tobytes()
    mesh = chunk(0x4100, chunk(0x4110, corners), chunk(0x4120, faces))
    path.write_bytes(chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, b"hull\0", mesh))))
    return path


@pytest.fixture
def wedge() -> tuple[np.ndarray, np.ndarray]:
    """A tetrahedron with a corner of its own on each axis."""
    return (
        np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]]),
        np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
    )


@pytest.mark.parametrize("suffix", ["glb", "gltf"])
def test_gltf_in_place_and_upright(tmp_path, wedge, suffix) -> None:
    scene = trimesh.Scene()
    for x in (0.0, 10.0):
        pose = np.eye(4)
        pose[:3, 3] = x, 5.0, 0.0  # 5 m up: glTF is y up
        scene.add_geometry(trimesh.Trimesh(*wedge, process=False), transform=pose)
    path = tmp_path / f"two.{suffix}"
    if suffix == "glb":
        scene.export(path)
    else:
        for name, data in trimesh.exchange.gltf.export_gltf(scene).items():
            (tmp_path / (path.name if name == "model.gltf" else name)).write_bytes(data)
    mesh = bathyal.read_mesh(path)
    assert len(mesh.vertices) == 8
    assert len(mesh.triangles) == 8
    # x stays, y goes up to z, z to -y
    assert mesh.vertices.min(axis=0) == pytest.approx([0, -3, 5])
    assert mesh.vertices.max(axis=0) == pytest.approx([11, 0, 7])
    assert bathyal.mesh_report(mesh).volume == pytest.approx(2.0)
    raw = bathyal.read_mesh(path, up="z", scale=0.1)
    assert raw.vertices.max(axis=0) == pytest.approx([1.1, 0.7, 0.3])


def test_3ds_keeps_its_axes_and_is_an_object_of_a_world(tmp_path, wedge) -> None:
    path = write_3ds(tmp_path / "hull.3ds", *wedge)
    mesh = bathyal.read_mesh(path)
    assert sorted(mesh.vertices.tolist()) == sorted(wedge[0].tolist())
    assert bathyal.mesh_report(mesh).volume == pytest.approx(1.0)
    (tmp_path / "world.yaml").write_text(
        "terrain: {seabed: {size: [20, 20], spacing: 1, seed: 1}}\n"
        "objects: [{name: hull, mesh: hull.3ds, material: steel, pose: {position: [1, 2, 0]}}]\n"
    )
    assert "hull" in bathyal.read_world(tmp_path / "world.yaml").names


@pytest.mark.parametrize("suffix", [".glb", ".3ds"])
def test_broken_files(tmp_path, wedge, suffix) -> None:
    path = tmp_path / f"whole{suffix}"
    if suffix == ".3ds":
        write_3ds(path, *wedge)
    else:
        trimesh.Trimesh(*wedge, process=False).export(path)
    whole = path.read_bytes()
    broken = tmp_path / f"broken{suffix}"
    random = np.random.default_rng(5)
    kinds = [whole[: len(whole) * k // 6] for k in range(6)] + [b"\xff" * 500]
    for _ in range(6):
        data = bytearray(whole)
        for at in random.integers(0, len(data), 4):
            data[at] = random.integers(0, 256)
        kinds.append(bytes(data))
    refused = 0
    for data in kinds:
        broken.write_bytes(data)
        try:
            found = bathyal.read_mesh(broken)
        except bathyal.Error as error:
            refused += "broken" in str(error)
        else:
            assert len(found.triangles) <= 8
    assert refused >= 3


def test_what_is_not_there(tmp_path, monkeypatch) -> None:
    with pytest.raises(OSError, match="none"):
        bathyal.read_mesh(tmp_path / "none.glb")
    (tmp_path / "a.glb").write_bytes(b"glTF")
    monkeypatch.setitem(__import__("sys").modules, "assimp_py", None)
    with pytest.raises(bathyal.Error, match=r"assimp-py.*\[assimp\]"):
        bathyal.read_mesh(tmp_path / "a.glb")
