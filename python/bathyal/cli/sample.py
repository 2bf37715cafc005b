# SPDX-License-Identifier: BSD-3-Clause
"""bathyal sample: the motion that takes a soil sample, and what it does to the vehicle."""

from __future__ import annotations

from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli import scenario_options as own
from bathyal.cli.check import NOT_FREE
from bathyal.cli.talk import Talk
from bathyal.cli.values import given, seed_number


def sample(
    *,
    scenario: own.ScenarioFile,
    out: own.OutFolder,
    target: Annotated[
        str | None,
        typer.Option(
            help="Which target, by its name. [dim]\\[default: the scenario's own choice][/]",
            metavar="NAME",
        ),
    ] = None,
    inside: own.Inside = None,
    seed: Annotated[
        int | None,
        typer.Option(
            help="Of the planner. [dim]\\[default: 0][/]", parser=seed_number, metavar="NUMBER"
        ),
    ] = None,
    frames: Annotated[
        int | None,
        typer.Option(
            help="Pictures of the motion in frames/, 0 to 999. [dim]\\[default: 12][/]",
            min=0,
            max=999,
        ),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Plan to take a sample at a target: approach, press, grab, lift, transport.

    Writes motion.csv motion.html motion.png summary.json trajectory.yaml, all or none, and
    bathyal-manifest.json with their hashes; pictures in frames/. motion.html plays the motion
    offline; trajectory.yaml is ROS' JointTrajectory. The exit code is 3 where nothing is planned.

    [bold]Examples:[/]

      bathyal sample scene/scenario.yaml --out sample

      bathyal sample scene/scenario.yaml --target port --frames 0 -o sample
    """
    from bathyal.view.brief import short_warnings
    from bathyal.workspace.sample_job import sample as plan_sample
    from bathyal.workspace.scenario import read_scenario

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        with progress("Reading"):
            read = read_scenario(scenario, inside=inside)
        with progress("Planning"):
            found = plan_sample(read, target, **given(seed=seed))
        files = found.write(out, step=progress, **given(frames=frames))
    talk.warn(short_warnings(read.warnings))
    talk.brief(
        {**found.summary, "files": [str(file) for file in files]}, str(found.brief), out, files
    )
    if not found.planned:
        raise typer.Exit(NOT_FREE)
