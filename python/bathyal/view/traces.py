# SPDX-License-Identifier: BSD-3-Clause
"""What a view is made of: bottom, camera axes, path and targets as plotly's traces."""

from __future__ import annotations

from typing import Any

import numpy as np
import plotly.graph_objects as go  # type: ignore[import-untyped]
from numpy.typing import NDArray

from bathyal._core import ToolPath
from bathyal.view.palette import DEPTH, GAP, INK, SEGMENTS
from bathyal.view.stations import axis_ends, runs, spread

Floats = NDArray[np.float64]

ARROW = 0.035  # length of an approach arrow, as a share of the picture's size
_APPROACH_ARROWS = 120
# Path and targets are drawn so far above the bottom, as a share of the picture's size: on it, half
# of them would be hidden in it. Hovering shows where they are.
_LIFT = 0.004


def local(points: Floats, origin: Floats) -> NDArray[np.float32]:
    """Points (N, 3) about the origin of the picture, as browsers draw them: x, y, z (3, N)."""
    return (np.asarray(points) - origin).astype(np.float32).T


def origin_of(low: Floats, high: Floats) -> Floats:
    """Whole metres in the middle; none for coordinates that are small already."""
    middle = (low + high) / 2
    return np.where(np.abs(middle) < 1000, 0.0, np.floor(middle))


def depth_scale() -> list[list[Any]]:
    """The colours of depth as plotly takes them."""
    return [[k / (len(DEPTH) - 1), colour] for k, colour in enumerate(DEPTH)]


def bottom_trace(
    vertices: Floats,
    triangles: NDArray[np.int32],
    origin: Floats,
    limits: tuple[float, float] | None = None,
) -> go.Mesh3d:
    x, y, z = local(vertices, origin)
    i, j, k = triangles.T
    low, high = limits or (None, None)
    return go.Mesh3d(
        x=x, y=y, z=z, i=i, j=j, k=k, intensity=z, colorscale=depth_scale(), cmin=low, cmax=high,
        name="bottom", showlegend=True, hoverinfo="skip",
        colorbar={"title": {"text": "z [m]"}, "len": 0.6, "thickness": 14},
        # Much ambient light: plotly lights faces that look at the viewer hardly at all.
        lighting={"ambient": 0.85, "diffuse": 0.45, "specular": 0.05, "roughness": 0.9},
        flatshading=True, lightposition={"x": 20000, "y": 20000, "z": 30000},
    )  # fmt: skip


def aim_traces(aims: NDArray[Any], path: ToolPath, origin: Floats) -> list[go.Scatter3d]:
    targets = path.targets
    hit = np.isfinite(targets.point).all(axis=1)
    end = axis_ends(aims, path)
    traces = []
    for rows, colour, dash, name in (
        (hit, "#555555", "solid", "camera axis"),
        (~hit, GAP, "dot", "camera axis without target"),
    ):
        if rows.any():
            points = _joined(aims[rows, :3], end[rows])
            traces.append(_line(points, origin, colour, 2.5, name, dash=dash))
            x, y, z = local(aims[rows, :3], origin)
            traces.append(
                go.Scatter3d(
                    x=x, y=y, z=z, mode="markers", name="camera", showlegend=bool(rows is hit),
                    marker={"size": 4, "symbol": "square", "color": colour},
                    text=[f"camera {k}: {targets.status[k]}" for k in np.flatnonzero(rows)],
                    hoverinfo="text",
                )
            )  # fmt: skip
    return traces


def path_traces(path: ToolPath, origin: Floats, size: float) -> list[go.Scatter3d]:
    position, approach = np.asarray(path.position), np.asarray(path.approach)
    lifted = position + approach * _LIFT * size
    traces = _segment_traces(path, lifted, origin)
    gap = np.flatnonzero(path.gap)
    if len(gap):
        points = _joined(position[gap], position[gap + 1])
        traces.append(_line(points, origin, GAP, 5, "gap: no bottom known", dash="dash"))
    rows = spread(position, _APPROACH_ARROWS)
    tips = position[rows] + approach[rows] * ARROW * size
    traces.append(_line(_joined(position[rows], tips), origin, INK, 2, "approach a<sub>j</sub>"))
    if not np.array_equal(path.position, path.surface):
        feet = _joined(path.surface[rows], position[rows])
        traces.append(_line(feet, origin, "#888888", 1.5, "standoff"))
    traces.append(_target_trace(path, origin, size))
    return traces


