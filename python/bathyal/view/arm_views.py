# SPDX-License-Identifier: BSD-3-Clause
"""Arms to look at: a plotly figure that turns, and a picture."""

from __future__ import annotations

from typing import Any

import numpy as np
import plotly.graph_objects as go  # type: ignore[import-untyped]
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import (  # type: ignore[import-untyped]
    Line3DCollection,
    Poly3DCollection,
)
from numpy.typing import ArrayLike, NDArray

from bathyal._core import Arm
from bathyal.arrays import unmasked
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, replacing
from bathyal.view.arm_solid import Part, Posture, posture, resting_pose, size_of, solid
from bathyal.view.palette import INK

Floats = NDArray[np.float64]

_X, _Y, _Z = "#d1495b", "#3c9d4e", "#2f6fb5"
_AXIS = "#8a8f98"
_TRIAD = 0.11  # length of a frame's axes, as a share of the arm's length
_AXIS_LINE = 0.085  # of a joint's axis, to both sides
_FAINT = 0.22  # opacity of the poses before the last one
_MOST_POSES = 40
_LIGHT = np.array([0.35, -0.45, 0.82])
_NO_AREA = 1e-9  # of a triangle, as a share of the largest of its part
_SIZE_IN, _DPI = (8.0, 7.0), 150
_EYE = {"elev": 22, "azim": -58}


def show_arm(arm: Arm, q: ArrayLike | None = None) -> go.Figure:
    """An arm to turn and zoom; what `Arm.show` returns.

    Parameters
    ----------
    arm : Arm
    q : (n,) or (N, n) array, optional
        [rad] or [m]. The last pose is drawn in full, the others faintly (40 of them at most, spread
        evenly). At rest unless given: each joint at 0, or amid its limits where they leave 0 out.

    Returns
    -------
    plotly.graph_objects.Figure
        In the world [m]: a capsule a link, a drum a turning joint, a square one a sliding joint,
        the frames of base and tool (red x, green y, blue z). It takes no shapes from meshes; links
        run from axis to axis.

    Examples
    --------
    >>> import bathyal
    >>> figure = bathyal.arms.ur10e().show([0, -1.2, 1.5, -1.9, -1.6, 0])
    >>> sorted({trace.name for trace in figure.data})[:3]
    ['axes', 'base', 'elbow_joint']
    """
    postures = _postures(arm, q)
    size = size_of(postures)
    figure = go.Figure()
    for at in postures:
        last = at is postures[-1]
        for part in solid(at, size):
            figure.add_trace(_mesh_trace(part, 1.0 if last else _FAINT))
    at = postures[-1]
    figure.add_trace(_line_trace("axes", _axis_strokes(at, size), _AXIS, 3, dash="dash"))
    for name, pose in (("base", at.base), ("tool", at.tool)):
        for colour, stroke in zip((_X, _Y, _Z), _triad(pose, size), strict=True):
            figure.add_trace(_line_trace(name, [stroke], colour, 6))
    figure.update_layout(
        scene={
            "aspectmode": "data",
            "camera": {"eye": {"x": 1.1, "y": -1.4, "z": 0.8}},
            **{
                f"{axis}axis": {
                    "title": {"text": f"{axis} [m]"},
                    "backgroundcolor": "#f3f3f1",
                    "gridcolor": "#dddddd",
                    "zerolinecolor": "#dddddd",
                }
                for axis in "xyz"
            },
        },
        title={"text": _title(arm), "font": {"size": 14}, "x": 0.01, "y": 0.99},
        margin={"l": 0, "r": 0, "t": 36, "b": 0},
        font={"color": INK},
        showlegend=False,
    )
    return figure


def plot_arm(arm: Arm, q: ArrayLike | None = None, path: PathLike | None = None) -> Figure:
    """A picture of an arm; what `Arm.plot` returns.

    Parameters
    ----------
    arm : Arm
    q : (n,) or (N, n) array, optional
        As for `show_arm`.
    path : path, optional
        ``.png``, ``.pdf`` or ``.svg`` to write it to, too. It appears whole or not at all.

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own: no window, and nothing of pyplot's state is touched.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "arm.png"
    >>> _ = bathyal.arms.panda().plot([0, -0.8, 0, -2.4, 0, 1.6, 0.8], path)
    >>> path.stat().st_size > 10_000
    True
    """
    postures = _postures(arm, q)
    size = size_of(postures)
    figure = Figure(figsize=_SIZE_IN, dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    axes: Any = figure.add_axes((0.0, 0.02, 1.0, 0.92), projection="3d", computed_zorder=False)
    axes.set_proj_type("persp", focal_length=0.6)
    axes.view_init(**_EYE)
    low, high = _box(postures, size)
    _draw_floor(axes, low, high)
    for at in postures:
        last = at is postures[-1]
        _draw_solid(axes, solid(at, size), 1.0 if last else _FAINT, 3 if last else 1)
    at = postures[-1]
    axes.add_collection3d(
        Line3DCollection(
            _axis_strokes(at, size), colors=_AXIS, linewidths=1.0, linestyles="--", zorder=2
        )
    )
    for pose in (at.base, at.tool):
        axes.add_collection3d(
            Line3DCollection(_triad(pose, size), colors=(_X, _Y, _Z), linewidths=2.4, zorder=5)
        )
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low)
    _dress(axes)
    figure.text(0.04, 0.955, _title(arm), fontsize=13, color=INK, weight="bold")
    if path is not None:
        with replacing(path) as aside:
            figure.savefig(aside)
    return figure


