# SPDX-License-Identifier: BSD-3-Clause
"""The command line: bathyal plan · triangulate · info · survey."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path
from typing import Annotated, Any

import typer

import bathyal
from bathyal import options as opt
from bathyal.talk import Commands, Talk

_EXIT_CODES = (
    "Exit codes: 0 done (warnings are told, they do not fail a job), 1 the job failed or a file is "
    "broken, 2 wrong usage, 130 interrupted."
)

app = typer.Typer(
    name="bathyal",
    cls=Commands,
    rich_markup_mode="rich",
    add_completion=False,
    pretty_exceptions_enable=False,
    epilog=_EXIT_CODES,
)

_PLAN = bathyal.plan_toolpath


@app.callback(invoke_without_command=True)
def main(
    context: typer.Context,
    show_version: Annotated[bool, typer.Option("--version", help="Say the version.")] = False,
    debug: Annotated[
        bool, typer.Option("--debug", help="Show where in the program an error came from.")
    ] = False,
) -> None:
    """From soundings and camera axes to an oriented tool path along the bottom.

    [bold]Try it:[/]

      bathyal survey survey.xyz --aims-out aims.csv

      bathyal plan survey.xyz --aims aims.csv --out plan
    """
    if show_version:
        typer.echo(f"bathyal {version('bathyal')}")
        raise typer.Exit
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


@app.command(epilog=_EXIT_CODES)
def plan(
    cloud: Annotated[
        Path,
        typer.Argument(
            metavar="CLOUD",
            help="Soundings (.xyz .txt .csv .asc .ply .pcd .las .laz .bag .tif .vtp) or a mesh "
            "(.ply .stl .obj .dae .vtp).",
        ),
    ],
    aims: Annotated[
        Path,
        typer.Option(
            help="Camera axes: .csv with px_m, py_m, pz_m and dx, dy, dz (or pan_deg, tilt_deg), "
            "or .json.",
        ),
    ],
    out: opt.Out,
    columns: opt.Columns = None,
    z: opt.Z = None,
    scale: opt.Scale = None,
    crs: opt.Crs = None,
    vertical_datum: opt.VerticalDatum = None,
    voxel: opt.Voxel = None,
    spike_sigma: opt.SpikeSigma = None,
    outlier_sigma: opt.OutlierSigma = None,
    as_mesh: opt.AsMesh = None,
    plane: Annotated[
        bool,
        typer.Option(
            "--plane", help="Fit a plane: the way for a flat bottom.", rich_help_panel="Bottom"
        ),
    ] = False,
    method: opt.MethodOption = None,
    max_edge: opt.MaxEdge = None,
    world_from_vehicle: opt.Pose = None,
    vertical: Annotated[
        opt.Vertical | None,
        typer.Option(
            help="The bottom is cut upright by gravity, or along the vehicle's own z. "
            + opt.default_note(_PLAN, "vertical"),
            rich_help_panel="Aims",
        ),
    ] = None,
    grazing_angle_deg: Annotated[
        float | None,
        typer.Option(
            help="Call a hit grazing beyond this angle of incidence. "
            + opt.default_note(_PLAN, "grazing_angle", degrees=True),
            rich_help_panel="Aims",
        ),
    ] = None,
    max_range: Annotated[
        float | None,
        typer.Option(
            help="No target further than this \\[m]. " + opt.default_note(_PLAN, "max_range"),
            rich_help_panel="Aims",
        ),
    ] = None,
    missed: Annotated[
        opt.Missed | None,
        typer.Option(
            help="Leave aims without a target out with a warning, or refuse the job. "
            + opt.default_note(_PLAN, "missed"),
            rich_help_panel="Aims",
        ),
    ] = None,
    step: Annotated[
        float | None,
        typer.Option(
            help="Longest stretch between samples \\[m]; 0 keeps the points as cut. "
            + opt.default_note(_PLAN, "step"),
            rich_help_panel="Path",
        ),
    ] = None,
    standoff: Annotated[
        float | None,
        typer.Option(
            help="Of the tool from the bottom, along a_j \\[m]. "
            + opt.default_note(_PLAN, "standoff"),
            rich_help_panel="Path",
        ),
    ] = None,
    speed: Annotated[
        float | None,
        typer.Option(
            help="Of the tool along its path \\[m/s]. " + opt.default_note(_PLAN, "speed"),
            rich_help_panel="Path",
        ),
    ] = None,
    acceleration: Annotated[
        float | None,
        typer.Option(
            help="Along the path \\[m/s²]. " + opt.default_note(_PLAN, "acceleration"),
            rich_help_panel="Path",
        ),
    ] = None,
    angular_rate_deg: Annotated[
        float | None,
        typer.Option(
            help="Fastest turn of the tool \\[deg/s]; the feed slows where it must. "
            + opt.default_note(_PLAN, "angular_rate", degrees=True),
            rich_help_panel="Path",
        ),
    ] = None,
    orientation: Annotated[
        opt.Orientation | None,
        typer.Option(
            help="Turns spread over the path, or the paper's: constant on each triangle. "
            + opt.default_note(_PLAN, "orientation"),
            rich_help_panel="Path",
        ),
    ] = None,
    blend_length: Annotated[
        float | None,
        typer.Option(
            help="Path over which one turn is spread \\[m]. "
            + opt.default_note(_PLAN, "blend_length"),
            rich_help_panel="Path",
        ),
    ] = None,
    normal_radius: Annotated[
        float | None,
        typer.Option(
            help="Take normals over the tool's footprint of this radius \\[m]; 0: the triangle's "
            "own, which noise tilts. " + opt.default_note(_PLAN, "normal_radius"),
            rich_help_panel="Path",
        ),
    ] = None,
    tool_radius: Annotated[
        float | None,
        typer.Option(
            help="Of the tool's body, to flag where it meets ground \\[m]. "
            + opt.default_note(_PLAN, "tool_radius"),
            rich_help_panel="Path",
        ),
    ] = None,
    tool_length: Annotated[
        float | None,
        typer.Option(
            help="Of the tool's body \\[m]; 0 checks no body. "
            + opt.default_note(_PLAN, "tool_length"),
            rich_help_panel="Path",
        ),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Plan a tool path along the bottom through what the camera was pointed at.

    Writes path.csv path.json path.vtp seabed.vtp plan.png plan.html, all or none.
    Gaps in the path and aims that met nothing are warnings.

    [bold]Examples:[/]

      bathyal plan survey.xyz --aims aims.csv --out plan

      bathyal plan survey.csv --columns 0,1,3 --z down --aims aims.csv -o plan

      bathyal plan survey.laz --aims aims.json --standoff 0.1 --step 0.2 -o plan

      bathyal plan coral.ply --aims aims.csv --step 0.005 -o plan
    """
    from bathyal.plan import plan as make_plan

    if vertical is opt.Vertical.vehicle and world_from_vehicle is None:
        raise typer.BadParameter(
            "vehicle needs the vehicle's pose, --world-from-vehicle", param_hint="--vertical"
        )
    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        planned = make_plan(
            cloud,
            aims,
            bottom=_bottom_options(
                as_mesh, plane,
                _read_options(columns, z, scale, crs, vertical_datum),
                _clean_options(voxel, spike_sigma, outlier_sigma),
                _mesh_options(method, max_edge),
            ),
            world_from_vehicle=opt.pose_matrix(world_from_vehicle),
            path=opt.given(
                vertical=vertical and vertical.value, missed=missed and missed.value,
                grazing_angle=opt.radians(grazing_angle_deg), max_range=max_range, step=step,
                standoff=standoff, speed=speed, acceleration=acceleration,
                angular_rate=opt.radians(angular_rate_deg),
                orientation=orientation and orientation.value, blend_length=blend_length,
                normal_radius=normal_radius, tool_radius=tool_radius, tool_length=tool_length,
            ),
            step=progress,
        )  # fmt: skip
        files = planned.write(out, title=f"Tool path over {cloud.name}", step=progress)
    data = {
        **planned.summary,
        "warnings": planned.warnings,
        "files": [str(file) for file in files],
        "seconds": {name: round(value, 3) for name, value in planned.seconds.items()},
    }
    talk.warn(planned.warnings)
    talk.result(
        data, {**planned.facts, "folder": str(out), "files": " ".join(f.name for f in files)}
    )


