# SPDX-License-Identifier: BSD-3-Clause
"""Small glTF and 3DS files, byte by byte."""

from __future__ import annotations

import base64
import json
import struct

import numpy as np

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], "<f4")
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], "<u2")  # a tetrahedron, outward


def gltf_document(**changed):
    """A tetrahedron under one node; keys of the document may be changed."""
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": 4,
                "type": "VEC3",
                "min": POINTS.min(axis=0).tolist(),
                "max": POINTS.max(axis=0).tolist(),
            },
            {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 24},
        ],
        "buffers": [{"byteLength": 72}],
    }
    return {**document, **changed}


BUFFER = POINTS.tobytes() + FACES.tobytes()


def gltf(**changed):
    """Text of a .gltf with its buffer inside."""
    uri = "data:application/octet-stream;base64," + base64.b64encode(BUFFER).decode()
    return json.dumps(gltf_document(**{"buffers": [{"byteLength": 72, "uri": uri}], **changed}))


def glb(**changed):
    """Bytes of a .glb."""
    text = json.dumps(gltf_document(**changed)).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(BUFFER), b"BIN\0") + BUFFER
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _chunk(number, *parts):
    data = b"".join(parts)
    return struct.pack("<HI", number, 6 + len(data)) + data


def _solid(name, offset):
    """A tetrahedron that is drawn at `offset`, the origin of its own frame."""
    points = struct.pack("<H", len(POINTS)) + (POINTS + np.float32(offset)).tobytes()
    faces = np.column_stack([FACES, np.zeros(len(FACES), "<u2")]).tobytes()
    frame = np.vstack([np.eye(3), offset]).astype("<f4").tobytes()
    mesh = _chunk(
        0x4100,
        _chunk(0x4110, points),
        _chunk(0x4120, struct.pack("<H", len(FACES)), faces),
        _chunk(0x4160, frame),
    )
    return _chunk(0x4000, name + b"\0", mesh)


def _node(name, row, parent, position):
    key = struct.pack("<H8xIIH3f", 0, 1, 0, 0, *position)
    return _chunk(
        0xB002,
        _chunk(0xB030, struct.pack("<H", row)),
        _chunk(0xB010, name + b"\0", struct.pack("<HHh", 0, 0, parent)),
        _chunk(0xB013, struct.pack("<3f", 0, 0, 0)),
        _chunk(0xB020, key),
    )


def threeds():
    """Bytes of a .3ds: a tetrahedron at (5, 6, 7), and one 1 along x from it that hangs on it."""
    first, second = (5.0, 6.0, 7.0), (6.0, 6.0, 7.0)
    scene = _chunk(0x3D3D, _solid(b"first", first), _solid(b"second", second))
    nodes = _node(b"first", 0, -1, first) + _node(b"second", 1, 0, (1.0, 0.0, 0.0))
    frames = _chunk(0xB00A, struct.pack("<H", 5), b"x\0", struct.pack("<I", 0))
    return _chunk(0x4D4D, _chunk(2, struct.pack("<I", 3)), scene, _chunk(0xB000, frames, nodes))
