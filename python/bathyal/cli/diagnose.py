# SPDX-License-Identifier: BSD-3-Clause
"""bathyal diagnose: measured data in, a folder that says what the simulation gets wrong out."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli import touch_options as own
from bathyal.cli.talk import Talk


def diagnose(
    *,
    data: Annotated[
        list[Path],
        typer.Argument(
            metavar="DATA",
            help="A table of touches as bathyal identify takes it, or a table for each point. With "
            "--tracked a table of measured poses, or one for each session.",
        ),
    ],
    job: own.Job,
    reading: own.TouchColumns,
    beside: own.CovariateColumns,
    known: own.Known,
    nested: Annotated[
        int,
        typer.Option(
            min=0,
            max=50,
            metavar="K",
            help="Also hold out each of K parts of tracked poses from the whole diagnosis, the "
            "choice of causes included; takes as long as K more.",
        ),
    ] = 0,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Say what the simulation of an arm gets wrong: show it, name the cause, extend the model and
    measure the gain on held-out data.

    Prints a verdict, a few numbers and the next step.

    Writes model.json report.html report.json report.png residuals.csv, all or none, and
    bathyal-manifest.json with their hashes. Whatever the verdict, clean, named, ambiguous,
    unknown or none, the exit code is 0.

    [bold]Examples:[/]

      bathyal diagnose touches.csv --arm ur10e --out diagnosis

      bathyal diagnose tracked.csv --tracked --arm my.urdf -o diagnosis

      bathyal diagnose monday.csv tuesday.csv --tracked --arm ur10 --temperature T_arm_C
      --covariate pressure=P_bar -o diagnosis
    """
    from bathyal.diagnosis.job import diagnose_files
    from bathyal.view.brief import short_warnings

    talk = Talk(json=json, quiet=quiet)
    nominal = job.nominal()
    read = {**reading.keywords(), **beside.keywords(), **known.keywords()}
    with talk.progress() as progress:
        options = {"nested": nested} if nested else {}
        found = diagnose_files(
            data, nominal, tracked=job.tracked, read=read, options=options, step=progress
        )
        files = found.write(job.out, title=job.title(nominal, data), step=progress)
    talk.warn(short_warnings(found.warnings))
    talk.brief(
        {**found.summary, "files": [str(file) for file in files]}, str(found.brief), job.out, files
    )