@app.command(epilog=_EXIT_CODES)
def triangulate(
    cloud: Annotated[Path, typer.Argument(metavar="CLOUD", help="Soundings.")],
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Mesh to write: .vtp .ply .obj or .stl.")
    ],
    columns: opt.Columns = None,
    z: opt.Z = None,
    scale: opt.Scale = None,
    crs: opt.Crs = None,
    vertical_datum: opt.VerticalDatum = None,
    voxel: opt.Voxel = None,
    spike_sigma: opt.SpikeSigma = None,
    outlier_sigma: opt.OutlierSigma = None,
    method: opt.MethodOption = None,
    max_edge: opt.MaxEdge = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Make a seabed from soundings.

    [bold]Examples:[/]

      bathyal triangulate survey.xyz --out seabed.vtp

      bathyal triangulate coral.pcd --method greedy --out coral.ply
    """
    from bathyal.plan import make_bottom

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        bottom = make_bottom(
            cloud,
            **_bottom_options(
                False, False,
                _read_options(columns, z, scale, crs, vertical_datum),
                _clean_options(voxel, spike_sigma, outlier_sigma),
                _mesh_options(method, max_edge),
            ),
            step=progress,
        )  # fmt: skip
        assert bottom.mesh is not None
        with progress("Writing the seabed"):
            bathyal.write_mesh(bottom.mesh, out)
    count = len(bottom.mesh.triangles)
    data = {
        "soundings": bottom.soundings, "triangles": count, "warnings": bottom.warnings,
        "files": [str(out)],
    }  # fmt: skip
    talk.warn(bottom.warnings)
    rows = {"soundings": f"{bottom.soundings:,}", "triangles": f"{count:,}", "written": str(out)}
    talk.result(data, rows)


@app.command(epilog=_EXIT_CODES)
def info(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Soundings or a mesh.")],
    columns: opt.Columns = None,
    z: opt.Z = None,
    scale: opt.Scale = None,
    crs: opt.Crs = None,
    vertical_datum: opt.VerticalDatum = None,
    as_mesh: opt.AsMesh = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Say what a file holds: how much, where, how dense, and for a mesh how sound it is.

    [bold]Examples:[/]

      bathyal info survey.xyz

      bathyal info coral.ply --json
    """
    from bathyal.plan import noting, read_either
    from bathyal.reports import describe

    talk = Talk(json=json, quiet=quiet)
    warnings: list[str] = []
    with talk.progress() as progress:
        with progress("Reading"), noting(warnings):
            what = read_either(file, as_mesh, _read_options(columns, z, scale, crs, vertical_datum))
        with progress("Looking at it"):
            data, rows = describe(what)
    talk.warn(warnings)
    talk.result({"file": str(file), **data, "warnings": warnings}, rows, title=file.name)


