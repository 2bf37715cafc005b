# SPDX-License-Identifier: BSD-3-Clause
"""The options of the command line, each written once: alone, or in a group (see `spread`).

A group's `keywords` are those of the function that the group is handed to.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Annotated, Any

import typer

import bathyal
from bathyal.cli.values import column_list, default_note, given, length_or_none, radians


class Method(str, Enum):
    """How soundings become a mesh."""

    delaunay = "delaunay"
    greedy = "greedy"


class Down(str, Enum):
    """Which way z grows in a file."""

    up = "up"
    down = "down"


class Offset(str, Enum):
    """How the tool keeps its standoff."""

    rolling = "rolling"
    plain = "plain"


class Orientation(str, Enum):
    """How the approach axis goes over edges."""

    blended = "blended"
    piecewise_constant = "piecewise_constant"


class Vertical(str, Enum):
    """Which direction is vertical where the bottom is cut."""

    gravity = "gravity"
    vehicle = "vehicle"


class Missed(str, Enum):
    """What becomes of aims that meet no bottom."""

    leave_out = "leave_out"
    refuse = "refuse"


def _option(panel: str, text: str, *names: str, **settings: Any) -> Any:
    return typer.Option(*names, help=text, rich_help_panel=panel, **settings)


def _plan_option(panel: str, text: str, keyword: str, *, degrees: bool = False) -> Any:
    """An option whose default is that of a keyword of `plan_toolpath`."""
    note = default_note(bathyal.plan_toolpath, keyword, degrees=degrees)
    return _option(panel, f"{text} {note}")


Json = Annotated[bool, typer.Option("--json", help="A machine-readable summary on stdout.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say warnings and errors only.")]
AsMesh = Annotated[
    bool | None,
    _option(
        "Bottom",
        "Take the file's own faces, or only its points. By default faces are taken where there "
        "are any.",
        "--mesh/--cloud",
    ),
]
Pose = Annotated[
    tuple[float, float, float, float, float, float] | None,
    _option(
        "Aims",
        "Pose of the vehicle in whose frame the aims are given \\[m, deg]; x forward, y port, "
        "z up, so a positive pitch is nose down. Without it the aims are in the survey's frame, or "
        "in the one that their .json file names.",
        metavar="X Y Z ROLL PITCH YAW",
    ),
]


@dataclass(frozen=True)
class Reading:
    """How a file is read: `read_cloud`."""

    columns: Annotated[
        str | None,
        _option(
            "Reading",
            "Columns of x, y, z in a text file: [b]0,1,2[/b] or [b]easting,northing,depth[/b].",
        ),
    ] = None
    z: Annotated[Down | None, _option("Reading", "Which way z grows in the file.", "--z")] = None
    scale: Annotated[float | None, _option("Reading", "Metres in one unit of the file.")] = None
    crs: Annotated[
        str | None, _option("Reading", "Coordinate reference system, [b]EPSG:32602[/b].")
    ] = None
    vertical_datum: Annotated[str | None, _option("Reading", "Vertical datum.")] = None

    def keywords(self) -> dict[str, Any]:
        return given(**vars(self) | {"columns": column_list(self.columns)})


@dataclass(frozen=True)
class Cleaning:
    """What is dropped from the soundings: `clean_cloud`."""

    voxel: Annotated[
        float | None, _option("Cleaning", "Keep one sounding a cube of this edge \\[m].")
    ] = None
    spike_sigma: Annotated[
        float | None,
        _option(
            "Cleaning",
            "Drop soundings so many robust standard deviations off their neighbours, 5 for one.",
        ),
    ] = None
    outlier_sigma: Annotated[
        float | None,
        _option(
            "Cleaning",
            "Drop soundings whose neighbours are this many standard deviations too far off.",
        ),
    ] = None

    def keywords(self) -> dict[str, Any]:
        return given(**vars(self))


@dataclass(frozen=True)
class Meshing:
    """How soundings become a mesh: `triangulate`."""

    method: Annotated[
        Method | None,
        _option(
            "Bottom", "delaunay: a height field, exact and fast. greedy: PCL's, for overhangs."
        ),
    ] = None
    max_edge: Annotated[
        float | None,
        _option(
            "Bottom",
            "Longest horizontal edge, so that gaps stay gaps; [b]none[/b] for no limit. "
            "[dim]\\[default: 5 × the median of the triangles' longest edges][/]",
            metavar="METRES",
            parser=length_or_none,
        ),
    ] = None

    def keywords(self) -> dict[str, Any]:
        return given(**vars(self))


@dataclass(frozen=True)
class Aiming:
    """How aims become targets: `plan_toolpath`."""

    vertical: Annotated[
        Vertical | None,
        _plan_option(
            "Aims",
            "The bottom is cut upright by gravity, or along the vehicle's own z.",
            "vertical",
        ),
    ] = None
    grazing_angle_deg: Annotated[
        float | None,
        _plan_option(
            "Aims",
            "Call a hit grazing beyond this angle of incidence.",
            "grazing_angle",
            degrees=True,
        ),
    ] = None
    max_range: Annotated[
        float | None, _plan_option("Aims", "No target further than this \\[m].", "max_range")
    ] = None
    missed: Annotated[
        Missed | None,
        _plan_option(
            "Aims", "Leave aims without a target out with a warning, or refuse the job.", "missed"
        ),
    ] = None

    def keywords(self) -> dict[str, Any]:
        options = dict(vars(self))
        angle = radians(options.pop("grazing_angle_deg"))
        return given(**options, grazing_angle=angle)


@dataclass(frozen=True)
class Following:
    """How the tool follows the bottom: `plan_toolpath`."""

    step: Annotated[
        float | None,
        _plan_option(
            "Path", "Longest stretch between samples \\[m]; 0 keeps the points as cut.", "step"
        ),
    ] = None
    standoff: Annotated[
        float | None,
        _plan_option("Path", "Of the tool from the bottom \\[m].", "standoff"),
    ] = None
    offset: Annotated[
        Offset | None,
        _plan_option(
            "Path",
            "Keep the standoff as a ball of that radius rolls over the bottom, or plainly along "
            "each sample's a_j, which may turn back over rough ground.",
            "offset",
        ),
    ] = None
    speed: Annotated[
        float | None, _plan_option("Path", "Of the tool along its path \\[m/s].", "speed")
    ] = None
    acceleration: Annotated[
        float | None, _plan_option("Path", "Along the path \\[m/s²].", "acceleration")
    ] = None
    angular_rate_deg: Annotated[
        float | None,
        _plan_option(
            "Path",
            "Fastest turn of the tool \\[deg/s]; the feed slows where it must.",
            "angular_rate",
            degrees=True,
        ),
    ] = None
    orientation: Annotated[
        Orientation | None,
        _plan_option(
            "Path",
            "Turns spread over the path, or the paper's: constant on each triangle.",
            "orientation",
        ),
    ] = None
    blend_length: Annotated[
        float | None,
        _plan_option("Path", "Path over which one turn is spread \\[m].", "blend_length"),
    ] = None
    normal_radius: Annotated[
        float | None,
        _plan_option(
            "Path",
            "Take normals over the tool's footprint of this radius \\[m]; 0: the triangle's own, "
            "which noise tilts.",
            "normal_radius",
        ),
    ] = None
    tool_radius: Annotated[
        float | None,
        _plan_option(
            "Path", "Of the tool's body, to flag where it meets ground \\[m].", "tool_radius"
        ),
    ] = None
    tool_length: Annotated[
        float | None,
        _plan_option("Path", "Of the tool's body \\[m]; 0 checks no body.", "tool_length"),
    ] = None

    def keywords(self) -> dict[str, Any]:
        options = dict(vars(self))
        rate = radians(options.pop("angular_rate_deg"))
        return given(**options, angular_rate=rate)
