# SPDX-License-Identifier: BSD-3-Clause
"""Three dimensions that turn: plans, meshes and clouds as plotly figures, in Jupyter or as a page.

Everything is drawn about a local origin, which is stated: browsers draw in float32, and at survey
coordinates that would be steps of half a metre.
"""

from __future__ import annotations

import html
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go  # type: ignore[import-untyped]
from numpy.typing import NDArray

from bathyal._core import Plane, PointCloud, Scene, ToolPath, TriangleMesh
from bathyal.decimation import crop, decimate
from bathyal.files import replacing
from bathyal.palette import DEPTH, GAP, INK, SEGMENTS
from bathyal.relief import bounds
from bathyal.stations import runs, spread
from bathyal.window import surroundings

Floats = NDArray[np.float64]

# Triangles and points a browser still turns smoothly, and a page of less than ten megabytes.
TRIANGLE_BUDGET = 90_000
POINT_BUDGET = 120_000
_APPROACH_ARROWS = 120
_ARROW = 0.035  # length of an approach arrow, as a share of the picture's size
_STRETCHES = (1, 2, 5, 10, 20, 50)


def show_mesh(mesh: TriangleMesh) -> go.Figure:
    """A mesh to turn and zoom; what `TriangleMesh.show` returns."""
    low, high = bounds(Scene(mesh))
    origin = _origin(low, high)
    vertices, triangles = decimate(
        np.asarray(mesh.vertices), np.asarray(mesh.triangles), TRIANGLE_BUDGET
    )
    note = _triangle_note(len(triangles), len(mesh.triangles))
    return _figure([_bottom_trace(vertices, triangles, origin)], low, high, origin, note)


