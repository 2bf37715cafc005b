# SPDX-License-Identifier: BSD-3-Clause
"""bathyal xtf: what a side-scan's file holds, and its pictures."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk


class Picker(StrEnum):
    """Of the first return."""

    likelihood = "likelihood"
    threshold = "threshold"


def xtf(
    *,
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="A side-scan, .xtf, or a survey's folder.")
    ],
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="Folder for pictures and mosaic; made if missing."),
    ] = None,
    spacing: Annotated[
        float, typer.Option(help="Of the mosaic's cells \\[m].", metavar="SPACING")
    ] = 0.1,
    picker: Annotated[
        Picker, typer.Option(help="How the bottom's first return is found.")
    ] = Picker.likelihood,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Say what a side-scan's file holds; draw it, and lay it on the ground.

    With --out writes waterfall.png, ground.png (slant range corrected), bottom.csv (first returns
    and altitude), and where the file has positions mosaic.png and mosaic.tif, a GeoTIFF.

    [bold]Example:[/]

      bathyal xtf survey.xtf --out survey
    """
    from bathyal.sonar.describe import describe_record
    from bathyal.sonar.files import read_sonar
    from bathyal.sonar.sidescan_job import write_products

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        with progress("Reading"):
            record = read_sonar(file)
        with progress("Finding the bottom"):
            bottom = record.track_bottom(method=picker.value)
        facts = describe_record(record, bottom)
        files: list[str] = []
        warnings = list(record.warnings[:5])
        if out is not None:
            with progress("Drawing"):
                products = write_products(record, bottom, out, spacing=spacing)
            files = [str(path) for path in products.files]
            warnings += products.warnings
    talk.warn(warnings)
    rows = {**facts, **({"written": "\n".join(files)} if files else {})}
    talk.result({**facts, "warnings": warnings, "files": files}, rows)
