# SPDX-License-Identifier: BSD-3-Clause
"""What the commands about scenarios share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

ScenarioFile = Annotated[
    Path,
    typer.Argument(
        metavar="SCENARIO",
        help="A .yaml file with arm, hull, keep-outs, scene, vehicle and targets; "
        "`bathyal scenario example` writes one.",
    ),
]
Inside = Annotated[
    Path | None,
    typer.Option(
        help="Folder in which the files that the scenario names may lie, in place of its own.",
        show_default=False,
    ),
]
OutFolder = Annotated[
    Path, typer.Option("--out", "-o", help="Folder for the results; made if missing.")
]
