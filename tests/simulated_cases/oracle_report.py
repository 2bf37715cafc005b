# SPDX-License-Identifier: BSD-3-Clause
"""What an oracle says of a case: it shows that the cases are fair, and how well one could do."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.simulated_cases.arms import Array
from tests.simulated_cases.cases import Case
from tests.simulated_cases.effect_set import alternatives_of
from tests.simulated_cases.effect_shapes import Poses, column, project_out
from tests.simulated_cases.oracle import Oracle, chance


@dataclass
class OracleEffect:
    name: str
    joint: int | None
    parameters: dict[str, Any] = field(default_factory=dict)
    rows: list[int] = field(default_factory=list)


@dataclass
class OracleReport:
    verdict: str
    effects: list[OracleEffect]
    ambiguous: list[OracleEffect] = field(default_factory=list)


def oracle(case: Case) -> OracleReport:
    """Knows the noise, the true arm and the true settings; looks through the whole library."""
    sealed, noise = case.sealed, case.answer.noise
    poses = sealed.poses
    seen = column(poses, _moves(case)) / noise
    shapes = [*sealed.shapes, *alternatives_of(poses)]
    sight = Oracle.of(poses, shapes)
    seen = project_out(sight.known, seen)
    effects: list[OracleEffect] = []
    # Rounded joint values throw rows off, too, as far as half a step can.
    lattice = _on_a_lattice(sealed.q, poses.arm.sliding)
    keep = None if lattice else _grossly_off(sight, seen, poses)
    if keep is not None:
        off = np.flatnonzero(~keep)
        effects.append(OracleEffect("outliers", None, rows=[int(r) for r in off]))
        # A row of its own explains away all that is in it.
        mask = np.repeat(keep, seen.size // len(keep)).astype(float)
        sight.known = np.linalg.qr(sight.known * mask[:, None])[0]
        for i, b in enumerate(sight.bases):
            sight.bases[i] = np.linalg.qr(project_out(sight.known, b * mask[:, None]))[0]
        seen = project_out(sight.known, seen * mask)
    chosen, noisier = _chosen(case, sight, seen, lattice)
    effects += [
        OracleEffect(s.name, s.joint, dict(s.settings)) for s in (sight.shapes[i] for i in chosen)
    ]
    ambiguous = _ties(sight, seen, chosen)
    explained = sight.explained(seen, chosen)
    left = float(np.sum(seen**2)) - explained
    free = seen.size - sight.known.shape[1] - sum(sight.dims[i] for i in chosen)
    if noisier:
        effects.append(OracleEffect(noisier, None))
        left = float(free)
    beyond = left - free
    if beyond > 3.5 * np.sqrt(2 * free) and beyond > 0.25 * explained:
        return OracleReport("unknown", effects)
    if ambiguous:
        return OracleReport("ambiguous", effects, ambiguous)
    return OracleReport("named" if effects else "clean", effects)


def _chosen(case: Case, sight: Oracle, seen: Array, lattice: bool) -> tuple[list[int], str]:
    """Shapes against the noise that there is: where it is more than given, because values were
    rounded or because it grows with the distance, shapes have to explain more."""
    if not lattice and not _grows(case, sight, seen, sight.find(seen)):
        return sight.find(seen), ""
    chosen: list[int] = []
    for _ in range(6):  # from the noisiest reading down
        left = float(np.sum(seen**2)) - sight.explained(seen, chosen)
        free = seen.size - sight.known.shape[1] - sum(sight.dims[i] for i in chosen)
        found = sight.find(seen / np.sqrt(max(1.0, left / free)))
        if found == chosen:
            break
        chosen = found
    if lattice:
        return chosen, "quantisation"
    return chosen, "range_noise" if _grows(case, sight, seen, chosen) else ""


def _moves(case: Case) -> Array:
    """(N, 3 or 6) what the measurement shows beyond the true arm without effects, base's frame."""
    sealed, poses = case.sealed, case.sealed.poses
    frames = poses.arm.walk(sealed.q)
    if poses.point is not None:
        return -frames.tip
    turn, place = case.scene.base[:3, :3], case.scene.base[:3, 3]
    shift = (sealed.pose[:, :3, 3] - place) @ turn - frames.tip
    if not poses.pose:
        return np.asarray(shift)
    off = turn.T @ sealed.pose[:, :3, :3] @ np.swapaxes(frames.tool, 1, 2)
    off = (off - np.swapaxes(off, 1, 2)) / 2
    return np.hstack([shift, np.column_stack([off[:, 2, 1], off[:, 0, 2], off[:, 1, 0]])])


def _grossly_off(sight: Oracle, seen: Array, poses: Poses) -> Array | None:
    """(N,) rows to keep, or None where all are: those go that lie off by more than chance, after
    the best that shapes can do, most first."""
    rows = len(poses.q)
    keep = np.ones(rows, bool)
    left = seen - _fitted(sight, seen, sight.find(seen, most=4))
    square = np.sum(left.reshape(rows, -1) ** 2, axis=1)
    scale = np.median(square) / 2.37  # the median of chi squared of three degrees
    keep[square > chance(3, 0.01 / rows) * max(scale, 1.0)] = False
    return None if keep.all() or (~keep).sum() > 0.1 * rows else keep


def _fitted(sight: Oracle, seen: Array, chosen: list[int]) -> Array:
    if not chosen:
        return np.zeros_like(seen)
    span = np.linalg.qr(np.hstack([sight.bases[i] for i in chosen]))[0]
    return np.asarray(span @ (span.T @ seen))


def _ties(sight: Oracle, seen: Array, chosen: list[int]) -> list[OracleEffect]:
    """Causes that would do as well in a chosen one's place."""
    out: list[OracleEffect] = []
    for i in chosen:
        gains = sight.gains(seen, [c for c in chosen if c != i])
        net = gains - [sight.penalty(k) for k in range(len(gains))]
        near = [k for k in np.flatnonzero(net > net[i] - 0.5) if k not in chosen or k == i]
        causes = {sight.shapes[k].cause: sight.shapes[k] for k in near}
        if len(causes) > 1:
            out += [OracleEffect(s.name, s.joint) for s in causes.values()]
    return out


def _on_a_lattice(q: Array, sliding: Array) -> bool:
    """Whether all joint values are multiples of one step, coarser than a file's digits."""
    values = np.unique(np.abs(np.round(q[:, ~sliding.astype(bool)], 12)))
    gaps = np.diff(values)
    gaps = gaps[gaps > 1e-9]
    step = gaps.min() if len(gaps) else 0.0
    if step < 1e-6:
        return False
    parts = values / step
    return bool(np.max(np.abs(parts - np.round(parts))) < 1e-3)


def _grows(case: Case, sight: Oracle, seen: Array, chosen: list[int]) -> bool:
    """Whether noise that grows with the distance is the likelier one."""
    sealed = case.sealed
    if sealed.point is not None or sealed.poses.pose:
        return False
    left = (seen - _fitted(sight, seen, chosen)).reshape(-1, 3)
    far = np.linalg.norm(sealed.pose[:, :3, 3], axis=1)[:, None] ** 2
    far = far / far.mean()

    def likelihood(rate: float) -> float:
        variance = 1 + rate**2 * far
        return float(-0.5 * np.sum(left**2 / variance + np.log(variance)))

    flat = [-0.5 * left.size * (np.log(v) + np.mean(left**2) / v) for v in (1.0, np.mean(left**2))]
    return max(likelihood(r) for r in np.linspace(0.3, 6, 60)) - max(flat) > 5.0
