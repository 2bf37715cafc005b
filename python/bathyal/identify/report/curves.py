# SPDX-License-Identifier: BSD-3-Clause
"""What the pictures and the page of an identification draw alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bathyal._core import ArmFit, Touches, Tracked
from bathyal.identify.report.tables import Pairs, groups, pair_distances

Floats = NDArray[np.float64]

AXIS_COLOURS = ("#d1495b", "#3c9d4e", "#2f6fb5")  # of x, y, z, as those of frames are
_MOST_MARKS = 6000  # in one picture
_DEEPEST = 1e-18  # a singular value of zero has no logarithm
_ROOM = 30.0  # below the rms, on a scale of decades
_NOTHING = 1e-17  # [m]; exact data leave less


@dataclass(frozen=True)
class Curve:
    """Distances of one point's pairs, or of one station's poses, rising by what they were [m]."""

    name: str
    marks: list[str]
    before: Floats
    after: Floats
    rms_before: float
    rms_after: float


@dataclass(frozen=True)
class Curves:
    """Those of all points in one plot, and what they are."""

    curves: list[Curve]
    what: str
    across: str

    @property
    def limits(self) -> tuple[float, float]:
        """Of an axis of decades that shows nearly all [m]; what lies lower counts as nothing."""
        high = max(float(np.max(curve.before)) for curve in self.curves)
        high = max(high, *(float(np.max(curve.after)) for curve in self.curves))
        low = min(curve.rms_after for curve in self.curves) / _ROOM
        return max(low, _NOTHING), 1.5 * max(high, 10 * _NOTHING)


def curves_of(fit: ArmFit, data: Touches | Tracked) -> Curves:
    """Pairs of touches; poses where they were tracked, or where no point was touched twice."""
    pairs = pair_distances(fit, data) if isinstance(data, Touches) else []
    if pairs:
        found = [_curve(some.group, _pair_marks(some), some.before, some.after) for some in pairs]
        across = "pairs of touches of one point, rising by their distance before"
        return _thinned(found, "between two touches", across)
    before, after = (np.linalg.norm(r, axis=1) for r in (fit.residuals_before, fit.residuals))
    found = [
        _curve(group.name, [f"row {i}" for i in group.rows], before[group.rows], after[group.rows])
        for group in groups(fit, data)
    ]
    across = "poses, rising by their distance before"
    return _thinned(found, "from where it should be", across)


def rank_gap(fit: ArmFit) -> tuple[Floats, float]:
    """Singular values that a logarithm can be taken of, and the foot of their axis."""
    values = np.maximum(fit.singular_values, _DEEPEST)
    return values, float(values[-1]) / 10 if fit.rank < len(values) else float(values[-1]) / 100


def thinned(count: int, most: int = _MOST_MARKS) -> NDArray[np.intp]:
    """Rows spread evenly, `most` of them at most."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).astype(np.intp))


def _curve(name: str, marks: Sequence[str], before: Floats, after: Floats) -> Curve:
    order = np.argsort(before, kind="stable")
    rms = [float(np.sqrt(np.mean(values**2))) for values in (before, after)]
    return Curve(name, [marks[k] for k in order], before[order], after[order], *rms)


def _pair_marks(pairs: Pairs) -> list[str]:
    return [f"rows {i}, {j}" for i, j in zip(pairs.first, pairs.second, strict=True)]


def _thinned(curves: list[Curve], what: str, across: str) -> Curves:
    """No more marks than a picture shows; each rms is that of all."""
    count = sum(len(curve.before) for curve in curves)
    if count <= _MOST_MARKS:
        return Curves(curves, what, across)
    thin = []
    for curve in curves:
        share = _MOST_MARKS * len(curve.before) / count
        kept = thinned(len(curve.before), max(2, int(share)))
        thin.append(
            replace(
                curve,
                marks=[curve.marks[k] for k in kept],
                before=curve.before[kept],
                after=curve.after[kept],
            )
        )
    shown = sum(len(curve.before) for curve in thin)
    return Curves(thin, what, f"{across}; {shown:,} of {count:,} shown")
