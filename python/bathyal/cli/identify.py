# SPDX-License-Identifier: BSD-3-Clause
"""bathyal identify: a table of touches in, a folder with the arm and a report out."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli import touch_options as own
from bathyal.cli.talk import Talk


def identify(
    *,
    touches: Annotated[
        list[Path],
        typer.Argument(
            metavar="TOUCHES",
            help="A table with the joints of each touch, units in the header (q1_deg, q2_deg …), "
            "and a column point that names what was touched; or a table for each point.",
        ),
    ],
    job: own.Job,
    reading: own.TouchColumns,
    known: own.Known,
    searching: own.Searching,
    ros: Annotated[
        bool, typer.Option("--ros", help="Also kinematics.yaml for ROS' ur_description.")
    ] = False,
    ur_calibration: Annotated[
        bool,
        typer.Option(
            "--ur-calibration", help="Also calibration.conf for Universal Robots' controller."
        ),
    ] = False,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Find an arm's true geometry from joint angles at touched points and one known distance.

    Prints a verdict, a few numbers and the next step.

    Writes arm.json arm.urdf fit.json parameters.csv residuals.csv report.html report.png, all or
    none, and bathyal-manifest.json with their hashes. What the touches do not determine is named;
    it does not fail the job.

    [bold]Examples:[/]

      bathyal identify touches.csv --arm ur10e --out found

      bathyal identify touches.csv --arm ur10e --known-distance left,right=50mm -o found

      bathyal identify hole_0.csv hole_1.csv --unit rad --arm panda.urdf -o found

      bathyal identify tracked.csv --tracked --arm ur10 -o found
    """
    from bathyal.identify.job import identify as make_identification
    from bathyal.view.brief import short_warnings

    talk = Talk(json=json, quiet=quiet)
    nominal = job.nominal()
    with talk.progress() as progress:
        found = make_identification(
            touches,
            nominal,
            tracked=job.tracked,
            read={**reading.keywords(), **known.keywords()},
            options=searching.keywords(),
            step=progress,
        )
        files = found.write(
            job.out,
            title=job.title(nominal, touches),
            ros=ros,
            ur_calibration=ur_calibration,
            step=progress,
        )
    data = {**found.summary, "next": found.next, "files": [str(file) for file in files]}
    talk.warn(short_warnings(found.warnings))
    talk.brief(data, str(found.brief), job.out, files)
