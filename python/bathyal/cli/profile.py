# SPDX-License-Identifier: BSD-3-Clause
"""bathyal profile: what a cast of the water holds."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk


def profile(
    *,
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="A cast: CTD, sound velocity or XBT.")
    ],
    plot: Annotated[
        Path | None,
        typer.Option("--plot", metavar="PICTURE", help="Draw it: .png, .pdf or .svg."),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="CSV", help="Write the way down as a table."),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Say what a cast holds: where and when it was taken, its rows, its range of sound speeds.

    [bold]Examples:[/]

      bathyal profile cast.csv

      bathyal profile cast.cnv --plot cast.png --out cast.csv
    """
    from bathyal.io.tables import write_table
    from bathyal.water.casts import read_profile
    from bathyal.water.describe import describe, noting_ranges, rows_of

    talk = Talk(json=json, quiet=quiet)
    warnings: list[str] = []
    with talk.progress() as progress:
        with progress("Reading"), noting_ranges(warnings):
            cast = read_profile(file)
            data, rows = describe(cast)
            titles, table = rows_of(cast) if out is not None else ([], [])
        if plot is not None:
            with progress("Drawing"), noting_ranges([]):
                cast.plot(plot)
            data["plot"] = str(plot)
    if out is not None:
        write_table(out, titles, table)
        data["out"] = str(out)
    talk.warn(warnings)
    talk.result({"file": str(file), **data, "warnings": warnings}, rows, title=file.name)