@app.command(epilog=_EXIT_CODES)
def survey(
    out: Annotated[
        Path, typer.Argument(metavar="OUT", help="Soundings to write: .xyz .csv .ply or .vtp.")
    ],
    aims_out: Annotated[
        Path | None, typer.Option(help="Also write camera axes that fit the survey, .csv.")
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option(
            help="Of the random numbers. " + opt.default_note(bathyal.generate_survey, "seed")
        ),
    ] = None,
    length: Annotated[
        float | None,
        typer.Option(help="Along x \\[m]. " + opt.default_note(bathyal.generate_survey, "length")),
    ] = None,
    width: Annotated[
        float | None,
        typer.Option(help="Along y \\[m]. " + opt.default_note(bathyal.generate_survey, "width")),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Generate a survey: sand waves, boulders, a trench, a lost stripe, noise.

    [bold]Example:[/]

      bathyal survey survey.xyz --seed 7 --aims-out aims.csv
    """
    from bathyal.examples import aims_over, write_aims

    talk = Talk(json=json, quiet=quiet)
    chosen = opt.given(seed=seed, length=length, width=width)
    with talk.progress() as progress:
        with progress("Generating"):
            cloud = bathyal.generate_survey(**chosen)
        with progress("Writing"):
            bathyal.write_cloud(cloud, out)
            if aims_out is not None:
                write_aims(aims_over(cloud), aims_out)
    files = [str(path) for path in (out, aims_out) if path is not None]
    data = {"soundings": len(cloud), "files": files}
    talk.result(data, {"soundings": f"{len(cloud):,}", "written": "\n".join(files)})


def _read_options(
    columns: str | None,
    z: opt.Down | None,
    scale: float | None,
    crs: str | None,
    vertical_datum: str | None,
) -> dict[str, Any]:
    return opt.given(
        columns=opt.column_list(columns), z=z and z.value, scale=scale, crs=crs,
        vertical_datum=vertical_datum,
    )  # fmt: skip


def _clean_options(
    voxel: float | None, spike_sigma: float | None, outlier_sigma: float | None
) -> dict[str, Any]:
    return opt.given(voxel=voxel, spike_sigma=spike_sigma, outlier_sigma=outlier_sigma)


def _mesh_options(method: opt.Method | None, max_edge: float | None) -> dict[str, Any]:
    return opt.given(method=method and method.value, max_edge=max_edge)


def _bottom_options(
    as_mesh: bool | None,
    as_plane: bool,
    read: dict[str, Any],
    clean: dict[str, Any],
    mesh: dict[str, Any],
) -> dict[str, Any]:
    return {"as_mesh": as_mesh, "as_plane": as_plane, "read": read, "clean": clean, "mesh": mesh}
