# SPDX-License-Identifier: BSD-3-Clause
"""bathyal info: what a file holds."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk


def info(
    *,
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Soundings or a mesh.")],
    reading: opt.Reading,
    as_mesh: opt.AsMesh = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Say what a file holds: how much, where, how dense, and for a mesh how sound it is.

    [bold]Examples:[/]

      bathyal info survey.xyz

      bathyal info coral.ply --json
    """
    from bathyal.seabed.bottom import noting, read_either
    from bathyal.seabed.describe import describe

    talk = Talk(json=json, quiet=quiet)
    warnings: list[str] = []
    with talk.progress() as progress:
        with progress("Reading"), noting(warnings):
            what = read_either(file, as_mesh, reading.keywords())
        with progress("Looking at it"):
            data, rows = describe(what)
    talk.warn(warnings)
    talk.result({"file": str(file), **data, "warnings": warnings}, rows, title=file.name)
