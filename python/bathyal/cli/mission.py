# SPDX-License-Identifier: BSD-3-Clause
"""bathyal mission: what a mission's file describes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli.runs import existing_base
from bathyal.cli.talk import Talk


def mission(
    *,
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A mission, .yaml.")],
    picture: Annotated[
        Path | None,
        typer.Option("--picture", "-p", help="Also draw it over the bottom, .png."),
    ] = None,
    example: Annotated[
        bool,
        typer.Option(
            "--example", help="First write an example there, and one with a program on board."
        ),
    ] = False,
    base: Annotated[
        Path | None,
        typer.Option(
            help="A run base: ways of its runs lie under the picture.", show_default=False
        ),
    ] = None,
    schema: Annotated[
        Path | None,
        typer.Option(help="Also write the JSON Schema of missions, for editors.", metavar="FILE"),
    ] = None,
    inside: Annotated[
        Path | None,
        typer.Option(
            help="Folder in which the files that it names may lie, in place of its own.",
            show_default=False,
        ),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Check a mission's file, say what is in it, and draw it over the bottom.

    [bold]Example:[/]

      bathyal mission dive/mission.yaml --example --picture dive/mission.png
    """
    import json as json_format

    from bathyal.mission.describe import describe_mission, mission_figure
    from bathyal.mission.example import write_mission_example
    from bathyal.mission.files import mission_schema, read_mission
    from bathyal.onboard.example import write_onboard_example

    talk = Talk(json=json, quiet=quiet)
    written: list[str] = []
    with talk.progress() as progress:
        if example:
            made = [*write_mission_example(file), *write_onboard_example(file.parent)]
            written += [str(path) for path in made]
        with progress("Building"):
            given = read_mission(file, inside=inside)
        if schema is not None:
            schema.write_text(json_format.dumps(mission_schema(), indent=1) + "\n")
            written.append(str(schema))
        if picture is not None:
            earlier = () if base is None else existing_base(base).ways()
            with progress("Drawing"):
                mission_figure(given, earlier).savefig(picture, dpi=100)
            written.append(str(picture))
    facts = describe_mission(given)
    rows = {**facts, **({"written": "\n".join(written)} if written else {})}
    talk.result({**facts, "files": written}, rows)
