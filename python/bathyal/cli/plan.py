# SPDX-License-Identifier: BSD-3-Clause
"""bathyal plan: soundings and camera axes in, a folder with the tool path out."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk
from bathyal.cli.values import pose_matrix
from bathyal.io.files import shown


def plan(
    *,
    cloud: Annotated[
        Path,
        typer.Argument(
            metavar="CLOUD",
            help="Soundings (.xyz .txt .csv .asc .ply .pcd .las .laz .bag .tif .vtp) or a mesh "
            "(.ply .stl .obj .dae .vtp .glb .gltf .3ds).",
        ),
    ],
    aims: Annotated[
        Path,
        typer.Option(
            help="Camera axes: .csv with px_m, py_m, pz_m and dx, dy, dz (or pan_deg, tilt_deg), "
            "or .json.",
        ),
    ],
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Folder for the results; made if missing.")
    ],
    reading: opt.Reading,
    cleaning: opt.Cleaning,
    as_mesh: opt.AsMesh = None,
    plane: Annotated[
        bool,
        typer.Option(
            "--plane", help="Fit a plane: the way for a flat bottom.", rich_help_panel="Bottom"
        ),
    ] = False,
    meshing: opt.Meshing,
    world_from_vehicle: opt.Pose = None,
    aiming: opt.Aiming,
    following: opt.Following,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Plan a tool path along the bottom through what the camera was pointed at.

    Writes path.csv path.json path.vtp seabed.vtp plan.png plan.html, all or none, and
    bathyal-manifest.json with their hashes.
    Gaps in the path and aims that met nothing are warnings.

    [bold]Examples:[/]

      bathyal plan survey.xyz --aims aims.csv --out plan

      bathyal plan survey.csv --columns 0,1,3 --z down --aims aims.csv -o plan

      bathyal plan survey.laz --aims aims.json --standoff 0.1 --step 0.2 -o plan

      bathyal plan coral.ply --aims aims.csv --step 0.005 -o plan
    """
    from bathyal.toolpath.plan import plan as make_plan

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        planned = make_plan(
            cloud,
            aims,
            bottom={
                "as_mesh": as_mesh,
                "as_plane": plane,
                "read": reading.keywords(),
                "clean": cleaning.keywords(),
                "mesh": meshing.keywords(),
            },
            world_from_vehicle=pose_matrix(world_from_vehicle),
            path={**aiming.keywords(), **following.keywords()},
            step=progress,
        )
        files = planned.write(out, title=f"Tool path over {shown(cloud.name)}", step=progress)
    data = {
        **planned.summary,
        "warnings": planned.warnings,
        "files": [str(file) for file in files],
        "seconds": {name: round(value, 3) for name, value in planned.seconds.items()},
    }
    rows = {**planned.facts, "folder": str(out), "files": " ".join(file.name for file in files)}
    talk.warn(planned.warnings)
    talk.result(data, rows)
