# SPDX-License-Identifier: BSD-3-Clause
"""What a side-scan's samples say as a whole: levels by angle and range, speckle, noise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bathyal.errors import argument_error
from bathyal.sonar.navigation import Floats

if TYPE_CHECKING:
    from bathyal.sonar.record import SonarRecord
    from bathyal.sonar.sidescan import BottomTrack

_LEAST_SAMPLES = 200  # of a bin
_RANGE_BINS = 30
_BLOCK = 16
_GUARD = 8  # samples of the water before the first return that are left out


@dataclass(frozen=True)
class SidescanStatistics:
    """Of port and starboard (beams), from samples taken as those of a level bottom.

    Levels are 10 log₁₀ of the median power over ln 2: the mean of an exponential distribution,
    which targets and shadows hardly move. NaN where a bin has fewer than 200 samples.

    Attributes
    ----------
    beam_names
        Of the rows.
    angle
        (K,) incidence, middles of the bins [rad]
    level_by_angle
        (beams, K) [dB]
    range
        (M,) slant range, middles of the bins [m]
    level_by_range
        (beams, M) [dB]
    water_level
        (beams,) before the first return [dB]
    contrast
        (beams,) standard deviation of the amplitude over its mean, the median of blocks of 16 pings
        by 16 samples; 0.523 is Rayleigh's speckle of one look.
    correlation_range
        (beams,) of the logarithm of the power with that of the next sample, in such blocks.
    correlation_ping
        (beams,) with that of the next ping.
    saturated
        (beams,) part of the samples that have the record's highest value, where that is of more
        than one.
    """

    beam_names: tuple[str, ...]
    angle: Floats
    level_by_angle: Floats
    range: Floats
    level_by_range: Floats
    water_level: Floats
    contrast: Floats
    correlation_range: Floats
    correlation_ping: Floats
    saturated: Floats


def statistics_of(
    record: SonarRecord, bottom: BottomTrack, *, angle_step: float
) -> SidescanStatistics:
    """`SonarRecord.statistics`."""
    if not 0.0 < angle_step <= np.pi / 4:
        raise argument_error("angle_step", "an angle above 0, to π/4", angle_step)
    power = np.asarray(record.intensity, float)
    ranges = np.asarray(record.range)
    edges = np.arange(0.0, np.pi / 2 + 0.5 * angle_step, angle_step)
    far = np.linspace(0.0, ranges[-1] + ranges[0], _RANGE_BINS + 1)
    top = np.nanmax(power)
    rows: dict[str, list[object]] = {}
    for beam in range(power.shape[1]):
        heard, first = power[:, beam], bottom.range[:, beam, None]
        ground = (ranges[None] > first) & np.isfinite(heard)
        with np.errstate(invalid="ignore"):
            incidence = np.arccos(np.clip(first / ranges[None], -1.0, 1.0))
        everywhere = np.broadcast_to(ranges, heard.shape)
        guard = 2.0 * ranges[0] * _GUARD
        water = (everywhere > 0.5 * first) & (everywhere < first - guard) & np.isfinite(heard)
        blocks = _blocks(heard, ground)
        at_top = float((heard == top).sum())
        for name, value in (
            ("level_by_angle", _levels(heard, incidence, ground, edges)),
            ("level_by_range", _levels(heard, everywhere, ground, far)),
            ("water_level", _level(heard[water])),
            ("contrast", _median(_contrasts(blocks))),
            ("correlation_range", _median(_correlations(blocks, 2))),
            ("correlation_ping", _median(_correlations(blocks, 1))),
            ("saturated", at_top / heard.size if (power == top).sum() > 1 else 0.0),
        ):
            rows.setdefault(name, []).append(value)
    return SidescanStatistics(
        record.beam_names,
        angle=0.5 * (edges[1:] + edges[:-1]),
        range=0.5 * (far[1:] + far[:-1]),
        **{name: np.array(values, float) for name, values in rows.items()},
    )


def _level(power: Floats) -> float:
    if len(power) < _LEAST_SAMPLES:
        return float("nan")
    with np.errstate(divide="ignore"):
        return float(10.0 * np.log10(np.median(power) / np.log(2.0)))


def _levels(power: Floats, key: Floats, wanted: NDArray[np.bool_], edges: Floats) -> Floats:
    found = np.digitize(key, edges) - 1
    return np.array([_level(power[wanted & (found == k)]) for k in range(len(edges) - 1)])


def _blocks(power: Floats, ground: NDArray[np.bool_]) -> Floats:
    """(B, 16, 16) blocks that are bottom all over and hear something everywhere."""
    pings, samples = (n // _BLOCK for n in power.shape)
    cut = np.s_[: pings * _BLOCK, : samples * _BLOCK]
    shape = (pings, _BLOCK, samples, _BLOCK)
    values = power[cut].reshape(shape).swapaxes(1, 2).reshape(-1, _BLOCK, _BLOCK)
    inside = ground[cut].reshape(shape).swapaxes(1, 2).reshape(-1, _BLOCK, _BLOCK)
    kept: Floats = values[inside.all(axis=(1, 2)) & (values > 0.0).all(axis=(1, 2))]
    return kept


def _contrasts(blocks: Floats) -> Floats:
    amplitude = np.sqrt(blocks)
    contrasts: Floats = amplitude.std(axis=(1, 2)) / amplitude.mean(axis=(1, 2))
    return contrasts


def _correlations(blocks: Floats, axis: int) -> Floats:
    logs = np.log(blocks)
    rest = logs - logs.mean(axis=(1, 2), keepdims=True)
    moved = np.moveaxis(rest, axis, -1)
    shared = (moved[..., 1:] * moved[..., :-1]).mean(axis=(1, 2))
    variance: Floats = (rest**2).mean(axis=(1, 2))
    return np.asarray(shared / np.maximum(variance, np.finfo(float).tiny), float)


def _median(values: Floats) -> float:
    return float(np.median(values)) if len(values) else float("nan")
