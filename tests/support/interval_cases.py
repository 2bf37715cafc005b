# SPDX-License-Identifier: BSD-3-Clause
"""Many identifications of arms whose truth is known, and whether their intervals hold it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import bathyal
from tests.support.touch_simulation import (
    NOISE,
    POINTS,
    Array,
    changed,
    distances_of,
    identified_ur10e,
    moved_to,
    scattered,
    shift,
    touching,
)

Truth = Callable[[int, str], float]
"""By the number of the set and the name of a parameter."""


@dataclass(frozen=True)
class Shown:
    """What many fits of one truth say of each parameter (K,) that the data tell."""

    names: list[str]
    bias: Array
    """Mean error by the scatter of the values found."""
    covered: Array
    """Share of 95 % intervals that hold the truth."""
    spread: Array
    """Scatter of the values found by the standard deviation reported."""
    count: int

    def allows(self, coverage: tuple[float, float], bias: float, sigmas: float = 4.5) -> bool:
        """Whether all stay within the bounds, but for what chance does to so few sets."""
        share = sigmas * np.sqrt(0.95 * 0.05 / self.count)
        return bool(
            (self.covered > coverage[0] - share).all()
            and (self.covered < coverage[1] + share).all()
            and (np.abs(self.bias) < bias + sigmas / np.sqrt(self.count)).all()
        )


def show(fits: Sequence[Any], truth: Truth, statuses: tuple[str, ...] = ("identified",)) -> Shown:
    first = fits[0].parameters
    chosen = [
        k for k, p in enumerate(first) if p.status in statuses and not p.name.startswith("base_r")
    ]
    names = [first[k].name for k in chosen]
    value = np.array([[fit.parameters[k].value for k in chosen] for fit in fits])
    std = np.array([[fit.parameters[k].std for k in chosen] for fit in fits])
    error = value - [[truth(number, name) for name in names] for number in range(len(fits))]
    return Shown(
        names,
        error.mean(axis=0) / error.std(axis=0),
        (np.abs(error) < 1.96 * std).mean(axis=0),
        error.std(axis=0) / np.sqrt((std**2).mean(axis=0)),
        len(fits),
    )


def _values(fit: Any) -> Truth:
    """The truth as exact data give it back, where base and tool take what they can."""
    values = {p.name: p.value for p in fit.parameters}
    return lambda _, name: float(values[name])


def tracked(sets: int) -> tuple[list[Any], Truth]:
    """63 positions of the paper's UR10e, as a tracker sees them; the base free.

    Turns of the base are given about the base that the nominal arm has in each set: they have no
    truth of their own, and are left out.
    """
    truth, nominal = identified_ur10e(), bathyal.arms.ur10e()
    random = np.random.default_rng(7)
    q, _ = touching(truth, POINTS, 21, cone_deg=60, seed=3)
    tips = truth.forward(q)[:, :3, 3]
    seen = (tips + random.normal(0, NOISE, tips.shape) for _ in range(sets))
    fits = [bathyal.identify_arm(nominal, bathyal.Tracked(q, tip)) for tip in seen]
    return fits, _values(bathyal.identify_arm(nominal, bathyal.Tracked(q, tips)))


def _touched(
    truth: bathyal.Arm,
    nominal: bathyal.Arm,
    q: Array,
    points: Any,
    distances: dict[tuple[int, int], float],
    noise: float,
    sets: int,
) -> tuple[list[Any], Truth]:
    random = np.random.default_rng(7)
    std = 1e-4
    fits = []
    for _ in range(sets):
        measured = {pair: metres + random.normal(0, std) for pair, metres in distances.items()}
        touches = bathyal.Touches(
            scattered(truth, q, noise, random), points, known_distances=measured, distance_std=std
        )
        fits.append(bathyal.identify_arm(nominal, touches))
    exact = bathyal.Touches(q, points, known_distances=distances)
    return fits, _values(bathyal.identify_arm(nominal, exact))


def with_distances(sets: int) -> tuple[list[Any], Truth]:
    """63 touches of the paper's UR10e, the three distances given to 0.1 mm."""
    truth = identified_ur10e()
    q, points = touching(truth, POINTS, 21, cone_deg=60, seed=3)
    distances = distances_of(POINTS, [(0, 1), (0, 2), (1, 2)])
    return _touched(truth, bathyal.arms.ur10e(), q, points, distances, NOISE, sets)


def sockets(sets: int) -> tuple[list[Any], Truth]:
    """400 touches of a Panda in ten pairs of sockets 50 mm apart, given to 0.1 mm.

    Many touches and short distances: what scatter does to the size shows here.
    """
    nominal = bathyal.arms.panda()
    random = np.random.default_rng(11)
    truth = changed(
        nominal, {f"{c}_{k}": random.normal(0, 1e-3) for c in "ad" for k in range(2, 6)}
    )
    truth.tool = shift(0.01, -0.02, 0.1)
    first = random.uniform([0.3, -0.4, 0.05], [0.6, 0.4, 0.4], (10, 3))
    apart = random.normal(size=(10, 3))
    second = first + 0.05 * apart / np.linalg.norm(apart, axis=1)[:, None]
    places = np.vstack([first, second])
    q, points = touching(truth, places, 20, cone_deg=40, seed=5)
    distances = distances_of(places, [(k, k + 10) for k in range(10)])
    return _touched(truth, nominal, q, points, distances, 0.17e-3, sets)


def without_distances(sets: int) -> tuple[list[Any], Truth]:
    """63 touches, no distance: another arm in each set, its lengths off by what the prior says (1
    mm) and its angles by 1 mrad, for a prior is right over many arms or not at all."""
    nominal = bathyal.arms.ur10e()
    nominal.tool = shift(0.01, -0.02, 0.15)
    q, points = touching(nominal, POINTS, 21, cone_deg=60, seed=3)
    first = bathyal.identify_arm(nominal, bathyal.Touches(q, points)).parameters
    free = [p.name for p in first if p.status != "gauge" and p.group != "tool"]
    random = np.random.default_rng(7)
    fits, changes = [], []
    for _ in range(sets):
        changes.append({name: random.normal(0, 1e-3) for name in free})
        arm = changed(nominal, changes[-1])
        exact = moved_to(arm, q, POINTS[points])
        touches = bathyal.Touches(scattered(arm, exact, NOISE, random), points)
        fits.append(bathyal.identify_arm(nominal, touches))
    start = {p.name: p.nominal for p in first}
    return fits, lambda number, name: start[name] + changes[number].get(name, 0.0)


CASES: dict[str, Callable[[int], tuple[list[Any], Truth]]] = {
    "tracked": tracked,
    "with_distances": with_distances,
    "sockets": sockets,
    "without_distances": without_distances,
}
COLUMNS = {"tracked": 24, "with_distances": 21, "sockets": 25, "without_distances": 14}
"""Numbers that the data tell in each case."""
