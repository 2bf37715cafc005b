# SPDX-License-Identifier: BSD-3-Clause
"""Points to ask a hull about, and what others say of them: for tests and benchmarks."""

import numpy as np

import bathyal


def query_points(mesh, count, near=0.01, seed=3):
    """Every second one anywhere in the box of the mesh, the others within `near` [m] of it."""
    random = np.random.default_rng(seed)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    margin = 0.05 * (high - low) + 0.01
    points = random.uniform(low - margin, high + margin, (count, 3))
    corners = mesh.vertices[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normals, axis=1)
    which = random.choice(len(area), count // 2, p=area / area.sum())
    weights = random.dirichlet((1, 1, 1), count // 2)
    on = np.einsum("nc,ncd->nd", weights, corners[which])
    away = random.uniform(-near, near, (count // 2, 1))
    points[1::2] = on + away * normals[which] / area[which, None]
    return points


def occupancy(mesh, points, threads=0):
    """Open3D's answer: one ray a point, in float32."""
    import open3d

    scene = open3d.t.geometry.RaycastingScene(nthreads=threads)
    scene.add_triangles(
        open3d.core.Tensor(np.asarray(mesh.vertices, np.float32)),
        open3d.core.Tensor(np.asarray(mesh.triangles, np.uint32)),
    )
    queries = open3d.core.Tensor(np.asarray(points, np.float32))
    return scene.compute_occupancy(queries).numpy() > 0.5


def winding_by_definition(mesh, points):
    """Van Oosterom and Strackee's solid angle of every triangle over 4π."""
    corners = mesh.vertices[mesh.triangles]
    numbers = []
    for q in points:
        a, b, c = (corners[:, i] - q for i in range(3))
        la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c))
        cosines = la * lb * lc
        for u, v, length in ((a, b, lc), (b, c, la), (c, a, lb)):
            cosines = cosines + np.einsum("ij,ij->i", u, v) * length
        numbers.append(np.arctan2(volume, cosines).sum())
    return np.array(numbers) / (2.0 * np.pi)


def explained_by_winding(mesh, points, inside):
    """Whether each answer is that of the exact winding number; where that is within 0.05 of 1/2, in
    the film over a hole, either answer is."""
    beyond = np.abs(winding_by_definition(mesh, points)) - 0.5
    return ((beyond > 0) == inside) | (np.abs(beyond) < 0.05)


def subdivided(mesh, least):
    """The same surface with at least `least` triangles: each cut in four, again and again."""
    vertices, triangles = np.array(mesh.vertices), np.array(mesh.triangles)
    while len(triangles) < least:
        edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        edges, number = np.unique(edges, axis=0, return_inverse=True)
        middle = number.reshape(-1, 3) + len(vertices)
        a, b, c = triangles.T
        ab, bc, ca = middle.T
        triangles = np.concatenate(
            [np.column_stack(t) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
        )
        vertices = np.concatenate([vertices, vertices[edges].mean(axis=1)])
    return bathyal.TriangleMesh(vertices, triangles)
