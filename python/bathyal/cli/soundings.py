# SPDX-License-Identifier: BSD-3-Clause
"""bathyal soundings: a generated survey, to try things on."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal._core import generate_survey
from bathyal.cli import options as opt
from bathyal.cli.talk import Talk
from bathyal.cli.values import default_note, given, seed_number
from bathyal.seabed.clouds import write_cloud


def soundings(
    *,
    out: Annotated[
        Path, typer.Argument(metavar="OUT", help="Soundings to write: .xyz .csv .ply or .vtp.")
    ],
    aims_out: Annotated[
        Path | None, typer.Option(help="Also write camera axes that fit the survey, .csv.")
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option(
            help="Of the random numbers. " + default_note(generate_survey, "seed"),
            parser=seed_number,
            metavar="NUMBER",
        ),
    ] = None,
    length: Annotated[
        float | None,
        typer.Option(help="Along x \\[m]. " + default_note(generate_survey, "length")),
    ] = None,
    width: Annotated[
        float | None,
        typer.Option(help="Along y \\[m]. " + default_note(generate_survey, "width")),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Generate soundings of a seabed: sand waves, boulders, a trench, a lost stripe, noise.

    [bold]Example:[/]

      bathyal soundings survey.xyz --seed 7 --aims-out aims.csv
    """
    from bathyal.toolpath.example_aims import aims_over, write_aims

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        with progress("Generating"):
            cloud = generate_survey(**given(seed=seed, length=length, width=width))
        with progress("Writing"):
            write_cloud(cloud, out)
            if aims_out is not None:
                write_aims(aims_over(cloud), aims_out)
    files = [str(path) for path in (out, aims_out) if path is not None]
    rows = {"soundings": f"{len(cloud):,}", "written": "\n".join(files)}
    talk.result({"soundings": len(cloud), "files": files}, rows)
