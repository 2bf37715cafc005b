# SPDX-License-Identifier: BSD-3-Clause
"""bathyal world: what a world's file describes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk


def world(
    *,
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A world, .yaml.")],
    picture: Annotated[
        Path | None, typer.Option("--picture", "-p", help="Also draw it from above, .png.")
    ] = None,
    example: Annotated[
        bool,
        typer.Option(
            "--example", help="First write an example there, and a track over it, track.csv."
        ),
    ] = False,
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
    """Check a world's file, say what is in it, and draw it.

    [bold]Example:[/]

      bathyal world sea/world.yaml --example --picture sea/world.png
    """
    from bathyal.world.describe import describe_world
    from bathyal.world.example import write_example
    from bathyal.world.files import read_world

    talk = Talk(json=json, quiet=quiet)
    written: list[str] = []
    with talk.progress() as progress:
        if example:
            written += [str(path) for path in write_example(file)]
        with progress("Building"):
            built = read_world(file, inside=inside)
        if picture is not None:
            with progress("Drawing"):
                figure = built.show()
                figure.savefig(picture)
            written.append(str(picture))
    facts = describe_world(built)
    rows = {**facts, **({"written": "\n".join(written)} if written else {})}
    talk.result({**facts, "files": written}, rows)
