# SPDX-License-Identifier: BSD-3-Clause
"""bathyal reach: where a scenario's arm can be."""

from __future__ import annotations

from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli import scenario_options as own
from bathyal.cli.talk import Talk
from bathyal.cli.values import given, length, seed_number


def reach(
    *,
    scenario: own.ScenarioFile,
    out: own.OutFolder,
    inside: own.Inside = None,
    voxel: Annotated[
        float | None,
        typer.Option(
            help="Edge of a voxel. [dim]\\[default: 5cm][/]", parser=length, metavar="LENGTH"
        ),
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option(
            help="Of the postures. [dim]\\[default: 0][/]", parser=seed_number, metavar="NUMBER"
        ),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Map where the tip of the arm can be, and where it keeps clear of hull, keep-outs and bottom.

    Writes reach.json reach.npz reach.png, all or none, and bathyal-manifest.json with their hashes.

    [bold]Example:[/]

      bathyal reach scene/scenario.yaml --out reach
    """
    from bathyal.view.brief import short_warnings
    from bathyal.workspace.reach_job import reach_of
    from bathyal.workspace.scenario import read_scenario

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        with progress("Reading"):
            read = read_scenario(scenario, inside=inside)
        with progress("Mapping"):
            found = reach_of(read, **given(voxel=voxel, seed=seed))
        files = found.write(out, step=progress)
    talk.warn(short_warnings(read.warnings))
    talk.brief(
        {**found.summary, "files": [str(file) for file in files]}, str(found.brief), out, files
    )