def _segment_traces(path: ToolPath, drawn: Floats, origin: Floats) -> list[go.Scatter3d]:
    """One trace a colour; each stretch ends with a row of NaN, which plotly does not draw over."""
    segment = np.asarray(path.segment)
    table = np.column_stack(
        [
            np.arange(len(segment)), segment, path.position, path.approach, path.travel,
            path.arc_length, path.time, drawn,
        ]
    )  # fmt: skip
    nothing = np.full((1, table.shape[1]), np.nan)
    pieces: dict[int, list[Floats]] = {}
    for begin, end in runs(path):
        colour = int(segment[begin]) % len(SEGMENTS)
        pieces.setdefault(colour, []).extend([table[begin : end + 1], nothing])
    traces = []
    for number, (colour, parts) in enumerate(sorted(pieces.items())):
        rows = np.vstack(parts)
        x, y, z = local(rows[:, 13:], origin)
        traces.append(
            go.Scatter3d(
                x=x, y=y, z=z, mode="lines+markers", name="tool path, by segment",
                legendgroup="path", showlegend=number == 0,
                line={"color": SEGMENTS[colour], "width": 6},
                marker={"color": SEGMENTS[colour], "size": 2},
                customdata=rows[:, :13], hovertemplate=_HOVER,
            )
        )  # fmt: skip
    return traces


_HOVER = (
    "<b>T<sub>%{customdata[0]:.0f}</sub></b>, from target %{customdata[1]:.0f}<br>"
    "T (%{customdata[2]:.3f}, %{customdata[3]:.3f}, %{customdata[4]:.3f}) m<br>"
    "a (%{customdata[5]:.3f}, %{customdata[6]:.3f}, %{customdata[7]:.3f})<br>"
    "n (%{customdata[8]:.3f}, %{customdata[9]:.3f}, %{customdata[10]:.3f})<br>"
    "%{customdata[11]:.2f} m along, after %{customdata[12]:.1f} s<extra></extra>"
)


def _target_trace(path: ToolPath, origin: Floats, size: float) -> go.Scatter3d:
    targets = path.targets
    rows = np.flatnonzero(np.isfinite(targets.point).all(axis=1))
    x, y, z = local(targets.point[rows] + targets.normal[rows] * _LIFT * size, origin)
    labels = [
        f"A{row}: {targets.status[row]}<br>"
        + "({:.3f}, {:.3f}, {:.3f}) m".format(*targets.point[row])
        + f"<br>range {targets.range[row]:.2f} m, "
        f"incidence {np.degrees(targets.incidence[row]):.0f}°"
        for row in rows
    ]
    return go.Scatter3d(
        x=x, y=y, z=z, mode="markers+text", name="target A<sub>i</sub>",
        text=[str(row) for row in rows], textposition="top center",
        textfont={"size": 14, "color": INK}, hovertext=labels, hoverinfo="text",
        marker={"size": 6, "color": "white", "line": {"color": INK, "width": 2}},
    )  # fmt: skip


def _line(
    points: Floats, origin: Floats, colour: str, width: float, name: str, dash: str = "solid"
) -> go.Scatter3d:
    x, y, z = local(points, origin)
    return go.Scatter3d(
        x=x, y=y, z=z, mode="lines", name=name, hoverinfo="skip",
        line={"color": colour, "width": width, "dash": dash},
    )  # fmt: skip


def _joined(begin: Floats, end: Floats) -> Floats:
    """Separate strokes from each `begin` to its `end` as one line with breaks."""
    joined = np.full((3 * len(begin), 3), np.nan)
    joined[0::3], joined[1::3] = begin, end
    return joined