def show_cloud(cloud: PointCloud) -> go.Figure:
    """Soundings to turn and zoom, coloured by height; what `PointCloud.show` returns."""
    points = np.asarray(cloud.points)
    points = points[np.isfinite(points).all(axis=1)]
    every = max(1, -(-len(points) // POINT_BUDGET))
    shown = points[::every]
    low, high = _box(points)
    origin = _origin(low, high)
    x, y, z = _local(shown, origin)
    trace = go.Scatter3d(
        x=x, y=y, z=z, mode="markers", name="soundings",
        marker={"size": 1.6, "color": z, "colorscale": _depth_scale()},
    )  # fmt: skip
    note = f"{len(points):,} soundings" + (f", one in {every} shown" if every > 1 else "")
    return _figure([trace], low, high, origin, note)


def show_path(path: ToolPath) -> go.Figure:
    """A tool path, its targets and its approach arrows; what `ToolPath.show` returns."""
    low, high = _box(np.vstack([path.surface, path.position, path.targets.point]))
    size = float(np.max(high - low))
    low, high = _with_room(low, high, path, np.zeros((0, 6)))
    origin = _origin(low, high)
    return _figure(_path_traces(path, origin, size), low, high, origin, "")


def show_plan(surface: Scene | Plane, aims: NDArray[Any], path: ToolPath) -> go.Figure:
    """The bottom about the path, camera axes, targets, path and approach arrows.

    Parameters
    ----------
    surface : Scene or Plane
        What the path was planned on. Around the path it is shown in full or, above
        `TRIANGLE_BUDGET` triangles, decimated; the title says which.
    aims : (K, 6) array
        In the frame of the surface [m].
    path : ToolPath
    """
    aims = np.asarray(aims, float).reshape(-1, 6)
    near = surroundings(path, aims)
    traces, notes, boxes = [], [], [path.surface, path.position, path.targets.point]
    if isinstance(surface, Plane):
        vertices, triangles = _plane_patch(surface, *near)
        parts = [(vertices, triangles)]
        notes.append("the bottom is a plane")
    else:
        budget = TRIANGLE_BUDGET // len(surface.meshes)
        cropped = [crop(mesh, *near) for mesh in surface.meshes]
        total = sum(len(mesh.triangles) for mesh in surface.meshes)
        parts = [decimate(*part, budget) for part in cropped if len(part[1])]
        around = sum(len(part[1]) for part in cropped)
        notes.append(_triangle_note(sum(len(part[1]) for part in parts), around, total))
    boxes += [part[0] for part in parts]
    low, high = _box(np.vstack(boxes))
    size = float(np.max(high - low))
    low, high = _with_room(low, high, path, aims)
    origin = _origin(low, high)
    heights = [part[0][:, 2] for part in parts] or [np.zeros(1)]
    limits = tuple(np.quantile(np.concatenate(heights), [0.002, 0.998]) - origin[2])
    traces = [_bottom_trace(*part, origin, limits) for part in parts]
    traces += _aim_traces(aims, path, origin)
    traces += _path_traces(path, origin, size)
    return _figure(traces, low, high, origin, "; ".join(notes))


def write_html(
    figure: go.Figure,
    path: str | os.PathLike[str],
    *,
    title: str = "",
    facts: Mapping[str, str] | None = None,
    warnings: Sequence[str] = (),
) -> None:
    """Save a figure as one page that needs no network: the drawing code is inside.

    The same bytes for the same figure; the whole file or none of it.
    """
    drawing = figure.to_html(
        full_html=False, include_plotlyjs=True, div_id="plan", default_height="100%",
        config={"displaylogo": False, "responsive": True},
    )  # fmt: skip
    listed = "".join(
        f"<span><b>{html.escape(name)}</b> {html.escape(value)}</span>"
        for name, value in (facts or {}).items()
    )
    warned = "".join(f"<p>{html.escape(warning)}</p>" for warning in warnings)
    page = _PAGE.format(
        title=html.escape(title), facts=listed, warnings=warned, drawing=drawing, ink=INK, red=GAP
    )
    with replacing(path) as aside:
        aside.write_text(page, encoding="utf-8")


_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
html, body {{ height: 100%; margin: 0; font: 14px/1.4 system-ui, "DejaVu Sans", sans-serif;
  color: {ink}; }}
body {{ display: flex; flex-direction: column; }}
header {{ padding: 10px 18px 6px; border-bottom: 1px solid #ddd; }}
h1 {{ font-size: 18px; margin: 0 0 4px; }}
header span {{ margin-right: 18px; white-space: nowrap; }}
header b {{ font-weight: 500; opacity: 0.65; }}
header p {{ margin: 2px 0; color: {red}; }}
main {{ flex: 1; min-height: 300px; }}
main > div {{ height: 100%; }}
</style>
</head>
<body>
<header><h1>{title}</h1>{facts}{warnings}</header>
<main>{drawing}</main>
</body>
</html>
"""


def _figure(
    traces: Sequence[Any], low: Floats, high: Floats, origin: Floats, note: str
) -> go.Figure:
    """Traces in a scene that is true to scale at first; buttons stretch the heights."""
    size = np.maximum(high - low, 1e-3 * max(float(np.max(high - low)), 1e-3))
    shown = [s for s in _STRETCHES if s == 1 or size[2] * s <= 1.2 * max(size[:2])]
    buttons = [
        {
            "label": f"heights × {stretch}",
            "method": "relayout",
            "args": [{"scene.aspectratio": _aspect(size, stretch)}],
        }
        for stretch in shown
    ]
    axes = {
        f"{name}axis": {
            "title": {"text": _axis_title(name, offset)}, "range": [a - offset, b - offset],
            "backgroundcolor": "#f3f3f1", "gridcolor": "#dddddd", "zerolinecolor": "#dddddd",
            "nticks": 3 if name == "z" else 7,
        }
        for name, offset, a, b in zip("xyz", origin, low, high, strict=True)
    }  # fmt: skip
    figure = go.Figure(list(traces))
    figure.update_layout(
        scene={
            "aspectmode": "manual",
            "aspectratio": _aspect(size, 1),
            "camera": {"eye": {"x": -0.75, "y": -1.15, "z": 0.85}},
            **axes,
        },
        margin={"l": 0, "r": 0, "t": 36, "b": 0},
        legend={"x": 0.01, "y": 0.98, "bgcolor": "rgba(255,255,255,0.8)"},
        title={"text": note, "font": {"size": 12}, "x": 0.01, "y": 0.99},
        font={"color": INK},
    )
    if len(buttons) > 1:
        figure.update_layout(
            updatemenus=[
                {"type": "dropdown", "buttons": buttons, "x": 0.99, "y": 1.0, "xanchor": "right"}
            ]
        )
    return figure


def _aspect(size: Floats, stretch: float) -> dict[str, float]:
    scaled = size * [1.0, 1.0, stretch]
    scaled = 1.9 * scaled / np.linalg.norm(scaled)
    return dict(zip("xyz", map(float, scaled), strict=True))


def _axis_title(name: str, offset: float) -> str:
    if offset == 0:
        return f"{name} [m]"
    return f"{name} [m] {'+' if offset > 0 else '−'} {abs(offset):,.0f}"


def _origin(low: Floats, high: Floats) -> Floats:
    """Whole metres in the middle; none for coordinates that are small already."""
    middle = (low + high) / 2
    return np.where(np.abs(middle) < 1000, 0.0, np.floor(middle))


def _local(points: Floats, origin: Floats) -> NDArray[np.float32]:
    return (np.asarray(points) - origin).astype(np.float32).T


def _box(points: Floats) -> tuple[Floats, Floats]:
    finite = points[np.isfinite(points).all(axis=1)]
    if len(finite) == 0:
        return np.zeros(3), np.ones(3)
    return finite.min(axis=0), finite.max(axis=0)


def _with_room(
    low: Floats, high: Floats, path: ToolPath, aims: NDArray[Any]
) -> tuple[Floats, Floats]:
    """Corners that hold the arrows too, and the cameras as far as half the picture's size up."""
    size = float(np.max(high - low))
    tips = np.asarray(path.position) + np.asarray(path.approach) * _ARROW * size
    cameras = aims[np.isfinite(aims).all(axis=1), :3]
    inside = cameras[
        np.all((cameras >= low) & (cameras <= high), axis=1, where=[True, True, False])
    ]
    inside = np.column_stack([inside[:, :2], np.minimum(inside[:, 2], high[2] + size / 2)])
    return _box(np.vstack([low, high, tips, inside]))


def _depth_scale() -> list[list[Any]]:
    return [[k / (len(DEPTH) - 1), colour] for k, colour in enumerate(DEPTH)]


def _triangle_note(shown: int, around: int, total: int | None = None) -> str:
    note = f"{shown:,} triangles shown"
    if shown < around:
        note += f", decimated from {around:,}"
    if total is not None and around < total:
        note += f" around the path (the survey has {total:,})"
    return note


def _bottom_trace(
    vertices: Floats,
    triangles: NDArray[np.int32],
    origin: Floats,
    limits: tuple[float, float] | None = None,
) -> go.Mesh3d:
    x, y, z = _local(vertices, origin)
    i, j, k = triangles.T
    low, high = limits or (None, None)
    return go.Mesh3d(
        x=x, y=y, z=z, i=i, j=j, k=k, intensity=z, colorscale=_depth_scale(), cmin=low, cmax=high,
        name="bottom", showlegend=True, hoverinfo="skip",
        colorbar={"title": {"text": "z [m]"}, "len": 0.6, "thickness": 14},
        # Much ambient light: plotly lights faces that look at the viewer hardly at all.
        lighting={"ambient": 0.85, "diffuse": 0.45, "specular": 0.05, "roughness": 0.9},
        flatshading=True, lightposition={"x": 20000, "y": 20000, "z": 30000},
    )  # fmt: skip


def _plane_patch(plane: Plane, low: Floats, high: Floats) -> tuple[Floats, NDArray[np.int32]]:
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
    height = (plane.offset - corners @ plane.normal[:2]) / plane.normal[2]
    return np.column_stack([corners, height]), np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def _aim_traces(aims: NDArray[Any], path: ToolPath, origin: Floats) -> list[go.Scatter3d]:
    targets = path.targets
    hit = np.isfinite(targets.point).all(axis=1)
    reach = float(np.median(targets.range[hit])) if hit.any() else 1.0
    unit = aims[:, 3:] / np.linalg.norm(aims[:, 3:], axis=1, keepdims=True)
    end = np.where(hit[:, None], targets.point, aims[:, :3] + reach * unit)
    traces = []
    for rows, colour, dash, name in (
        (hit, "#555555", "solid", "camera axis"),
        (~hit, GAP, "dot", "camera axis without target"),
    ):
        if rows.any():
            points = _joined(aims[rows, :3], end[rows])
            traces.append(_line(points, origin, colour, 2.5, name, dash=dash))
            x, y, z = _local(aims[rows, :3], origin)
            traces.append(
                go.Scatter3d(
                    x=x, y=y, z=z, mode="markers", name="camera", showlegend=bool(rows is hit),
                    marker={"size": 4, "symbol": "square", "color": colour},
                    text=[f"camera {k}: {targets.status[k]}" for k in np.flatnonzero(rows)],
                    hoverinfo="text",
                )
            )  # fmt: skip
    return traces


def _path_traces(path: ToolPath, origin: Floats, size: float) -> list[go.Scatter3d]:
    position, approach = np.asarray(path.position), np.asarray(path.approach)
    traces = _segment_traces(path, origin)
    gap = np.flatnonzero(path.gap)
    if len(gap):
        points = _joined(position[gap], position[gap + 1])
        traces.append(_line(points, origin, GAP, 5, "gap: no bottom known", dash="dash"))
    rows = spread(position, _APPROACH_ARROWS)
    tips = position[rows] + approach[rows] * _ARROW * size
    traces.append(_line(_joined(position[rows], tips), origin, INK, 2, "approach a_j"))
    if not np.array_equal(path.position, path.surface):
        feet = _joined(path.surface[rows], position[rows])
        traces.append(_line(feet, origin, "#888888", 1.5, "standoff"))
    traces.append(_target_trace(path, origin))
    return traces


def _segment_traces(path: ToolPath, origin: Floats) -> list[go.Scatter3d]:
    """One trace a colour; each stretch ends with a row of NaN, which plotly does not draw over."""
    segment = np.asarray(path.segment)
    table = np.column_stack(
        [
            np.arange(len(segment)), segment, path.position, path.approach, path.travel,
            path.arc_length, path.time,
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
        x, y, z = _local(rows[:, 2:5], origin)
        traces.append(
            go.Scatter3d(
                x=x, y=y, z=z, mode="lines+markers", name="tool path, by segment",
                legendgroup="path", showlegend=number == 0,
                line={"color": SEGMENTS[colour], "width": 6},
                marker={"color": SEGMENTS[colour], "size": 2},
                customdata=rows, hovertemplate=_HOVER,
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


def _target_trace(path: ToolPath, origin: Floats) -> go.Scatter3d:
    targets = path.targets
    rows = np.flatnonzero(np.isfinite(targets.point).all(axis=1))
    x, y, z = _local(targets.point[rows], origin)
    told = [
        f"A{row}: {targets.status[row]}<br>"
        + "({:.3f}, {:.3f}, {:.3f}) m".format(*targets.point[row])
        + f"<br>range {targets.range[row]:.2f} m, "
        f"incidence {np.degrees(targets.incidence[row]):.0f}°"
        for row in rows
    ]
    return go.Scatter3d(
        x=x, y=y, z=z, mode="markers+text", name="target A_i", text=[str(row) for row in rows],
        textposition="top center", textfont={"size": 14, "color": INK}, hovertext=told,
        hoverinfo="text",
        marker={"size": 6, "color": "white", "line": {"color": INK, "width": 2}},
    )  # fmt: skip


def _line(
    points: Floats, origin: Floats, colour: str, width: float, name: str, dash: str = "solid"
) -> go.Scatter3d:
    x, y, z = _local(points, origin)
    return go.Scatter3d(
        x=x, y=y, z=z, mode="lines", name=name, hoverinfo="skip",
        line={"color": colour, "width": width, "dash": dash},
    )  # fmt: skip


def _joined(begin: Floats, end: Floats) -> Floats:
    """Separate strokes from each `begin` to its `end` as one line with breaks."""
    joined = np.full((3 * len(begin), 3), np.nan)
    joined[0::3], joined[1::3] = begin, end
    return joined
