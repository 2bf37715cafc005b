# SPDX-License-Identifier: BSD-3-Clause
"""Bottoms on a regular grid and aims straight down, for tests of tool paths."""

import numpy as np

import bathyal


def grid(height, size=6.0, cells=24, shift=(0, 0, 0), keep=None):
    """A square bottom of 2 · cells² triangles."""
    axis = np.linspace(0, size, cells + 1)
    x, y = np.meshgrid(axis, axis)
    vertices = np.column_stack([x.ravel(), y.ravel(), height(x, y).ravel()]) + shift
    column, row = np.meshgrid(np.arange(cells), np.arange(cells))
    corner = (row * (cells + 1) + column).ravel()
    if keep is not None:
        corner = corner[keep(column, row).ravel()]
    up = corner + cells + 1
    triangles = np.vstack(
        [np.column_stack([corner, corner + 1, up + 1]), np.column_stack([corner, up + 1, up])]
    )
    return bathyal.TriangleMesh(vertices, triangles)


def hills(x, y):
    return np.sin(1.3 * x) * np.cos(0.9 * y) - 4.0


def down(points, height=50.0):
    points = np.asarray(points, dtype=float)
    return np.column_stack(
        [points, np.full(len(points), height), np.zeros((len(points), 2)), -np.ones(len(points))]
    )


TOUR = down([[0.63, 0.71], [5.12, 1.33], [4.21, 5.24], [1.17, 4.41]])
