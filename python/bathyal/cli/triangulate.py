# SPDX-License-Identifier: BSD-3-Clause
"""bathyal triangulate: soundings in, a mesh of the seabed out."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk
from bathyal.seabed.meshes import write_mesh


def triangulate(
    *,
    cloud: Annotated[Path, typer.Argument(metavar="CLOUD", help="Soundings.")],
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Mesh to write: .vtp .ply .obj or .stl.")
    ],
    reading: opt.Reading,
    cleaning: opt.Cleaning,
    meshing: opt.Meshing,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Make a seabed from soundings.

    [bold]Examples:[/]

      bathyal triangulate survey.xyz --out seabed.vtp

      bathyal triangulate coral.pcd --method greedy --out coral.ply
    """
    from bathyal.seabed.bottom import make_bottom

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        bottom = make_bottom(
            cloud,
            as_mesh=False,
            read=reading.keywords(),
            clean=cleaning.keywords(),
            mesh=meshing.keywords(),
            step=progress,
        )
        assert bottom.mesh is not None
        with progress("Writing the seabed"):
            write_mesh(bottom.mesh, out)
    count = len(bottom.mesh.triangles)
    data = {
        "soundings": bottom.soundings, "triangles": count, "warnings": bottom.warnings,
        "files": [str(out)],
    }  # fmt: skip
    rows = {"soundings": f"{bottom.soundings:,}", "triangles": f"{count:,}", "written": str(out)}
    talk.warn(bottom.warnings)
    talk.result(data, rows)
