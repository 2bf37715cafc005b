# SPDX-License-Identifier: BSD-3-Clause
"""bathyal survey: a sonar flown over a world."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk
from bathyal.cli.values import given, seed_number


def survey(
    *,
    world: Annotated[
        Path,
        typer.Argument(metavar="WORLD", help="A .yaml file; `bathyal world --example` makes one."),
    ],
    track: Annotated[
        Path,
        typer.Option(
            "--track", "-t", help="Table of x, y, z and time or heading_deg, .csv.", metavar="FILE"
        ),
    ],
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Folder for the results; made if missing.")
    ],
    sonar: Annotated[
        str, typer.Option(help="A sonar by its name in bathyal.sonars.", metavar="PRESET")
    ] = "side_scan",
    physics: Annotated[
        str, typer.Option(help='"real": every effect on, or "off".', metavar="real|off")
    ] = "real",
    speed: Annotated[
        float | None, typer.Option(help="Where the track has no time \\[m/s].", metavar="SPEED")
    ] = None,
    max_range: Annotated[
        float | None,
        typer.Option("--range", help="In place of the sonar's own \\[m].", metavar="RANGE"),
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option(
            help="Of the random numbers. [dim]\\[default: 0][/]",
            parser=seed_number,
            metavar="NUMBER",
        ),
    ] = None,
    navigation: Annotated[
        str | None,
        typer.Option(
            help="What the vehicle reports: inertial, compass or usbl. "
            "[dim]\\[default: the truth][/]",
            metavar="CLASS",
        ),
    ] = None,
    truth: Annotated[
        bool,
        typer.Option("--truth", help="Keep what each sample came from: twelve times the size."),
    ] = False,
    overwrite: Annotated[
        bool,
        typer.Option("--overwrite", help="Replace another survey that is in the folder."),
    ] = False,
    inside: Annotated[
        Path | None,
        typer.Option(
            help="Folder in which the files that the world names may lie, in place of its own.",
            show_default=False,
        ),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Fly a sonar over a world, and write what it hears.

    Writes survey.zarr, which holds all axes, and of a side-scan survey.xtf and survey.png. A survey
    that was interrupted is continued by the same command.

    [bold]Example:[/]

      bathyal survey sea/world.yaml --track sea/track.csv --out sea/survey
    """
    from bathyal.sonar.survey_job import run_survey, sonar_named

    talk = Talk(json=json, quiet=quiet)
    made = sonar_named(sonar, physics)
    if max_range is not None:
        made = made.replace(range=max_range)
    with talk.progress() as progress, progress("Listening") as tell:
        result = run_survey(
            world, track, out, sonar=made, speed=speed, inside=inside, navigation=navigation,
            truth=truth, overwrite=overwrite,
            progress=lambda done, total: tell(done / total, f"Ping {done:,} of {total:,}"),
            **given(seed=seed),
        )  # fmt: skip
    talk.warn(list(result.record.warnings[:5]))
    files = [str(path) for path in result.files]
    talk.result(
        {"pings": len(result.record), "files": files},
        {"pings": f"{len(result.record):,}", "written": "\n".join(files)},
    )
