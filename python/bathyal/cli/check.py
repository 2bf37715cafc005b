# SPDX-License-Identifier: BSD-3-Clause
"""bathyal check: may the arm be sent to a scenario's targets?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli import scenario_options as own
from bathyal.cli.talk import Talk

NOT_FREE = 3


def check(
    *,
    scenario: own.ScenarioFile,
    inside: own.Inside = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="Also write the targets to a table, .csv."),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Say whether the arm may begin where it is and be sent to each target.

    A target is inside the hull, in a keep-out, in the ground, out of reach, reached only in
    collision, only at a limit, or free. The exit code is 3 where a target or the start is refused.

    [bold]Example:[/]

      bathyal check scene/scenario.yaml
    """
    from bathyal.view.brief import short_warnings
    from bathyal.workspace.check_job import check_scenario
    from bathyal.workspace.scenario import read_scenario

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        with progress("Reading"):
            read = read_scenario(scenario, inside=inside)
        with progress("Checking"):
            found = check_scenario(read)
        if out is not None:
            found.write_table(out)
    talk.warn(short_warnings(read.warnings))
    talk.verdict(found.summary, str(found.brief))
    if not found.free:
        raise typer.Exit(NOT_FREE)
