# SPDX-License-Identifier: BSD-3-Clause
"""bathyal touches plan: in which poses to touch."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import bathyal
from bathyal.cli import options as opt
from bathyal.cli.talk import Talk
from bathyal.cli.values import default_note, given, numbers, radians


def _note(keyword: str, *, degrees: bool = False) -> str:
    return default_note(bathyal.plan_touches, keyword, degrees=degrees)


def plan(
    *,
    arm: Annotated[
        str,
        typer.Option(help="Of the catalogue (ur10e, panda, …), or a .urdf or .json file."),
    ],
    count: Annotated[int, typer.Option(help="Touches, of all points together.")],
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Table to touch by, .csv; readings go into it.")
    ],
    picture: Annotated[
        Path | None, typer.Option(help="Also draw the plan: .png, .pdf or .svg.")
    ] = None,
    tool: Annotated[
        tuple[float, float, float] | None,
        typer.Option(
            help="Tip of the tool in the frame of the flange \\[m], to a centimetre or so.",
            metavar="X Y Z",
        ),
    ] = None,
    points: Annotated[
        int | None, typer.Option(help="How many points to touch. " + _note("num_points"))
    ] = None,
    at: Annotated[
        list[str] | None,
        typer.Option(
            help="Where a point stands, [b]0.6,-0.2,0.1[/b] \\[m]; once for each point, in place "
            "of --points.",
            metavar="X,Y,Z",
        ),
    ] = None,
    known_distance: Annotated[
        list[str] | None,
        typer.Option(
            help="Two points, [b]0,1[/b], whose distance will be measured. Without any the arm's "
            "size rests on the prior.",
            metavar="A,B",
        ),
    ] = None,
    floor: Annotated[
        float | None, typer.Option(help="Height that no joint and no tip may go below \\[m].")
    ] = None,
    criterion: Annotated[
        opt.TouchCriterion | None,
        typer.Option(help="What is made as good as can be. " + _note("criterion")),
    ] = None,
    noise: Annotated[
        float | None,
        typer.Option(help="Standard deviation of a touch, per axis \\[m]. " + _note("noise")),
    ] = None,
    length_prior: Annotated[
        float | None,
        typer.Option(help="The maker's tolerance of lengths \\[m]. " + _note("length_prior")),
    ] = None,
    angle_prior_deg: Annotated[
        float | None,
        typer.Option(
            help="The maker's tolerance of angles \\[deg]. " + _note("angle_prior", degrees=True)
        ),
    ] = None,
    seed: Annotated[
        int | None, typer.Option(help="Of the random numbers. " + _note("seed"))
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Choose poses to touch fixed points in, for identifying an arm.

    Writes a table with a row a touch. Bring the tip to the point in about that pose and put the
    joints' readings in place of the row's numbers; `bathyal.read_touches` reads the table.

    [bold]Examples:[/]

      bathyal touches plan --arm ur10e --count 63 --points 3 --out plan.csv

      bathyal touches plan --arm my.urdf --tool 0 0 0.15 --count 40 --at 0.6,-0.2,0.1
      --at 0.5,0.3,0.1 --known-distance 0,1 --floor 0 -o plan.csv --picture plan.png
    """
    from bathyal.arm_files import named_arm

    if at and points is not None:
        raise typer.BadParameter("either --at or --points, not both", param_hint="--points")
    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        machine = named_arm(arm)
        if tool is not None:
            pose = machine.tool.copy()
            pose[:3, 3] = tool
            machine.tool = pose
        with progress("Choosing poses"):
            planned = bathyal.plan_touches(
                machine,
                count,
                **given(
                    num_points=points,
                    points=[numbers("--at", text, 3) for text in at] if at else None,
                    known_distances=_pairs(known_distance),
                    floor=floor,
                    criterion=criterion,
                    noise=noise,
                    length_prior=length_prior,
                    angle_prior=radians(angle_prior_deg),
                    seed=seed,
                ),
            )
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


def _pairs(texts: list[str] | None) -> list[tuple[int, int]] | None:
    if not texts:
        return None
    pairs = [numbers("--known-distance", text, 2) for text in texts]
    for first, second in pairs:
        if first != int(first) or second != int(second):
            raise ValueError(
                f"`--known-distance`: expected two numbers of points, got {first:g},{second:g}"
            )
    return [(int(first), int(second)) for first, second in pairs]
