# SPDX-License-Identifier: BSD-3-Clause
"""A survey in memory."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from bathyal._core import Ping, Sonar, Trajectory, World
from bathyal.sonar.navigation import Floats, true_navigation
from bathyal.sonar.record import RecordTruth, SonarRecord

Progress = Callable[[int, int], object]


class _Collector:
    """Keeps pings as rows of arrays."""

    def __init__(self, sonar: Sonar, count: int, truth: bool, progress: Progress | None) -> None:
        shape = (count, len(sonar.beam_names), sonar.samples)
        self.intensity = np.zeros(shape, np.float32)
        self.altitude = np.full(count, np.nan)
        self.time = np.zeros(count)
        self.pose = np.zeros((count, 4, 4))
        self.truth = None
        if truth:
            self.truth = RecordTruth(
                np.zeros(shape), np.zeros(shape), np.zeros(shape, np.int32),
                np.zeros((*shape, 3)), self.pose,
            )  # fmt: skip
        self.warnings: list[str] = []
        self.sound_speed = 1500.0
        self._done = 0
        self._progress = progress

    def keep(self, ping: Ping, number: int, pose: Floats) -> bool:
        row = self._done
        self.intensity[row] = ping.intensity
        self.altitude[row], self.time[row], self.pose[row] = ping.altitude, ping.time, pose
        if self.truth is not None:
            for name in ("range", "incidence", "material", "point"):
                getattr(self.truth, name)[row] = getattr(ping.truth, name)
        self.sound_speed = ping.sound_speed
        self.warnings += [f"ping {number}: {text}" for text in ping.warnings]
        self._done += 1
        return self._progress is None or self._progress(self._done, len(self.time)) is not False


def survey(
    sonar: Sonar,
    world: World,
    trajectory: Trajectory,
    *,
    seed: int = 0,
    truth: bool = False,
    progress: Progress | None = None,
    num_threads: int = 0,
) -> SonarRecord:
    """`Sonar.survey`."""
    times = sonar.ping_times(trajectory)
    kept = _Collector(sonar, len(times), truth, progress)
    sonar.hear(world, trajectory, kept.keep, seed=seed, num_threads=num_threads)
    done = kept._done
    navigation = true_navigation(kept.time[:done], kept.pose[:done], kept.altitude[:done])
    middles = (np.arange(sonar.samples, dtype=np.float64) + 0.5) * (sonar.range / sonar.samples)
    return SonarRecord(
        kept.time[:done], kept.intensity[:done], middles, tuple(sonar.beam_names), navigation,
        kept.truth, sonar, None, tuple(kept.warnings),
        kept.sound_speed,
    )  # fmt: skip
