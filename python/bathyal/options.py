# SPDX-License-Identifier: BSD-3-Clause
"""Options of the command line: what they are called there, and what they become inside.

No default stands here: an option that is not given is not handed on, and the engine's own default
holds. The help reads that default from the engine's signature.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from enum import Enum
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray


def engine_default(function: Callable[..., Any], name: str, *, degrees: bool = False) -> str:
    """The default of a keyword as the engine's signature says it, for a line of help."""
    signature = (function.__doc__ or "").split("\n", 1)[0]
    match = re.search(rf"\b{name}: [^=]*? = ([^,)]+)", signature)
    if match is None:
        raise LookupError(f"{function.__name__} has no keyword {name} with a default")
    text = match[1].strip("'\"")
    return f"{math.degrees(float(text)):.4g}" if degrees else text


def given(**options: Any) -> dict[str, Any]:
    """Those that were given: keywords to hand on."""
    return {name: value for name, value in options.items() if value is not None}


def radians(degrees: float | None) -> float | None:
    """Degrees of the command line as the engine's radians; None stays None."""
    return None if degrees is None else math.radians(degrees)


def pose_matrix(values: tuple[float, ...] | None) -> NDArray[np.float64] | None:
    """x y z [m] and roll, pitch, yaw [deg] as world_from_vehicle (4, 4).

    The vehicle turns by yaw about z, then pitch about y (port), then roll about x: a positive pitch
    is nose down.
    """
    if values is None:
        return None
    roll, pitch, yaw = np.radians(values[3:])
    cr, sr, cp, sp = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch)
    cy, sy = np.cos(yaw), np.sin(yaw)
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    matrix = np.eye(4)
    matrix[:3, :3] = about_z @ about_y @ about_x
    matrix[:3, 3] = values[:3]
    return matrix


def column_list(text: str | None) -> list[int | str] | None:
    """ "0,1,2" or "easting,northing,depth": columns by number or by name."""
    if text is None:
        return None
    names = [part.strip() for part in text.split(",")]
    return [int(name) if name.isdigit() else name for name in names]


def length_or_none(text: str) -> float:
    """A length [m], or infinity for "none"."""
    if text.strip().lower() == "none":
        return math.inf
    try:
        return float(text)
    except ValueError:
        raise ValueError(f'expected a length in metres or "none", got {text!r}') from None


def default_note(function: Callable[..., Any], name: str, *, degrees: bool = False) -> str:
    """The default as a line of help ends with it."""
    return f"[dim]\\[default: {engine_default(function, name, degrees=degrees)}][/]"


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
        parser=length_or_none,
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
