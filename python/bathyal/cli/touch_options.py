# SPDX-License-Identifier: BSD-3-Clause
"""The options about touches and arms, in groups (see `spread`).

A group's `keywords` are those of the function that the group is handed to. A length or an angle is
written with its unit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Annotated, Any

import typer

import bathyal
from bathyal.cli.values import (
    angle,
    coordinates,
    default_note,
    engine_default,
    given,
    length,
    named,
    quantity,
)
from bathyal.io.files import shown

_READING = "Reading"
_COVARIATES = "Covariates"
_KNOWN = "What is known"
_FIT = "The search"
_MOST_NAMES = 3  # of tables, in a title


class Unit(str, Enum):
    """Of joints whose columns name none."""

    rad = "rad"
    deg = "deg"


class Parametrization(str, Enum):
    """How nearly parallel axes are parametrised."""

    hayati = "hayati"
    dh = "dh"


class Criterion(str, Enum):
    """What is made small."""

    centroid = "centroid"
    pairs = "pairs"


class Loss(str, Enum):
    """How outliers count."""

    square = "square"
    huber = "huber"
    cauchy = "cauchy"


class Solver(str, Enum):
    """How it is made small."""

    levenberg_marquardt = "levenberg_marquardt"
    paper = "paper"


def _option(panel: str, text: str, *names: str, **settings: Any) -> Any:
    return typer.Option(*names, help=text, rich_help_panel=panel, **settings)


def _fit_option(text: str, keyword: str, **settings: Any) -> Any:
    """An option whose default is that of a keyword of `identify_arm`."""
    return _option(_FIT, f"{text} {default_note(bathyal.identify_arm, keyword)}", **settings)


def _default_mm(function: Callable[..., Any], keyword: str) -> str:
    metres = float(engine_default(function, keyword))
    return f"[dim]\\[default: {1e3 * metres:g}mm][/]"


_TOUCHES = bathyal.Touches.__init__


@dataclass(frozen=True)
class Job:
    """What is identified or diagnosed, and where the results go."""

    arm: Annotated[
        str,
        typer.Option(
            help="The arm as it is drawn: a name such as ur10e, or a .urdf or .json file."
        ),
    ]
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Folder for the results; made if missing.")
    ]
    tip: Annotated[
        str | None, typer.Option(help="Of a .urdf with several ends: the link that is the tip.")
    ] = None
    tracked: Annotated[
        bool,
        typer.Option(
            "--tracked", help="The table holds positions that an instrument measured: x_mm …"
        ),
    ] = False

    def nominal(self) -> bathyal.Arm:
        """The arm, read."""
        from bathyal.arm.files import find_arm

        return find_arm(self.arm, **given(tip=self.tip))

    def title(self, nominal: bathyal.Arm, tables: list[Path]) -> str:
        """ "UR10e from touches.csv"."""
        names = [shown(table.name) for table in tables]
        files = ", ".join(names) if len(names) <= _MOST_NAMES else f"{len(names)} tables"
        return f"{nominal.name or shown(Path(self.arm).stem)} from {files}"


@dataclass(frozen=True)
class TouchColumns:
    """How a table is read: `read_touches`, `read_tracked`."""

    joints: Annotated[
        str | None,
        _option(
            _READING, "Columns of the joints, in the arm's order. [dim]\\[default: q1,q2,…][/]"
        ),
    ] = None
    unit: Annotated[Unit | None, _option(_READING, "Of joints whose columns name none.")] = None
    point: Annotated[
        str | None,
        _option(_READING, "Column of the touched point's name. [dim]\\[default: point][/]"),
    ] = None
    position: Annotated[
        str | None,
        _option(_READING, "Tracked: columns of the position. [dim]\\[default: x,y,z][/]"),
    ] = None
    position_unit: Annotated[
        str | None, _option(_READING, "Tracked: of positions whose columns name none, [b]mm[/b].")
    ] = None
    orientation: Annotated[
        str | None,
        _option(_READING, "Tracked: four columns of a quaternion x,y,z,w, or three of angles."),
    ] = None
    orientation_unit: Annotated[
        Unit | None, _option(_READING, "Tracked: of angles whose columns name none.")
    ] = None
    euler: Annotated[
        str | None,
        _option(
            _READING,
            "Tracked: order of the angles, [b]XYZ[/b] about the frame's own axes, [b]xyz[/b] about "
            "the fixed ones.",
        ),
    ] = None

    def keywords(self) -> dict[str, Any]:
        columns = {
            name: _names(getattr(self, name)) for name in ("joints", "position", "orientation")
        }
        return given(**vars(self) | columns)


@dataclass(frozen=True)
class CovariateColumns:
    """Covariates, recorded with the joints: `covariates` of `read_touches` and `read_tracked`."""

    session: Annotated[
        str | None, _option(_COVARIATES, "Column of the session. [dim]\\[default: session][/]")
    ] = None
    time: Annotated[
        str | None, _option(_COVARIATES, "Column of the time. [dim]\\[default: time][/]")
    ] = None
    temperature: Annotated[
        str | None,
        _option(_COVARIATES, "Column of the temperature. [dim]\\[default: temperature][/]"),
    ] = None
    payload: Annotated[
        str | None,
        _option(_COVARIATES, "Column of the load at the tip. [dim]\\[default: payload][/]"),
    ] = None
    direction: Annotated[
        str | None,
        _option(
            _COVARIATES,
            "Columns of how each joint was approached, −1, 0 or 1, in the arm's order. "
            "[dim]\\[default: direction_1,direction_2,…][/]",
        ),
    ] = None
    gravity: Annotated[
        str | None,
        _option(
            _COVARIATES,
            "Columns of gravity in the base's frame \\[m/s²]. "
            "[dim]\\[default: gravity_x,gravity_y,gravity_z][/]",
        ),
    ] = None
    covariate: Annotated[
        list[str] | None,
        _option(
            _COVARIATES,
            "Anything else, [b]pressure=P_bar[/b]: structure is looked for against it, too; may "
            "be given several times.",
            metavar="NAME=COLUMN",
        ),
    ] = None

    def keywords(self) -> dict[str, Any]:
        named_columns = given(
            session=self.session,
            time=self.time,
            temperature=self.temperature,
            payload=self.payload,
            direction=_names(self.direction),
            gravity=_names(self.gravity),
        )
        others = _each(self.covariate, "covariate", named) or {}
        twice = sorted(set(others) & set(named_columns))
        if twice:
            raise typer.BadParameter(f"expected {twice[0]} once", param_hint="--covariate")
        columns = {**named_columns, **others}
        return {"covariates": columns} if columns else {}


@dataclass(frozen=True)
class Known:
    """What is known in addition to the touches: `Touches`."""

    known_distance: Annotated[
        list[str] | None,
        _option(
            _KNOWN,
            "Between two touched points, [b]left,right=50mm[/b]; may be given several times.",
            metavar="A,B=LENGTH",
        ),
    ] = None
    distance_std: Annotated[
        float | None,
        _option(
            _KNOWN,
            f"Standard deviation of those distances. {_default_mm(_TOUCHES, 'distance_std')}",
            parser=length,
            metavar="LENGTH",
        ),
    ] = None
    known_point: Annotated[
        list[str] | None,
        _option(
            _KNOWN,
            "Where a touched point lies in the base's frame, [b]left=500,200,100mm[/b]; may be "
            "given several times.",
            metavar="A=X,Y,ZUNIT",
        ),
    ] = None
    point_std: Annotated[
        float | None,
        _option(
            _KNOWN,
            "Standard deviation of those coordinates, per axis. "
            f"{_default_mm(_TOUCHES, 'point_std')}",
            parser=length,
            metavar="LENGTH",
        ),
    ] = None
    plane: Annotated[
        list[str] | None,
        _option(
            _KNOWN,
            "A name in the column of points that marks a plane touched in many places; may be "
            "given several times.",
            metavar="NAME",
        ),
    ] = None

    def keywords(self) -> dict[str, Any]:
        return given(
            known_distances=_each(self.known_distance, "known-distance", _distance),
            distance_std=self.distance_std,
            known_points=_each(self.known_point, "known-point", _place),
            point_std=self.point_std,
            planes=self.plane or None,
        )


@dataclass(frozen=True)
class Searching:
    """How the arm is searched for: `identify_arm`."""

    length_prior: Annotated[
        float | None,
        _option(_FIT, "The maker's tolerance of every a and d, [b]0.5mm[/b].", parser=length,
                metavar="LENGTH"),
    ] = None  # fmt: skip
    size_prior: Annotated[
        float | None,
        _option(
            _FIT,
            "That tolerance where none is given and no data determine the arm's scale. "
            f"{_default_mm(bathyal.identify_arm, 'size_prior')}",
            parser=length,
            metavar="LENGTH",
        ),
    ] = None
    angle_prior: Annotated[
        float | None,
        _option(_FIT, "The maker's tolerance of every theta, alpha and beta, [b]0.1deg[/b].",
                parser=angle, metavar="ANGLE"),
    ] = None  # fmt: skip
    prior: Annotated[
        list[str] | None,
        _option(_FIT, "Of one parameter, [b]a_2=1mm[/b]; may be given several times.",
                metavar="NAME=VALUE"),
    ] = None  # fmt: skip
    fixed: Annotated[
        list[str] | None,
        _option(
            _FIT, "A parameter to hold at nominal; may be given several times.", metavar="NAME"
        ),
    ] = None
    prune_sigma: Annotated[
        float | None,
        _option(_FIT, "Put parameters within so many standard deviations of nominal back there."),
    ] = None
    noise: Annotated[
        float | None,
        _option(_FIT, "Of a touch, per axis. [dim]\\[default: from the residuals][/]",
                parser=length, metavar="LENGTH"),
    ] = None  # fmt: skip
    loss: Annotated[
        Loss | None,
        _fit_option("How far-off touches count; the last two take them lightly.", "loss"),
    ] = None
    parametrization: Annotated[
        Parametrization | None,
        _fit_option("Hayati's beta for nearly parallel axes, or plain DH.", "parametrization"),
    ] = None
    criterion: Annotated[
        Criterion | None,
        _fit_option("Each touch against its point's mean, or every pair (eq 7).", "criterion"),
    ] = None
    solver: Annotated[
        Solver | None, _fit_option("Ceres' own, or the paper's update (eq 17).", "solver")
    ] = None

    def keywords(self) -> dict[str, Any]:
        options = dict(vars(self))
        priors = _each(options.pop("prior"), "prior", _prior)
        fixed = options.pop("fixed") or None
        return given(**options, priors=priors, fixed=fixed)


def _names(text: str | None) -> list[str] | None:
    return None if text is None else [part.strip() for part in text.split(",")]


def _each(texts: list[str] | None, name: str, parse: Any) -> dict[Any, Any] | None:
    """What an option that may be given several times says; a mistake is one of usage."""
    found: dict[Any, Any] = {}
    for text in texts or []:
        try:
            key, value = parse(text)
        except ValueError as error:
            raise typer.BadParameter(str(error), param_hint=f"--{name}") from None
        if key in found:
            raise typer.BadParameter(f"expected {text!r} once", param_hint=f"--{name}")
        found[key] = value
    return found or None


def _distance(text: str) -> tuple[tuple[str, str], float]:
    points, value = named(text)
    parts = [part.strip() for part in points.split(",")]
    if len(parts) != 2 or not all(parts):
        raise ValueError(f"expected two points, as in left,right=50mm, got {text!r}")
    return (parts[0], parts[1]), length(value)


def _place(text: str) -> tuple[str, tuple[float, ...]]:
    name, value = named(text)
    return name, coordinates(value)


def _prior(text: str) -> tuple[str, float]:
    name, value = named(text)
    return name, quantity(value)[0]
