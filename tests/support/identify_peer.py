# SPDX-License-Identifier: BSD-3-Clause
"""What columns of an arm mean, in NumPy, and touches to try things on: bathyal's peer."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

import bathyal

Array = NDArray[Any]
POINTS = np.array([[0.6, 0.2, 0.1], [0.3, -0.6, 0.2], [-0.5, 0.5, 0.3]])


def built(drawing: bathyal.Arm, size: float, seed: int) -> bathyal.Arm:
    """The arm as built: rows off by normal errors of `size`, with a tool."""
    random = np.random.default_rng(seed)
    table = drawing.to_dh()
    off = {n: getattr(table, n) + size * random.normal(size=drawing.size) for n in NAMES[:4]}
    tool = np.eye(4)
    tool[:3, 3] = 0.02, -0.01, 0.15
    return bathyal.Arm.from_dh(**off, tool=tool)


def touch(arm: bathyal.Arm, count: int, seed: int) -> tuple[Array, NDArray[np.int64]]:
    """Joint values of `count` exact touches of each of POINTS, and the points' labels."""
    random = np.random.default_rng(seed)
    rows, labels = [], []
    for label, point in enumerate(POINTS):
        q = random.uniform(-2.5, 2.5, (20 * count, arm.size))
        for _ in range(60):
            miss = point - arm.forward(q)[:, :3, 3]
            j = arm.jacobian(q)[:, :3]
            square = j @ j.transpose(0, 2, 1) + 1e-10 * np.eye(3)
            step = np.einsum("nij,ni->nj", j, np.linalg.solve(square, miss[..., None])[..., 0])
            q = q + step * (0.3 / np.maximum(0.3, np.linalg.norm(step, axis=1)))[:, None]
        near = np.linalg.norm(point - arm.forward(q)[:, :3, 3], axis=1) < 1e-12
        q = q[near & (np.abs(q).max(axis=1) < 6)][:count]
        assert len(q) == count
        rows.append(q)
        labels += [label] * count
    return np.vstack(rows), np.array(labels)


NAMES = ["theta", "d", "a", "alpha", "beta"]


class Peer:
    """Tips and residuals of a standard table of turning joints, vectorised over poses."""

    def __init__(self, arm: bathyal.Arm, fit: bathyal.ArmFit, q: Array, labels: Array) -> None:
        table = arm.to_dh()
        self.rows = np.array([getattr(table, n) for n in NAMES])
        self.places = [self._place(p.name) for p in fit.parameters]
        self.nominal = np.array([p.nominal for p in fit.parameters])
        self.q = q
        self.groups = [np.flatnonzero(labels == label) for label in np.unique(labels)]

    @staticmethod
    def _place(name: str) -> tuple[int, int]:
        symbol, index = name.split("_")
        return (
            (-1, "xyz".index(index)) if symbol == "tool" else (NAMES.index(symbol), int(index) - 1)
        )

    def tips(self, x: Array) -> Array:
        rows = self.rows.astype(x.dtype)
        tool = np.zeros(3, x.dtype)
        for (row, column), value in zip(self.places, x, strict=True):
            if row < 0:
                tool[column] = value
            else:
                rows[row, column] = value
        theta, d, a, alpha, beta = rows
        point = np.broadcast_to(tool, (len(self.q), 3))
        for k in reversed(range(self.q.shape[1])):
            x0, y0, z0 = point.T
            cb, sb = np.cos(beta[k]), np.sin(beta[k])
            x1, z1 = cb * x0 + sb * z0 + a[k], cb * z0 - sb * x0
            ca, sa = np.cos(alpha[k]), np.sin(alpha[k])
            y2, z2 = ca * y0 - sa * z1, sa * y0 + ca * z1 + d[k]
            ct, st = np.cos(theta[k] + self.q[:, k]), np.sin(theta[k] + self.q[:, k])
            point = np.stack([ct * x1 - st * y2, st * x1 + ct * y2, z2], axis=1)
        return point

    def residuals(self, x: Array) -> Array:
        """Touches about their centroids."""
        tips = self.tips(x)
        for group in self.groups:
            tips[group] -= tips[group].mean(axis=0)
        return tips.ravel()

    def jacobian(self, x: Array) -> Array:
        """By complex steps: exact to rounding."""
        columns = []
        for i in range(len(x)):
            moved = x.astype(complex)
            moved[i] += 1e-30j
            columns.append(self.residuals(moved).imag / 1e-30)
        return np.array(columns).T