def _postures(arm: Arm, q: ArrayLike | None) -> list[Posture]:
    expected = f"real numbers of shape ({arm.size},) or (N, {arm.size}), N at least 1"
    given = None if q is None else unmasked("q", q)
    try:
        poses = np.atleast_2d(resting_pose(arm) if q is None else np.asarray(given, float))
    except (TypeError, ValueError):
        raise argument_error("q", expected, repr(q)) from None
    if poses.ndim != 2 or poses.shape[1] != arm.size or len(poses) == 0:
        raise argument_error("q", expected, f"shape {poses.shape}")
    if not np.isfinite(poses).all():
        raise argument_error("q", "finite numbers", "nan or inf")
    every = np.unique(np.linspace(0, len(poses) - 1, min(len(poses), _MOST_POSES)).round())
    return [posture(arm, poses[int(row)]) for row in every]


def _title(arm: Arm) -> str:
    joints = f"{arm.size} joint{'s' if arm.size > 1 else ''}"
    return f"{arm.name}, {joints}" if arm.name else joints


def _axis_strokes(at: Posture, size: float) -> list[Floats]:
    reach = _AXIS_LINE * size
    return [np.array([p - reach * d, p + reach * d]) for p, d in at.axes]


def _triad(pose: Floats, size: float) -> list[Floats]:
    tips = pose[:3, 3] + _TRIAD * size * pose[:3, :3].T
    return [np.array([pose[:3, 3], tip]) for tip in tips]


def _mesh_trace(part: Part, opacity: float) -> go.Mesh3d:
    x, y, z = part.vertices.T
    i, j, k = part.triangles.T
    return go.Mesh3d(
        x=x, y=y, z=z, i=i, j=j, k=k, color=part.colour, opacity=opacity, name=part.name,
        hoverinfo="name", flatshading=False, lightposition={"x": 20000, "y": -20000, "z": 30000},
        lighting={"ambient": 0.6, "diffuse": 0.7, "specular": 0.15, "roughness": 0.6},
    )  # fmt: skip


def _line_trace(
    name: str, strokes: list[Floats], colour: str, width: float, dash: str = "solid"
) -> go.Scatter3d:
    """Several strokes as one line; a row of NaN parts them."""
    gap = np.full((1, 3), np.nan)
    x, y, z = np.vstack([row for stroke in strokes for row in (stroke, gap)]).T
    return go.Scatter3d(
        x=x, y=y, z=z, mode="lines", name=name, hoverinfo="name",
        line={"color": colour, "width": width, "dash": dash},
    )  # fmt: skip


def _box(postures: list[Posture], size: float) -> tuple[Floats, Floats]:
    points = np.vstack([np.vstack(at.strokes) for at in postures])
    room = 0.06 * size
    low, high = points.min(axis=0) - room, points.max(axis=0) + room
    # A flat box would hide the arm behind its own edge.
    middle, half = (low + high) / 2, np.maximum((high - low) / 2, 0.22 * size)
    return middle - half, middle + half


def _draw_floor(axes: Any, low: Floats, high: Floats) -> None:
    corners = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]]
    floor = [[(x, y, low[2]) for x, y in corners]]
    axes.add_collection3d(Poly3DCollection(floor, facecolors="#f1f1ee", zorder=-10))


def _draw_solid(axes: Any, parts: list[Part], opacity: float, zorder: float) -> None:
    """All parts in one collection, so that near ones hide far ones, lit from one side."""
    faces, colours = [], []
    for part in parts:
        corners = part.vertices[part.triangles]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        # At the ends of a body of revolution triangles shrink to lines, which would show as edges.
        seen = length[:, 0] > _NO_AREA * length.max()
        light = 0.62 + 0.38 * (normal[seen] / length[seen] @ _LIGHT)[:, None]
        tint = np.array(to_rgb(part.colour))
        faces.append(corners[seen])
        colours.append(np.clip(tint * light + 0.10 * np.clip(light - 0.8, 0, 1), 0, 1))
    shaded = np.column_stack([np.vstack(colours), np.full(sum(map(len, faces)), opacity)])
    # Edges of the faces' own colour close the hairlines between them.
    edges = shaded if opacity == 1.0 else "none"
    axes.add_collection3d(
        Poly3DCollection(
            np.vstack(faces), facecolors=shaded, edgecolors=edges, linewidths=0.3, zorder=zorder
        )
    )


def _dress(axes: Any) -> None:
    for name in "xyz":
        axis = getattr(axes, f"{name}axis")
        axis.set_pane_color((1, 1, 1, 0))
        axis._axinfo["grid"].update(color="#d9d9d6", linewidth=0.6)
        getattr(axes, f"set_{name}label")(f"{name} [m]", color=INK, fontsize=9, labelpad=4)
        axis.set_tick_params(labelsize=8, colors="#555555")
        axis.set_major_locator(MaxNLocator(5))
