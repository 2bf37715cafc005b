# SPDX-License-Identifier: BSD-3-Clause
"""A bottom, rays about it, and how hits are compared, for the tests of Scene.cast."""

import numpy as np

SURVEY = np.array([620_000.0, 7_246_000.0, -52.0])  # an offset as survey coordinates have it


def seabed(side=40, offset=(0.0, 0.0, 0.0), seed=0):
    axis = np.arange(side, dtype=float)
    x, y = np.meshgrid(axis, axis)
    z = np.sin(0.4 * x) + np.cos(0.3 * y + 0.2 * x)
    z += np.random.default_rng(seed).normal(0.0, 0.05, z.shape)
    vertices = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) + offset
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    return vertices, np.concatenate(
        [
            np.column_stack([corner, corner + 1, corner + side + 1]),
            np.column_stack([corner, corner + side + 1, corner + side]),
        ]
    )


def rays(count=3000, side=40, offset=(0.0, 0.0, 0.0), seed=1):
    random = np.random.default_rng(seed)
    origins = random.uniform((0, 0, -3), (side - 1, side - 1, 6), (count, 3)) + offset
    return origins, random.normal(size=(count, 3))


def same(a, b):
    return all(
        np.array_equal(getattr(a, name), getattr(b, name), equal_nan=True)
        for name in ("range", "mesh", "triangle", "point", "normal", "barycentric")
    )
