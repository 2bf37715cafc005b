# SPDX-License-Identifier: BSD-3-Clause
"""The command line: bathyal plan · triangulate · info · survey."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from enum import Enum
from importlib.metadata import version
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table
from typer.core import TyperGroup

import bathyal
from bathyal import options as opt

_EXIT_CODES = (
    "Exit codes: 0 done (warnings are told, they do not fail a job), 1 the job failed or a file is "
    "broken, 2 wrong usage, 130 interrupted."
)


class _Commands(TyperGroup):
    """Turns what went wrong into one line and an exit code; usage errors are typer's own."""

    def invoke(self, ctx: Any) -> Any:
        err = Console(stderr=True, highlight=False)
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            err.print("[red]interrupted[/], nothing was written")
            raise typer.Exit(130) from None
        except BrokenPipeError:
            raise
        except (bathyal.Error, OSError, ValueError) as error:
            if ctx.params.get("debug"):
                err.print_exception()
            err.print(f"[red]error:[/] {escape(_one_line(error))}", soft_wrap=True)
            raise typer.Exit(1) from None


def _one_line(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror:
        name = f"{error.filename}: " if error.filename else ""
        return f"{name}{error.strerror}"
    return " ".join(str(error).split())


app = typer.Typer(
    name="bathyal",
    cls=_Commands,
    rich_markup_mode="rich",
    add_completion=False,
    pretty_exceptions_enable=False,
    epilog=_EXIT_CODES,
)


class Method(str, Enum):
    """How soundings become a mesh."""

    delaunay = "delaunay"
    greedy = "greedy"


class Down(str, Enum):
    """Which way z grows in a file."""

    up = "up"
    down = "down"


class Orientation(str, Enum):
    """How the approach axis goes over edges."""

    blended = "blended"
    piecewise_constant = "piecewise_constant"


class Vertical(str, Enum):
    """What stands upright where the bottom is cut."""

    gravity = "gravity"
    vehicle = "vehicle"


class Missed(str, Enum):
    """What becomes of aims that meet no bottom."""

    leave_out = "leave_out"
    refuse = "refuse"


class _Talk:
    """What is said where: results on stdout, progress and warnings on stderr."""

    def __init__(self, *, json: bool, quiet: bool) -> None:
        self.json = json
        self.quiet = quiet
        self.out = Console(highlight=False)
        self.err = Console(stderr=True, highlight=False)

    @contextmanager
    def progress(self) -> Iterator[Any]:
        """A function `step(name)` for stages; it draws only on a terminal."""
        if self.json or self.quiet or not self.err.is_terminal:
            yield _silent
            return
        bar = Progress(
            SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn(),
            console=self.err, transient=True,
        )  # fmt: skip

        @contextmanager
        def step(name: str) -> Iterator[None]:
            task = bar.add_task(name, total=None)
            try:
                yield
            finally:
                bar.remove_task(task)

        with bar:
            yield step

    def result(self, data: dict[str, Any], rows: dict[str, str], title: str = "") -> None:
        """A table for people, or JSON."""
        from bathyal.paths import json_text

        if self.json:
            sys.stdout.write(json_text(data))
        elif not self.quiet:
            table = Table(show_header=False, box=None, title=title or None, title_justify="left")
            table.add_column(style="dim")
            table.add_column(overflow="fold")
            for name, value in rows.items():
                table.add_row(name, escape(value))
            self.out.print(table)

    def warn(self, warnings: list[str]) -> None:
        """Warnings are told on stderr also where the rest is quiet."""
        if not self.json:
            for warning in warnings:
                self.err.print(f"[yellow]warning:[/] {escape(warning)}", soft_wrap=True)


@contextmanager
def _silent(_: str) -> Iterator[None]:
    yield


def _default(function: Any, name: str, *, degrees: bool = False) -> str:
    return f"[dim]\\[default: {opt.engine_default(function, name, degrees=degrees)}][/]"


_PLAN = bathyal.plan_toolpath
_CLEAN = bathyal.clean_cloud

Out = Annotated[Path, typer.Option("--out", "-o", help="Folder for the results; made if missing.")]
Json = Annotated[bool, typer.Option("--json", help="A machine-readable summary on stdout.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say warnings and errors only.")]
Columns = Annotated[
    str | None,
    typer.Option(
        help="Columns of x, y, z in a text file: [b]0,1,2[/b] or [b]easting,northing,depth[/b].",
        rich_help_panel="Reading",
    ),
]
Z = Annotated[
    Down | None,
    typer.Option("--z", help="Which way z grows in the file.", rich_help_panel="Reading"),
]
Scale = Annotated[
    float | None,
    typer.Option(help="Metres in one unit of the file.", rich_help_panel="Reading"),
]
Crs = Annotated[
    str | None,
    typer.Option(help="Coordinate reference system, [b]EPSG:32602[/b].", rich_help_panel="Reading"),
]
VerticalDatum = Annotated[
    str | None, typer.Option(help="Vertical datum.", rich_help_panel="Reading")
]
Voxel = Annotated[
    float | None,
    typer.Option(help="Keep one sounding a cube of this edge \\[m].", rich_help_panel="Cleaning"),
]
SpikeSigma = Annotated[
    float | None,
    typer.Option(
        help="Drop soundings so many robust standard deviations off their neighbours, 5 for one.",
        rich_help_panel="Cleaning",
    ),
]
OutlierSigma = Annotated[
    float | None,
    typer.Option(
        help="Drop soundings whose neighbours are this many standard deviations too far off.",
        rich_help_panel="Cleaning",
    ),
]
MethodOption = Annotated[
    Method | None,
    typer.Option(
        help="delaunay: a height field, exact and fast. greedy: PCL's, for overhangs.",
        rich_help_panel="Bottom",
    ),
]
MaxEdge = Annotated[
    float | None,
    typer.Option(
        metavar="METRES",
        parser=opt.length_or_none,
        help="Longest horizontal edge, so that gaps stay gaps; [b]none[/b] for no limit. "
        "[dim]\\[default: 5 × the median of the triangles' longest edges][/]",
        rich_help_panel="Bottom",
    ),
]
AsMesh = Annotated[
    bool | None,
    typer.Option(
        "--mesh/--cloud",
        help="Take the file's own faces, or only its points. By default faces are taken where "
        "there are any.",
        rich_help_panel="Bottom",
    ),
]
Pose = Annotated[
    tuple[float, float, float, float, float, float] | None,
    typer.Option(
        metavar="X Y Z ROLL PITCH YAW",
        help="Pose of the vehicle whose frame the aims stand in \\[m, deg]; x forward, y port, z "
        "up, so a positive pitch is nose down. Without it the aims stand in the survey's frame.",
        rich_help_panel="Aims",
    ),
]


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
    out: Out,
    columns: Columns = None,
    z: Z = None,
    scale: Scale = None,
    crs: Crs = None,
    vertical_datum: VerticalDatum = None,
    voxel: Voxel = None,
    spike_sigma: SpikeSigma = None,
    outlier_sigma: OutlierSigma = None,
    as_mesh: AsMesh = None,
    plane: Annotated[
        bool,
        typer.Option(
            "--plane", help="Fit a plane: the way for a flat bottom.", rich_help_panel="Bottom"
        ),
    ] = False,
    method: MethodOption = None,
    max_edge: MaxEdge = None,
    world_from_vehicle: Pose = None,
    vertical: Annotated[
        Vertical | None,
        typer.Option(
            help="The bottom is cut upright by gravity, or along the vehicle's own z. "
            + _default(_PLAN, "vertical"),
            rich_help_panel="Aims",
        ),
    ] = None,
    grazing_angle_deg: Annotated[
        float | None,
        typer.Option(
            help="Call a hit grazing beyond this angle of incidence. "
            + _default(_PLAN, "grazing_angle", degrees=True),
            rich_help_panel="Aims",
        ),
    ] = None,
    max_range: Annotated[
        float | None,
        typer.Option(
            help="No target further than this \\[m]. " + _default(_PLAN, "max_range"),
            rich_help_panel="Aims",
        ),
    ] = None,
    missed: Annotated[
        Missed | None,
        typer.Option(
            help="Leave aims without a target out with a warning, or refuse the job. "
            + _default(_PLAN, "missed"),
            rich_help_panel="Aims",
        ),
    ] = None,
    step: Annotated[
        float | None,
        typer.Option(
            help="Longest stretch between samples \\[m]; 0 keeps the points as cut. "
            + _default(_PLAN, "step"),
            rich_help_panel="Path",
        ),
    ] = None,
    standoff: Annotated[
        float | None,
        typer.Option(
            help="Of the tool from the bottom, along a_j \\[m]. " + _default(_PLAN, "standoff"),
            rich_help_panel="Path",
        ),
    ] = None,
    speed: Annotated[
        float | None,
        typer.Option(
            help="Of the tool along its path \\[m/s]. " + _default(_PLAN, "speed"),
            rich_help_panel="Path",
        ),
    ] = None,
    acceleration: Annotated[
        float | None,
        typer.Option(
            help="Along the path \\[m/s²]. " + _default(_PLAN, "acceleration"),
            rich_help_panel="Path",
        ),
    ] = None,
    angular_rate_deg: Annotated[
        float | None,
        typer.Option(
            help="Fastest turn of the tool \\[deg/s]; the feed slows where it must. "
            + _default(_PLAN, "angular_rate", degrees=True),
            rich_help_panel="Path",
        ),
    ] = None,
    orientation: Annotated[
        Orientation | None,
        typer.Option(
            help="Turns spread over the path, or the paper's: constant on each triangle. "
            + _default(_PLAN, "orientation"),
            rich_help_panel="Path",
        ),
    ] = None,
    blend_length: Annotated[
        float | None,
        typer.Option(
            help="Path over which one turn is spread \\[m]. " + _default(_PLAN, "blend_length"),
            rich_help_panel="Path",
        ),
    ] = None,
    normal_radius: Annotated[
        float | None,
        typer.Option(
            help="Take normals over the tool's footprint of this radius \\[m]; 0: the triangle's "
            "own, which noise tilts. " + _default(_PLAN, "normal_radius"),
            rich_help_panel="Path",
        ),
    ] = None,
    tool_radius: Annotated[
        float | None,
        typer.Option(
            help="Of the tool's body, to flag where it meets ground \\[m]. "
            + _default(_PLAN, "tool_radius"),
            rich_help_panel="Path",
        ),
    ] = None,
    tool_length: Annotated[
        float | None,
        typer.Option(
            help="Of the tool's body \\[m]; 0 checks no body. " + _default(_PLAN, "tool_length"),
            rich_help_panel="Path",
        ),
    ] = None,
    json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Plan a tool path along the bottom through what the camera was pointed at.

    Writes path.csv path.json path.vtp seabed.vtp plan.png plan.html to the folder,
    all of them or none. Gaps in the path and aims that met nothing are warnings.

    [bold]Examples:[/]

      bathyal plan survey.xyz --aims aims.csv --out plan

      bathyal plan survey.csv --columns 0,1,3 --z down --aims aims.csv -o plan

      bathyal plan survey.laz --aims aims.json --standoff 0.1 --step 0.2 -o plan

      bathyal plan coral.ply --aims aims.csv --step 0.005 -o plan
    """
    from bathyal.plan import plan as make_plan

    if vertical is Vertical.vehicle and world_from_vehicle is None:
        raise typer.BadParameter(
            "vehicle needs the vehicle's pose, --world-from-vehicle", param_hint="--vertical"
        )
    talk = _Talk(json=json, quiet=quiet)
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
    columns: Columns = None,
    z: Z = None,
    scale: Scale = None,
    crs: Crs = None,
    vertical_datum: VerticalDatum = None,
    voxel: Voxel = None,
    spike_sigma: SpikeSigma = None,
    outlier_sigma: OutlierSigma = None,
    method: MethodOption = None,
    max_edge: MaxEdge = None,
    json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Make a seabed from soundings.

    [bold]Examples:[/]

      bathyal triangulate survey.xyz --out seabed.vtp

      bathyal triangulate coral.pcd --method greedy --out coral.ply
    """
    from bathyal.plan import make_bottom

    talk = _Talk(json=json, quiet=quiet)
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
    columns: Columns = None,
    z: Z = None,
    scale: Scale = None,
    crs: Crs = None,
    vertical_datum: VerticalDatum = None,
    as_mesh: AsMesh = None,
    json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Say what a file holds: how much, where, how dense, and for a mesh how sound it is.

    [bold]Examples:[/]

      bathyal info survey.xyz

      bathyal info coral.ply --json
    """
    from bathyal.plan import noting, read_either
    from bathyal.reports import describe

    talk = _Talk(json=json, quiet=quiet)
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
        typer.Option(help="Of the random numbers. " + _default(bathyal.generate_survey, "seed")),
    ] = None,
    length: Annotated[
        float | None,
        typer.Option(help="Along x \\[m]. " + _default(bathyal.generate_survey, "length")),
    ] = None,
    width: Annotated[
        float | None,
        typer.Option(help="Along y \\[m]. " + _default(bathyal.generate_survey, "width")),
    ] = None,
    json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Generate a survey: sand waves, boulders, a trench, a lost stripe, noise.

    [bold]Example:[/]

      bathyal survey survey.xyz --seed 7 --aims-out aims.csv
    """
    from bathyal.examples import aims_over, write_aims

    talk = _Talk(json=json, quiet=quiet)
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
    z: Down | None,
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


def _mesh_options(method: Method | None, max_edge: float | None) -> dict[str, Any]:
    return opt.given(method=method and method.value, max_edge=max_edge)


def _bottom_options(
    as_mesh: bool | None,
    as_plane: bool,
    read: dict[str, Any],
    clean: dict[str, Any],
    mesh: dict[str, Any],
) -> dict[str, Any]:
    return {"as_mesh": as_mesh, "as_plane": as_plane, "read": read, "clean": clean, "mesh": mesh}
