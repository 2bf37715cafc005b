# SPDX-License-Identifier: BSD-3-Clause
"""The search of a diagnosis as one would write it plainly with SciPy: refit the geometry with each
form of each effect in turn, by least_squares with its own numerical derivatives, and keep what the
Bayesian information criterion likes best, until nothing helps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from tests.simulated_cases import effect_library as lib
from tests.simulated_cases.arms import COLUMNS, Array, SimArm, turned
from tests.simulated_cases.effect_shapes import Poses, Shape

UNIT = 1e-3  # of all unknowns: millimetres and milliradians


@dataclass(frozen=True)
class Found:
    """A set of forms, and the fit with them."""

    shapes: list[Shape]
    x: Array
    square: float  # sum of squared residuals [m²]
    forms: int  # that were tried, each by a fit of its own

    def values(self, which: int) -> dict[str, float]:
        """Parameters of a shape, as found."""
        counts = [len(s.actions) for s in self.shapes]
        end = len(self.x) - sum(counts[which + 1 :])
        x = UNIT * self.x[end - counts[which] : end]
        return dict(zip(self.shapes[which].actions, x.tolist(), strict=True))


class PlainSearch:
    """Positions (N, 3) measured at joint values q (N, n), with covariates."""

    def __init__(
        self, arm: SimArm, q: Array, position: Array, covariates: dict[str, Array]
    ) -> None:
        self.arm, self.position = arm, position
        time = covariates.get("time")
        order = np.arange(len(q)) if time is None else np.argsort(time, kind="stable")
        speed = None
        if time is not None:
            speed = np.empty_like(q)
            speed[order] = np.gradient(q[order], time[order], axis=0)
        self.poses = Poses(arm, q, covariates, order, arm.walk(q), speed)
        self.rows = np.array([getattr(arm, c) for c in COLUMNS])

    def tips(self, x: Array, shapes: list[Shape]) -> Array:
        """All rows of the table, base and tool, then the parameters of the shapes."""
        x = UNIT * x
        count = self.rows.size
        rows = self.rows + x[:count].reshape(self.rows.shape)
        base, tool, rest = x[count : count + 6], x[count + 6 : count + 9], x[count + 9 :]
        q, twists, stretch = self.poses.q.copy(), {}, np.zeros(len(self.poses.q))
        at = 0
        for shape in shapes:
            for actions in shape.actions.values():
                for action in actions:
                    if action.site == "joint":
                        q[:, action.index] += rest[at] * action.values
                    elif action.site == "length":
                        stretch += rest[at] * action.values
                    else:
                        so_far = twists.get(action.index, 0.0)
                        twists[action.index] = so_far + rest[at] * action.values
                at += 1
        fixed = {
            n: getattr(self.arm, n) for n in ("sliding", "lower", "upper", "masses", "centers")
        }
        hand = np.eye(4)
        hand[:3, 3] = tool
        arm = SimArm(*rows, **fixed, tool=hand)
        return arm.walk(q, twists, stretch).tip @ turned(base[None, 3:])[0].T + base[:3]

    def fit(self, shapes: list[Shape], start: Array) -> tuple[Array, float]:
        start = np.concatenate([start, np.zeros(self._unknowns(shapes) - len(start))])
        result = least_squares(
            lambda x: ((self.tips(x, shapes) - self.position) / UNIT).ravel(), start, method="lm"
        )
        return result.x, 2 * result.cost * UNIT**2

    def search(self, most: int = 1) -> Found:
        """Grows a set by the best form of each round, `most` of them at most."""
        x, square = self.fit([], np.zeros(0))
        chosen: list[Shape] = []
        forms = 1
        for _ in range(most):
            tried = []
            for shape in lib.library(self.poses):
                if shape.cause in [s.cause for s in chosen]:
                    continue
                tried.append((*self.fit([*chosen, shape], x), shape))
                forms += 1
            best = min(tried, key=lambda t: self._criterion(t[1], [*chosen, t[2]]))
            if self._criterion(best[1], [*chosen, best[2]]) >= self._criterion(square, chosen):
                break
            x, square = best[:2]
            chosen = [*chosen, best[2]]
        return Found(chosen, x, square, forms)

    def _unknowns(self, shapes: list[Shape]) -> int:
        return self.rows.size + 9 + sum(len(s.actions) for s in shapes)

    def _criterion(self, square: float, shapes: list[Shape]) -> float:
        """Schwarz (1978)."""
        count = self.position.size
        return float(count * np.log(square / count) + self._unknowns(shapes) * np.log(count))
