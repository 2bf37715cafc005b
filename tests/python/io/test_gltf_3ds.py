# SPDX-License-Identifier: BSD-3-Clause
"""glTF and 3DS by assimp: where everything lies, which way is up, and what is refused."""

from __future__ import annotations

import itertools
import re
import sys

import numpy as np
import pytest

import bathyal
from tests.support.mesh_cases import volume
from tests.support.scene_files import BUFFER, POINTS, glb, gltf, threeds

pytest.importorskip("assimp_py")

Z_UP = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])  # from glTF's y up


def rows(points):
    return sorted(map(tuple, np.asarray(points, float).round(5).tolist()))


def read(path, content, **options):
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return bathyal.read_mesh(path, **options)


@pytest.mark.parametrize("suffix", [".glb", ".gltf"])
def test_gltf_is_turned_to_z_up(tmp_path, suffix):
    content = glb() if suffix == ".glb" else gltf()
    mesh = read(tmp_path / f"a{suffix}", content)
    assert rows(mesh.vertices) == rows(POINTS @ Z_UP.T)
    assert volume(mesh) == pytest.approx(1.0)  # of 1 by 2 by 3, facing outward
    as_drawn = read(tmp_path / f"a{suffix}", content, up="z", scale=0.5)
    assert rows(as_drawn.vertices) == rows(0.5 * POINTS)


def test_a_buffer_next_to_the_file_is_read(tmp_path):
    (tmp_path / "a b.bin").write_bytes(BUFFER)
    named = gltf(buffers=[{"byteLength": 72, "uri": "a b.bin"}])
    assert volume(read(tmp_path / "a.gltf", named)) == pytest.approx(1.0)


def test_nodes_place_a_mesh_as_trimesh_places_it(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    turned = trimesh.transformations.rotation_matrix(0.5, [0, 1, 1], [1, 2, 3])
    mirrored = np.diag([2.0, 2.0, -2.0, 1.0])
    mirrored[:3, 3] = [0, 3, 0]
    scene = trimesh.Scene()
    solid = trimesh.creation.box([1, 2, 3])
    scene.add_geometry(solid, node_name="one", geom_name="box", transform=turned)
    scene.graph.update(frame_from="one", frame_to="two", matrix=mirrored, geometry="box")
    scene.export(tmp_path / "a.glb")
    mesh = bathyal.read_mesh(tmp_path / "a.glb")
    expected = [
        trimesh.transform_points(solid.vertices, pose) @ Z_UP.T
        for pose in (turned, turned @ mirrored)
    ]
    np.testing.assert_allclose(rows(mesh.vertices), rows(np.concatenate(expected)), atol=2e-5)
    assert volume(mesh) == pytest.approx(6.0 + 48.0, rel=1e-5)  # the mirrored one outward, too


def test_3ds_keeps_its_axes_and_hangs_nodes_on_nodes(tmp_path):
    mesh = read(tmp_path / "a.3ds", threeds())
    expected = [POINTS + np.float32([5, 6, 7]), POINTS + np.float32([6, 6, 7])]
    assert rows(mesh.vertices) == rows(np.unique(np.concatenate(expected), axis=0))
    assert volume(mesh) == pytest.approx(2.0)
    assert read(tmp_path / "b.3ds", threeds(), scale=0.001).vertices.max() == pytest.approx(0.01)


def test_an_object_of_a_world_comes_from_3ds(tmp_path):
    (tmp_path / "part.3ds").write_bytes(threeds())
    (tmp_path / "world.yaml").write_text(
        "terrain: {seabed: {size: [20, 20], spacing: 1, relief_rms: 0, depth: 10}}\n"
        "objects: [{name: part, mesh: part.3ds, pose: {position: [0, 0, -30]}}]\n"
    )
    world = bathyal.read_world(tmp_path / "world.yaml")
    hit = world.scene.cast([[5.1, 6.1, 0]], [[0, 0, -1]])
    assert hit.mesh.tolist() == [0]  # the bottom at -10 is above it
    low = world.scene.cast([[5.1, 6.1, -11]], [[0, 0, -1]])
    assert low.mesh.tolist() == [1]
    assert -11 - low.range[0] == pytest.approx(-23 + 3 * (1 - 0.1 - 0.05), abs=1e-5)


@pytest.mark.parametrize(("suffix", "whole"), [(".glb", glb()), (".3ds", threeds())])
def test_every_cut_is_an_error(tmp_path, suffix, whole):
    path = tmp_path / f"a{suffix}"
    step = max(1, len(whole) // 40)
    for cut in itertools.chain(range(0, len(whole), step), range(len(whole) - 3, len(whole))):
        path.write_bytes(whole[:cut])
        with pytest.raises(bathyal.Error, match=re.escape(str(path))):
            bathyal.read_mesh(path)


@pytest.mark.parametrize(("suffix", "whole"), [(".glb", glb()), (".3ds", threeds())])
def test_bytes_that_are_wrong_are_read_or_refused(tmp_path, suffix, whole):
    random = np.random.default_rng(3)
    path = tmp_path / f"a{suffix}"
    refused = 0
    for _ in range(60):
        content = bytearray(whole)
        for at in random.integers(0, len(whole), 4):
            content[at] = random.integers(0, 256)
        path.write_bytes(content)
        try:
            bathyal.read_mesh(path)
        except bathyal.Error:
            refused += 1
    assert refused > 0


CHAIN = [{"children": [row + 1]} for row in range(100_000)] + [{"mesh": 0}]


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (gltf(nodes=CHAIN), "signal"),
        (gltf(nodes=[{"children": [0]}]), "recursive"),
        ('{"asset":{"version":"2.0"},"extras":' + "[" * 100_000 + "]" * 100_000 + "}", "recursion"),
        (gltf(buffers=[{"byteLength": 72, "uri": "/dev/zero"}]), "outside of its folder"),
        (gltf(buffers=[{"byteLength": 72, "uri": "../a.gltf"}]), "outside of its folder"),
        (gltf(buffers=[{"byteLength": 72, "uri": "%2e%2e/a.gltf"}]), "escaped"),
        (gltf(buffers=[{"byteLength": 72, "uri": "https://example.org/a"}]), "missing"),
        (gltf(asset={"version": "1.0"}), "version 2"),
        (gltf(meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}]), "points"),
        (gltf(nodes=[{"mesh": 7}]), "out of bounds"),
        ("{}", "asset"),
        ("v 0 0 0\n", "glTF"),
    ],
    ids=[
        "chain",
        "cycle",
        "deep",
        "device",
        "up",
        "escaped",
        "web",
        "version",
        "points",
        "row",
        "empty",
        "other",
    ],
)
def test_hostile_gltf_is_an_error(tmp_path, content, reason):
    with pytest.raises(bathyal.Error, match=reason):
        read(tmp_path / "a.gltf", content)


def test_content_of_another_format_is_not_tried(tmp_path):
    with pytest.raises(bathyal.Error, match="does not begin"):
        read(tmp_path / "a.3ds", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.raises(bathyal.Error, match="does not begin"):
        read(tmp_path / "a.glb", threeds())


def test_without_the_library_the_error_names_the_remedy(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "assimp_py", None)
    with pytest.raises(bathyal.Error, match=r"assimp-py.*\[meshes\]"):
        read(tmp_path / "a.3ds", threeds())
