# SPDX-License-Identifier: BSD-3-Clause
"""bathyal touches example: simulated touches, to try things on."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk
from bathyal.cli.values import count_number, given, length, seed_number
from bathyal.io.files import shown


def example(
    *,
    out: Annotated[Path, typer.Argument(metavar="OUT", help="Table to write, .csv.")],
    arm: Annotated[
        str, typer.Option(help="The drawing: a name such as ur10e, or a .urdf or .json file.")
    ] = "ur10e",
    count: Annotated[
        int | None,
        typer.Option(
            help="Touches of each point. [dim]\\[default: 21, with --hide 40][/]",
            parser=count_number,
            metavar="NUMBER",
        ),
    ] = None,
    noise: Annotated[
        float | None,
        typer.Option(
            help="Standard deviation of a touch, per axis. [dim]\\[default: 0.09mm][/]",
            parser=length,
            metavar="LENGTH",
        ),
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option(
            help="Of the random numbers. [dim]\\[default: 0][/]",
            parser=seed_number,
            metavar="NUMBER",
        ),
    ] = None,
    hide: Annotated[
        str,
        typer.Option(
            help="An effect that is no geometry, for bathyal diagnose to find: NAME or NAME@JOINT, "
            "joints counted from 1. backlash, base_shift, drift, joint_compliance, joint_coupling, "
            "joint_harmonic, joint_scale, thermal, tool_change or tool_slip.",
            metavar="EFFECT",
            show_default=False,
        ),
    ] = "",
    hide_size: Annotated[
        float | None,
        typer.Option(
            help="By how much it moves the tip, rms over the touches, before geometry is "
            "fitted. "
            "[dim]\\[default: 1mm; of thermal 0.3mm][/]",
            parser=length,
            metavar="LENGTH",
        ),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Touch three points with an arm that differs from its drawing by millimetres.

    The points are called left, right and top; the table says how far left is from right. What
    --hide adds is printed, and not written to the table.

    [bold]Examples:[/]

      bathyal touches example touches.csv --arm ur10e

      bathyal touches example touches.csv --arm ur10e --hide joint_harmonic@3 --hide-size 0.5mm
    """
    from bathyal.arm.files import find_arm
    from bathyal.identify.simulate import simulate_touches, write_touches

    talk = Talk(json=json, quiet=quiet)
    nominal = find_arm(arm)
    with talk.progress() as progress, progress("Touching"):
        made = simulate_touches(
            nominal, hide=hide, hide_size=hide_size, **given(count=count, noise=noise, seed=seed)
        )
        apart = f"left to right: {1e3 * made.apart:.0f} mm"
        write_touches(
            made.touches, out, comment=f"simulated touches of {nominal.name or shown(arm)}; {apart}"
        )
    data: dict[str, Any] = {
        "touches": len(made.touches), "left_to_right_m": made.apart, "file": str(out),
    }  # fmt: skip
    rows = {"touches": str(len(made.touches)), "known": apart, "written": str(out)}
    if made.hidden is not None:
        data["hidden"] = {
            "name": made.hidden.name, "joint": made.hidden.joint, "size_m": made.hidden.size,
            "parameters": made.hidden.parameters,
        }  # fmt: skip
        rows["hidden"] = str(made.hidden)
    talk.result(data, rows)
