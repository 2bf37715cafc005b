# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of a workspace's capsules with its hull and spheres, decided by Coal."""

from __future__ import annotations

import numpy as np
import pytest


def _turn_to(z: np.ndarray) -> np.ndarray:
    x = np.cross([0, 1, 0] if abs(z[1]) < 0.9 else [1, 0, 0], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def _mesh(coal, mesh):
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(mesh.triangles), len(mesh.vertices))
    vertices, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    for vertex in mesh.vertices:
        vertices.append(vertex)
    for a, b, c in mesh.triangles:
        triangles.append(coal.Triangle(int(a), int(b), int(c)))
    model.addSubModel(vertices, triangles)
    model.endModel()
    return model


def touches_by_coal(ws, q: np.ndarray) -> np.ndarray:
    """(N,) bool; keep-outs are spheres fixed to the vehicle, pairs left out are those of `ws`."""
    coal = pytest.importorskip("coal")
    identity = coal.Transform3s.Identity()
    bodies = [("hull", _mesh(coal, ws.hull.mesh), identity)]
    for ball in ws.keepouts:
        place = coal.Transform3s(np.eye(3), ball.pose[:3, 3])
        bodies.append((ball.name, coal.Sphere(ball.radius), place))
    skip = {(link, other) for link, other, _ in ws.excluded}
    found = np.zeros(len(q), dtype=bool)
    for row, capsules in enumerate(ws.place_capsules(q)):
        for link, (*ends, radius) in zip(ws.capsule_links, capsules, strict=True):
            if link == "link_0":
                continue
            start, end = np.array(ends[:3]), np.array(ends[3:])
            length = np.linalg.norm(end - start)
            along = (end - start) / length if length > 0 else np.array([0, 0, 1.0])
            place = coal.Transform3s(_turn_to(along), 0.5 * (start + end))
            capsule = coal.Capsule(radius, length)
            for name, body, at in bodies:
                if (link, name) in skip or found[row]:
                    continue
                found[row] = coal.collide(
                    body, at, capsule, place, coal.CollisionRequest(), coal.CollisionResult()
                )
    return found
