# SPDX-License-Identifier: BSD-3-Clause
"""bathyal scenario example: an arm on a vehicle over a generated bottom, to try things on."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk
from bathyal.cli.values import given, seed_number


def example(
    *,
    out: Annotated[Path, typer.Argument(metavar="FOLDER", help="Made where it is missing.")],
    seed: Annotated[
        int | None,
        typer.Option(
            help="Of the bottom. [dim]\\[default: 0][/]", parser=seed_number, metavar="NUMBER"
        ),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Write a scenario: the arm of Maevskiy, Zanin (2020) on a hull, over a bottom, with a modem's
    beam to keep out of.

    Writes scenario.yaml hull.stl seabed.ply.

    [bold]Example:[/]

      bathyal scenario example scene
    """
    from bathyal.workspace.example import write_example

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress, progress("Writing"):
        files = [str(path) for path in write_example(out, **given(seed=seed))]
    talk.result({"files": files}, {"written": " ".join(files)})
