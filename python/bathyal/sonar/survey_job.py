# SPDX-License-Identifier: BSD-3-Clause
"""A survey as a job: a world's file, a sonar, a track; a folder of results."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bathyal import sonars
from bathyal._core import Sonar, World
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, replacing
from bathyal.sonar.record import SonarRecord
from bathyal.sonar.survey import Progress
from bathyal.sonar.tracks import read_track
from bathyal.world.files import read_world


@dataclass(frozen=True)
class SurveyResult:
    """What a survey wrote."""

    record: SonarRecord
    world: World
    files: list[Path]


def sonar_named(name: str, physics: str) -> Sonar:
    """A sonar of `bathyal.sonars` by its name.

    Raises
    ------
    ValueError
        For a name that is none of them.
    """
    if name not in sonars.__all__:
        raise argument_error("sonar", "one of " + ", ".join(sonars.__all__), name)
    made: Sonar = getattr(sonars, name)(physics=physics)
    return made


def run_survey(
    world: PathLike,
    track: PathLike,
    out: PathLike,
    *,
    sonar: Sonar,
    speed: float | None = None,
    seed: int = 0,
    inside: PathLike | None = None,
    progress: Progress | None = None,
) -> SurveyResult:
    """Hears a world's file along a track's file, and writes the record and its picture.

    Parameters
    ----------
    world, track : path
        As `bathyal.read_world` and `bathyal.read_track`.
    out : path
        A folder, made where it is missing.
    sonar : Sonar
    speed : float, optional
        [m/s], where the track has no time.
    seed : int
    inside : path, optional
        As `bathyal.read_world`.
    progress : function, optional
        As `Sonar.survey`.

    Returns
    -------
    SurveyResult
        `files`: survey.xtf and survey.png of a side-scan; survey.npz of all others.
    """
    heard = read_world(world, inside=inside)
    trajectory = read_track(track, speed=speed)
    record = sonar.survey(heard, trajectory, seed=seed, progress=progress)
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    if sonar.kind == "side_scan":
        files = [folder / "survey.xtf", folder / "survey.png"]
        record.write(files[0])
        picture = record.plot()
        with replacing(files[1]) as path:
            picture.savefig(path, format="png")
    else:
        files = [folder / "survey.npz"]
        with replacing(files[0]) as path, open(path, "wb") as stream:
            np.savez(
                stream, time=record.time, intensity=record.intensity, range=record.range,
                position=record.navigation.position, heading=record.navigation.heading,
            )  # fmt: skip
    return SurveyResult(record, heard, files)
