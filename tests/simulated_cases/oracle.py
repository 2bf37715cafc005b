# SPDX-License-Identifier: BSD-3-Clause
"""An oracle: it knows the noise and the shapes, those of the truth among them, and explains what is
seen by the fewest causes that leave nothing. What it cannot find, nobody is asked to find."""

from __future__ import annotations

from dataclasses import dataclass, field
from statistics import NormalDist

import numpy as np

from tests.simulated_cases.arms import Array
from tests.simulated_cases.effect_shapes import (
    Poses,
    Shape,
    base_columns,
    basis,
    columns,
    project_out,
)


@dataclass
class Oracle:
    """Shapes of given poses beyond what geometry, base and tool can do, in noises."""

    shapes: list[Shape]
    known: Array  # (M, r) orthonormal: geometry, base, tool
    bases: list[Array] = field(
        default_factory=list
    )  # of each shape, orthonormal, projected off `known`
    dimensions: int = 0

    @staticmethod
    def of(poses: Poses, shapes: list[Shape]) -> Oracle:
        oracle = Oracle([], basis(base_columns(poses)))
        oracle.dimensions = poses.q.shape[0] * (6 if poses.pose else 3)
        oracle.add(poses, shapes)
        return oracle

    def add(self, poses: Poses, shapes: list[Shape]) -> None:
        for shape in shapes:
            raw = columns(poses, shape)
            left = project_out(self.known, raw)
            size = np.linalg.norm(raw, axis=0)
            # What geometry swallows to a thousandth is nobody's to find.
            keep = np.linalg.norm(left, axis=0) > 1e-3 * np.where(size > 0, size, np.inf)
            if keep.any():
                self.shapes.append(shape)
                self.bases.append(basis(left[:, keep]))

    @property
    def dims(self) -> Array:
        return np.array([b.shape[1] for b in self.bases])

    def penalty(self, index: int) -> float:
        """What a shape must explain, in squared noises: chance does so once in 100 clean cases
        for all shapes together."""
        return chance(self.bases[index].shape[1], 0.01 / len(self.bases))

    def explained(self, seen: Array, chosen: list[int]) -> float:
        if not chosen:
            return 0.0
        span = basis(np.hstack([self.bases[i] for i in chosen]))
        return float(np.sum((span.T @ seen) ** 2))

    def gains(self, seen: Array, chosen: list[int]) -> Array:
        """What each shape would explain beyond those chosen: of `seen` projected off `known`."""
        stacked = np.hstack(self.bases)
        left = seen
        within = np.zeros((0, stacked.shape[1]))
        if chosen:
            span = basis(np.hstack([self.bases[i] for i in chosen]))
            left = seen - span @ (span.T @ seen)
            within = span.T @ stacked
        right = stacked.T @ left
        out = np.zeros(len(self.bases))
        ends = np.cumsum(self.dims)
        for i, (begin, end) in enumerate(zip(ends - self.dims, ends, strict=True)):
            square = np.eye(end - begin) - within[:, begin:end].T @ within[:, begin:end]
            values, axes = np.linalg.eigh(square)
            keep = values > 1e-6
            if i not in chosen and keep.any():
                out[i] = np.sum((axes[:, keep].T @ right[begin:end]) ** 2 / values[keep])
        return out

    def find(self, seen: Array, most: int = 4, free: bool = False) -> list[int]:
        """The set that explains most beyond its penalties: grown one by one, then each member tried
        against all others. `free` asks for no penalty: how far any set of `most` comes."""
        seen = project_out(self.known, seen)
        cost = np.array([0.0 if free else self.penalty(i) for i in range(len(self.bases))])
        causes = [s.cause for s in self.shapes]
        chosen: list[int] = []

        def best(others: list[int]) -> tuple[int, float]:
            net = self.gains(seen, others) - cost
            for i in range(len(net)):
                if causes[i] in [causes[c] for c in others]:
                    net[i] = -np.inf
            i = int(np.argmax(net))
            return i, float(net[i])

        while len(chosen) < most:
            i, net = best(chosen)
            if net <= 0:
                break
            chosen.append(i)
            for _ in range(2):
                chosen = self._exchanged(seen, chosen, cost, best)
        return chosen

    def _exchanged(self, seen, chosen, cost, best) -> list[int]:  # type: ignore[no-untyped-def]
        def worth(members: list[int]) -> float:
            return self.explained(seen, members) - float(cost[members].sum())

        for member in list(chosen):
            others = [c for c in chosen if c != member]
            i, net = best(others)
            candidate = [*others, i] if net > 0 else others
            if worth(candidate) > worth(chosen) + 1e-9:
                chosen = candidate
        return chosen


def chance(count: int, p: float) -> float:
    """What chi squared of `count` degrees exceeds once in 1 / p (Wilson and Hilferty 1931)."""
    z = NormalDist().inv_cdf(1 - p)
    return float(count * (1 - 2 / (9 * count) + z * np.sqrt(2 / (9 * count))) ** 3)
