# SPDX-License-Identifier: BSD-3-Clause
"""A survey as a job: a world's file, a sonar, a track; a folder of results."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path

from bathyal import sonars
from bathyal._core import NavigationErrors, Sonar, World
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, replacing
from bathyal.sonar.record import SonarRecord
from bathyal.sonar.store import is_record
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
    navigation: str | None = None,
    truth: bool = False,
    overwrite: bool = False,
    inside: PathLike | None = None,
    progress: Progress | None = None,
) -> SurveyResult:
    """Hears a world's file along a track's file, and writes the record and its picture.

    Parameters
    ----------
    world, track : path
        As `bathyal.read_world` and `bathyal.read_track`.
    out : path
        A folder, made where it is missing. An interrupted survey in it is continued.
    sonar : Sonar
    speed : float, optional
        [m/s], where the track has no time.
    seed : int
    navigation : str, optional
        A name of `NavigationErrors.preset`; the truth unless given.
    truth : bool
        As `Sonar.survey`.
    overwrite : bool
        Whether another survey in the folder is replaced.
    inside : path, optional
        As `bathyal.read_world`.
    progress : function, optional
        As `Sonar.survey`.

    Returns
    -------
    SurveyResult
        `files`: survey.zarr, with all axes; of a side-scan survey.xtf and survey.png too.

    Raises
    ------
    ValueError
        For a folder that holds another survey.
    """
    heard = read_world(world, inside=inside)
    trajectory = read_track(track, speed=speed)
    errors = NavigationErrors() if navigation is None else NavigationErrors.preset(navigation)
    folder = Path(out)
    store = folder / "survey.zarr"
    if overwrite and is_record(store):
        shutil.rmtree(store)
    record = sonar.survey(
        heard, trajectory, seed=seed, navigation=errors, truth=truth, out=store, progress=progress
    )
    files = [store]
    if sonar.kind == "side_scan":
        files += [folder / "survey.xtf", folder / "survey.png"]
        record.write(files[1])
        picture = record.plot()
        with replacing(files[2]) as path:
            picture.savefig(path, format="png")
    return SurveyResult(record, heard, files)
