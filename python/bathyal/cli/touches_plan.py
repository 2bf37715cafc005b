# SPDX-License-Identifier: BSD-3-Clause
"""bathyal touches plan: in which poses to touch."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from enum import Enum
from pathlib import Path
from typing import Annotated, TypeVar

import numpy as np
import typer

import bathyal
from bathyal.cli import options as opt
from bathyal.cli.talk import Talk
from bathyal.cli.values import (
    angle,
    coordinates,
    count_number,
    default_note,
    engine_default,
    given,
    length,
    seed_number,
)

_T = TypeVar("_T")

_FACTORS = {"mm": 1e3, "deg": 180.0 / math.pi}


class Criterion(str, Enum):
    """What a plan makes as good as it can."""

    worst_tip = "worst_tip"
    d_optimal = "d_optimal"
    o1 = "o1"


def _note(keyword: str) -> str:
    return default_note(bathyal.plan_touches, keyword)


def _note_in(keyword: str, unit: str) -> str:
    value = _FACTORS[unit] * float(engine_default(bathyal.plan_touches, keyword))
    return f"[dim]\\[default: {value:.3g}{unit}][/]"


def plan(
    *,
    arm: Annotated[
        str, typer.Option(help="The drawing: a name such as ur10e, or a .urdf or .json file.")
    ],
    count: Annotated[
        int,
        typer.Option(
            help="Touches, of all points together.", parser=count_number, metavar="NUMBER"
        ),
    ],
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Table to touch by, .csv; readings go into it.")
    ],
    picture: Annotated[
        Path | None, typer.Option(help="Also draw the plan: .png, .pdf or .svg.")
    ] = None,
    tool: Annotated[
        str | None,
        typer.Option(
            help="Tip of the tool in the frame of the flange, [b]0,0,150mm[/b], to a centimetre.",
            metavar="X,Y,ZUNIT",
        ),
    ] = None,
    points: Annotated[
        int | None,
        typer.Option(
            help="How many points to touch. " + _note("num_points"),
            parser=count_number,
            metavar="NUMBER",
        ),
    ] = None,
    at: Annotated[
        list[str] | None,
        typer.Option(
            help="In place of --points: where a point lies, [b]600,-200,100mm[/b]; one each.",
            metavar="X,Y,ZUNIT",
        ),
    ] = None,
    known_distance: Annotated[
        list[str] | None,
        typer.Option(
            help="Two points, [b]0,1[/b], whose distance will be measured; may be given "
            "several times. Touches alone do not determine the arm's scale.",
            metavar="A,B",
        ),
    ] = None,
    floor: Annotated[
        float | None,
        typer.Option(
            help="Height that no joint and no tip may go below, [b]0mm[/b].",
            parser=length,
            metavar="LENGTH",
        ),
    ] = None,
    criterion: Annotated[
        Criterion | None, typer.Option(help="What is made good. " + _note("criterion"))
    ] = None,
    noise: Annotated[
        float | None,
        typer.Option(
            help="Standard deviation of a touch, per axis. " + _note_in("noise", "mm"),
            parser=length,
            metavar="LENGTH",
        ),
    ] = None,
    length_prior: Annotated[
        float | None,
        typer.Option(
            help="The maker's tolerance of lengths. " + _note_in("length_prior", "mm"),
            parser=length,
            metavar="LENGTH",
        ),
    ] = None,
    angle_prior: Annotated[
        float | None,
        typer.Option(
            help="The maker's tolerance of angles. " + _note_in("angle_prior", "deg"),
            parser=angle,
            metavar="ANGLE",
        ),
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option(
            help="Of the random numbers. " + _note("seed"), parser=seed_number, metavar="NUMBER"
        ),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Choose poses to touch fixed points in, for identifying an arm.

    Writes a table with a row a touch. Bring the tip to the point in about that pose and put the
    joints' readings in place of the row's numbers; `bathyal.read_touches` reads the table.

    [bold]Examples:[/]

      bathyal touches plan --arm ur10e --count 63 --points 3 --out plan.csv

      bathyal touches plan --arm my.urdf --tool 0,0,150mm --count 40 --at 600,-200,100mm
      --at 500,300,100mm --known-distance 0,1 --floor 0mm -o plan.csv --picture plan.png
    """
    from bathyal.arm.files import find_arm

    if at and points is not None:
        raise typer.BadParameter("either --at or --points, not both", param_hint="--points")
    options = given(
        num_points=points,
        points=[_usage("--at", coordinates, text) for text in at] if at else None,
        known_distances=[_usage("--known-distance", _pair, t) for t in known_distance or []],
        floor=floor,
        criterion=criterion,
        noise=noise,
        length_prior=length_prior,
        angle_prior=angle_prior,
        seed=seed,
    )
    tip = None if tool is None else _usage("--tool", coordinates, tool)
    talk = Talk(json=json, quiet=quiet)
    machine = find_arm(arm)
    if tip is not None:
        pose = np.eye(4)
        pose[:3, 3] = tip
        machine.tool = pose
    with talk.progress() as progress:
        with progress("Choosing poses"):
            planned = bathyal.plan_touches(machine, count, **options)
        with progress("Writing"):
            planned.write(out)
            if picture is not None:
                planned.plot(picture)
    files = [str(path) for path in (out, picture) if path is not None]
    forecast = planned.forecast
    data = {
        "touches": len(planned),
        "points_m": planned.points.tolist(),
        "touches_by_point": [int((planned.point == k).sum()) for k in range(len(planned.points))],
        "criterion": planned.criterion,
        "value": planned.value,
        "worst_tip_std_m": forecast.worst_tip_std,
        "median_tip_std_m": forecast.median_tip_std,
        "rank": forecast.rank,
        "free_parameters": forecast.free,
        "warnings": planned.warnings,
        "files": files,
    }
    talk.warn(planned.warnings)
    places = [f"{k}: {x:.3f} {y:.3f} {z:.3f}" for k, (x, y, z) in enumerate(planned.points)]
    rows = {
        "plan": planned.summary(warnings=False),
        "points": "\n".join(places),
        "written": "\n".join(files),
    }
    talk.result(data, rows)


def _usage(option: str, parse: Callable[[str], _T], text: str) -> _T:
    """A mistake in what was written is one of usage."""
    try:
        return parse(text)
    except ValueError as error:
        raise typer.BadParameter(str(error), param_hint=option) from None


def _pair(text: str) -> tuple[int, int]:
    parts = text.split(",")
    if len(parts) != 2 or not all(re.fullmatch(r"\s*[0-9]{1,9}\s*", part) for part in parts):
        raise ValueError(f"expected the numbers of two points, such as 0,1, got {text!r}")
    return int(parts[0]), int(parts[1])
