# SPDX-License-Identifier: BSD-3-Clause
"""A survey in memory, or into a folder."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import NavigationErrors, Ping, Sonar, Trajectory, World
from bathyal.errors import argument_error
from bathyal.io.files import PathLike
from bathyal.sonar.columns import (
    COLUMNS,
    REPORTED,
    fill_row,
    names_of_survey,
    record_of_columns,
    tail_of,
)
from bathyal.sonar.navigation import Floats
from bathyal.sonar.record import SonarRecord
from bathyal.sonar.store import RecordStore

Progress = Callable[[int, int], object]


class _Survey:
    """What the pings of a survey have in common."""

    def __init__(
        self, sonar: Sonar, world: World, trajectory: Trajectory, seed: int, truth: bool,
        navigation: NavigationErrors | None, num_threads: int,
    ) -> None:  # fmt: skip
        self.sonar, self.world, self.trajectory = sonar, world, trajectory
        self.seed, self.truth, self.num_threads = seed, truth, num_threads
        self.errors = navigation if navigation is not None else NavigationErrors()
        self.times = sonar.ping_times(trajectory)
        self.reported = self.errors.report(
            trajectory, self.times, surface=world.water.surface, seed=seed
        )
        self.names = names_of_survey(truth)
        self.shape = (len(self.times), len(sonar.beam_names), sonar.samples)

    def room(self, rows: int) -> dict[str, NDArray[Any]]:
        """Columns for some pings."""
        _, beams, samples = self.shape
        made = {}
        for name in self.names:
            column = COLUMNS[name]
            made[name] = np.full(
                (rows, *tail_of(column, beams, samples)), column.fill, column.dtype
            )
        return made

    def hear(
        self, first: int, count: int, rows: dict[str, NDArray[Any]], go_on: Callable[[], bool]
    ) -> int:
        """Fills rows with the pings from `first` on. Returns how many."""
        done = 0

        def keep(ping: Ping, number: int, pose: Floats) -> bool:
            nonlocal done
            fill_row(rows, done, ping, pose)
            rows["altitude"][done] = self.errors.report_altitude(
                [ping.altitude], first=number, seed=self.seed
            )[0]
            rows["time"][done] = ping.time
            done += 1
            return go_on()

        self.sonar.hear(
            self.world, self.trajectory, keep, seed=self.seed, first=first, count=count,
            truth=self.truth, num_threads=self.num_threads,
        )  # fmt: skip
        return done

    def report(self, first: int, rows: dict[str, NDArray[Any]]) -> None:
        """The reported columns of the pings from `first` on."""
        for name in REPORTED:
            rows[name][:] = getattr(self.reported, name)[first : first + len(rows[name])]

    def notes(self) -> dict[str, Any]:
        """By which a folder is known to be of this survey. The world counts by what the first ping
        hears."""
        track = hashlib.sha256()
        track.update(np.asarray(self.trajectory.time).tobytes())
        track.update(np.asarray(self.trajectory.pose).tobytes())
        heard = hashlib.sha256()

        def first(ping: Ping, _number: int, _pose: Floats) -> bool:
            for values in (ping.intensity, ping.truth.range, ping.truth.material):
                heard.update(np.asarray(values).tobytes())
            return False

        self.sonar.hear(
            self.world, self.trajectory, first, seed=self.seed, count=1,
            num_threads=self.num_threads,
        )  # fmt: skip
        return {
            "sonar": self.sonar.to_dict(),
            "beam_names": list(self.sonar.beam_names),
            "spacing": self.sonar.range / self.sonar.samples,
            "start": None,
            "warnings": [],
            "survey": {
                "seed": self.seed,
                "truth": self.truth,
                "navigation": self.errors.to_dict(),
                "trajectory": track.hexdigest(),
                "world": heard.hexdigest(),
            },
        }


def survey(
    sonar: Sonar,
    world: World,
    trajectory: Trajectory,
    *,
    seed: int = 0,
    truth: bool = False,
    navigation: NavigationErrors | None = None,
    out: PathLike | None = None,
    first: int = 0,
    count: int = -1,
    progress: Progress | None = None,
    num_threads: int = 0,
) -> SonarRecord:
    """`Sonar.survey`."""
    if not isinstance(world, World):
        raise argument_error("world", "a World", type(world).__name__)
    job = _Survey(sonar, world, trajectory, seed, truth, navigation, num_threads)
    pings = job.shape[0]
    if not 0 <= first <= pings:
        raise argument_error("first", f"one of the survey's {pings} pings", first)
    if not -1 <= count <= pings - first:
        raise argument_error("count", f"-1 or at most the {pings - first} pings left", count)
    end = pings if count < 0 else first + count
    if out is None:
        return _in_memory(job, first, end, progress)
    return _on_disk(job, Path(out), first, end, progress)


def _in_memory(job: _Survey, first: int, end: int, progress: Progress | None) -> SonarRecord:
    rows = job.room(end - first)
    done = job.hear(first, end - first, rows, _counter(progress, 0, end - first))
    rows = {name: column[:done] for name, column in rows.items()}
    job.report(first, rows)
    spacing = job.sonar.range / job.sonar.samples
    return record_of_columns(rows, spacing, tuple(job.sonar.beam_names), sonar=job.sonar)


def _on_disk(
    job: _Survey, folder: Path, first: int, end: int, progress: Progress | None
) -> SonarRecord:
    """Chunk by chunk, those that are missing. Of a chunk that is interrupted, what was heard is
    kept."""
    store = RecordStore.make(folder, job.notes(), job.names, job.shape)
    runs = list(store.missing(first, end))
    go_on = _counter(progress, end - first - sum(stop - start for start, stop in runs), end - first)
    for start, stop in runs:
        rows = job.room(stop - start)
        try:
            done = job.hear(start, stop - start, rows, go_on)
        except BaseException:
            _put(job, store, start, int(np.isfinite(rows["time"]).sum()), rows)
            raise
        _put(job, store, start, done, rows)
        if done < stop - start:
            break
    return store.record()


def _put(
    job: _Survey, store: RecordStore, start: int, done: int, rows: dict[str, NDArray[Any]]
) -> None:
    if done == 0:
        return
    heard = {name: column[:done] for name, column in rows.items()}
    job.report(start, heard)
    store.put(start, heard)


def _counter(progress: Progress | None, done: int, total: int) -> Callable[[], bool]:
    """Reports one ping more each time; whether to go on."""

    def go_on() -> bool:
        nonlocal done
        done += 1
        return progress is None or progress(done, total) is not False

    return go_on
