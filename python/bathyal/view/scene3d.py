# SPDX-License-Identifier: BSD-3-Clause
"""Three dimensions that turn: plans, meshes and clouds as plotly figures, in Jupyter or as a page.

Everything is drawn about a local origin, which is stated: browsers draw in float32, and at survey
coordinates that would be steps of half a metre.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
import plotly.graph_objects as go  # type: ignore[import-untyped]
from numpy.typing import NDArray

from bathyal._core import Plane, PointCloud, Scene, ToolPath, TriangleMesh
from bathyal.arrays import unmasked
from bathyal.view.decimate import Indices, crop, decimate
from bathyal.view.palette import INK
from bathyal.view.relief import bounds, meshes_in_world
from bathyal.view.stations import axis_ends
from bathyal.view.traces import (
    ARROW,
    Floats,
    aim_traces,
    bottom_trace,
    depth_scale,
    local,
    origin_of,
    path_traces,
)
from bathyal.view.window import surroundings, view_window

# Triangles and points a browser still turns smoothly, and a page of less than ten megabytes.
TRIANGLE_BUDGET = 90_000
POINT_BUDGET = 120_000
_STRETCHES = (1, 2, 5, 10, 20, 50)
_ROOM = 1.1  # about the box, for the numbers on its axes


def show_mesh(mesh: TriangleMesh) -> go.Figure:
    """A mesh to turn and zoom; what `TriangleMesh.show` returns."""
    low, high = bounds(Scene(mesh))
    origin = origin_of(low, high)
    vertices, triangles = decimate(
        np.asarray(mesh.vertices), np.asarray(mesh.triangles), TRIANGLE_BUDGET
    )
    note = _triangle_note(len(triangles), len(mesh.triangles))
    return _figure([bottom_trace(vertices, triangles, origin)], low, high, origin, note)


def show_cloud(cloud: PointCloud) -> go.Figure:
    """Soundings to turn and zoom, coloured by height; what `PointCloud.show` returns."""
    points = np.asarray(cloud.points)
    points = points[np.isfinite(points).all(axis=1)]
    every = max(1, -(-len(points) // POINT_BUDGET))
    shown = points[::every]
    low, high = _box(points)
    origin = origin_of(low, high)
    x, y, z = local(shown, origin)
    trace = go.Scatter3d(
        x=x, y=y, z=z, mode="markers", name="soundings",
        marker={"size": 1.6, "color": z, "colorscale": depth_scale()},
    )  # fmt: skip
    note = f"{len(points):,} soundings" + (f", one in {every} shown" if every > 1 else "")
    return _figure([trace], low, high, origin, note)


def show_path(path: ToolPath) -> go.Figure:
    """A tool path, its targets and its approach arrows; what `ToolPath.show` returns."""
    low, high = _box(np.vstack([path.surface, path.position, path.targets.point]))
    size = float(np.max(high - low))
    low, high = _with_room(low, high, path, np.zeros((0, 6)))
    origin = origin_of(low, high)
    return _figure(path_traces(path, origin, size), low, high, origin, "")


def show_plan(surface: Scene | Plane, aims: NDArray[Any], path: ToolPath) -> go.Figure:
    """The bottom about the path, camera axes, targets, path and approach arrows.

    Parameters
    ----------
    surface : Scene or Plane
        What the path was planned on. Of a survey much wider than the path only its surroundings
        are shown; above `TRIANGLE_BUDGET` triangles they are decimated. The title says so.
    aims : (K, 6) array
        In the frame of the surface [m].
    path : ToolPath
    """
    aims = unmasked("aims", aims).astype(float).reshape(-1, 6)
    parts, note = _bottom_parts(surface, aims, path)
    vertices = [part[0] for part in parts]
    low, high = _box(np.vstack([path.surface, path.position, path.targets.point, *vertices]))
    size = float(np.max(high - low))
    low, high = _with_room(low, high, path, aims)
    origin = origin_of(low, high)
    heights = np.concatenate([[], *(corners[:, 2] for corners in vertices)])
    limits = tuple(np.quantile(heights, [0.002, 0.998]) - origin[2]) if len(heights) else None
    traces = [bottom_trace(*part, origin, limits) for part in parts]
    traces += aim_traces(aims, path, origin)
    traces += path_traces(path, origin, size)
    return _figure(traces, low, high, origin, note)


def _bottom_parts(
    surface: Scene | Plane, aims: Floats, path: ToolPath
) -> tuple[list[tuple[Floats, Indices]], str]:
    """Vertices and triangles of each mesh as it is shown, and a note of how much that is."""
    if isinstance(surface, Plane):
        return [_plane_patch(surface, *surroundings(path, aims))], "the bottom is a plane"
    corners = view_window(surface, aims, path)
    meshes = meshes_in_world(surface)
    cropped = [crop(mesh, *corners) for mesh in meshes]
    budget = TRIANGLE_BUDGET // len(meshes)
    parts = [decimate(*part, budget) for part in cropped if len(part[1])]
    shown, around = (sum(len(part[1]) for part in some) for some in (parts, cropped))
    return parts, _triangle_note(shown, around, sum(len(mesh.triangles) for mesh in meshes))


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
            "nticks": 7 if name != "z" else 3 if size[2] > max(size) / 8 else 2,
        }
        for name, offset, a, b in zip("xyz", origin, low, high, strict=True)
    }  # fmt: skip
    figure = go.Figure(list(traces))
    figure.update_layout(
        scene={
            "aspectmode": "manual",
            "aspectratio": _aspect(size, 1),
            "camera": {"eye": _eye(_aspect(size, 1))},
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


def _eye(aspect: dict[str, float]) -> dict[str, float]:
    """Where plotly's camera is placed so that it sees the whole box, from the south-west above.

    It looks at the box's middle with an angle of 45° from bottom to top; the page is at least a
    third wider than high.
    """
    back = np.array([-0.75, -1.15, 0.85])
    back /= np.linalg.norm(back)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    half = np.array([aspect[name] for name in "xyz"]) / 2
    corners = half * np.array(list(product((-1, 1), repeat=3)))
    off_axis = np.maximum(np.abs(corners @ np.cross(back, right)), np.abs(corners @ right) * 3 / 4)
    distance = np.max(corners @ back + off_axis / np.tan(np.radians(45 / 2)))
    return dict(zip("xyz", map(float, _ROOM * distance * back), strict=True))


def _axis_title(name: str, offset: float) -> str:
    if offset == 0:
        return f"{name} [m]"
    return f"{name} [m] {'+' if offset > 0 else '−'} {abs(offset):,.0f}"


def _box(points: Floats) -> tuple[Floats, Floats]:
    finite = points[np.isfinite(points).all(axis=1)]
    if len(finite) == 0:
        return np.zeros(3), np.ones(3)
    return finite.min(axis=0), finite.max(axis=0)


def _with_room(
    low: Floats, high: Floats, path: ToolPath, aims: NDArray[Any]
) -> tuple[Floats, Floats]:
    """Corners that hold the arrows too, and the camera axes as far as half the picture's size up
    and a fifth of it to each side."""
    size = float(np.max(high - low))
    tips = np.asarray(path.position) + np.asarray(path.approach) * ARROW * size
    seen = np.vstack([aims[:, :3], axis_ends(aims, path)]) if len(aims) else tips
    outside = np.abs(seen - (low + high) / 2)[:, :2] - (high - low)[:2] / 2
    inside = seen[np.all(outside <= size / 5, axis=1)]
    inside = np.column_stack([inside[:, :2], np.minimum(inside[:, 2], high[2] + size / 2)])
    return _box(np.vstack([low, high, tips, inside]))


def _triangle_note(shown: int, around: int, total: int | None = None) -> str:
    note = f"{shown:,} triangles shown"
    if shown < around:
        note += f", decimated from {around:,}"
    if total is not None and around < total:
        note += f" around the path (the survey has {total:,})"
    return note


def _plane_patch(plane: Plane, low: Floats, high: Floats) -> tuple[Floats, Indices]:
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
    height = (plane.offset - corners @ plane.normal[:2]) / plane.normal[2]
    return np.column_stack([corners, height]), np.array([[0, 1, 2], [0, 2, 3]], np.int32)
