# SPDX-License-Identifier: BSD-3-Clause
"""A motion as one page of HTML that plays it and needs no network."""

from __future__ import annotations

import base64
import html
import json
from collections.abc import Sequence
from importlib.resources import files
from typing import Any

import numpy as np
import plotly.graph_objects as go  # type: ignore[import-untyped]
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray
from plotly.subplots import make_subplots  # type: ignore[import-untyped]

from bathyal.io.files import PathLike, replacing
from bathyal.view.motion import AT_REST, Body, Floats, Motion
from bathyal.view.palette import GAP, INK, SEGMENTS
from bathyal.view.traces import bottom_trace, local, origin_of

LIGHTS = {"go": "#12924f", "caution": "#d98a00", "stop": GAP}
"""The colours of an indicator, by its state."""

_CURVES = ("#1f6f9c", "#e07b00", "#12924f", "#8f5bff", "#c2189b", "#7a3b00", "#5b6068")
_BANDS = ("rgba(27,31,36,0.05)", "rgba(27,31,36,0.0)")
# Plotly leaves triangles below an area unlit, which those of a fine hull are.
_LIGHTING = {
    "ambient": 0.6, "diffuse": 0.7, "specular": 0.15, "roughness": 0.6,
    "facenormalsepsilon": 0, "vertexnormalsepsilon": 0,
}  # fmt: skip
_ROOM = 0.9  # of the camera about what moves
_LEAST_OPACITY = 0.999  # from which a body hides what is behind it


def write_motion_page(motion: Motion, path: PathLike) -> None:
    """Write `motion_page` to a file; it appears whole or not at all."""
    text = motion_page(motion)
    with replacing(path) as aside:
        aside.write_text(text, encoding="utf-8")


def motion_page(motion: Motion) -> str:
    """The page: bodies that move, an indicator, curves with a cursor, a slider for time.

    The drawing code is inside: the page opens offline. The same bytes for the same motion.

    Parameters
    ----------
    motion : Motion
        Some hundreds of frames, some ten thousand triangles: browsers draw it frame by frame.
    """
    low, high = _corners(motion)
    origin = np.floor((low + high) / 2)  # plotly lights bodies well only near the origin
    figure, moving = _drawing(motion, low, high, origin)
    data = {
        "time": _rounded(motion.time, 4),
        "origin": [float(value) for value in origin],
        "poses": _packed(_about(motion.poses, origin)),
        "carriers": int(motion.poses.shape[1]) if motion.poses.size else 0,
        "moving": moving,
        "phases": [[name, begin, end] for name, begin, end in motion.phases],
        "lights": [
            {"name": one.name, "state": list(one.state), "text": list(one.text)}
            for one in motion.lights
        ],
        "colours": LIGHTS,
        "path": _packed((motion.path - origin).reshape(-1, 3)) if len(motion.path) else "",
    }
    config = {"displaylogo": False, "responsive": True}
    drawing = figure.to_html(
        full_html=False, include_plotlyjs=True, div_id="bodies", default_height="100%",
        config=config,
    )  # fmt: skip
    curves = ""
    if motion.panels:
        curves = _curves(motion).to_html(
            full_html=False, include_plotlyjs=False, div_id="curves", default_height="100%",
            config=config,
        )  # fmt: skip
    facts = "".join(
        f"<span><b>{html.escape(name)}</b> {html.escape(value)}</span>"
        for name, value in motion.facts.items()
    )
    warned = "".join(f"<p>{html.escape(line)}</p>" for line in motion.warnings)
    template = (files("bathyal.view") / "motion_page.html").read_text(encoding="utf-8")
    parts = {
        "title": html.escape(motion.title), "facts": facts, "warnings": warned,
        "drawing": drawing, "curves": curves, "ink": INK, "red": GAP,
        "player": (files("bathyal.view") / "motion_page.js").read_text(encoding="utf-8"),
        "data": json.dumps(data, allow_nan=False).replace("</", "<\\/"),
    }  # fmt: skip
    return _filled(template, parts)


def _filled(template: str, parts: dict[str, str]) -> str:
    """Each {{name}} of the template once; what is put in is not looked at again."""
    pieces = template.split("{{")
    filled = [pieces[0]]
    for piece in pieces[1:]:
        name, _, rest = piece.partition("}}")
        filled += [parts[name], rest]
    return "".join(filled)


def _corners(motion: Motion) -> tuple[Floats, Floats]:
    """Of the box that is shown: what moves and some room about it, and the bottom below."""
    low, high = motion.box()
    room = 0.12 * float(np.max(high - low)) + 1e-3
    low, high = low - room, high + room
    bottoms = [body.vertices for body in motion.bodies if body.kind == "bottom"]
    if bottoms:
        heights = np.concatenate([vertices[:, 2] for vertices in bottoms])
        low[2] = min(low[2], float(heights.min()))
        high[2] = max(high[2], float(np.quantile(heights, 0.95)))
        ends = np.array([[v[:, :2].min(axis=0), v[:, :2].max(axis=0)] for v in bottoms])
        low[:2] = np.minimum(low[:2], ends[:, 0].min(axis=0))
        high[:2] = np.maximum(high[:2], ends[:, 1].max(axis=0))
    return low, high


def _drawing(
    motion: Motion, low: Floats, high: Floats, origin: Floats
) -> tuple[go.Figure, list[dict[str, Any]]]:
    """The figure at the first frame, and which of its traces move, with their own vertices."""
    figure = go.Figure()
    moving: list[dict[str, Any]] = []
    at_rest = [body for body in motion.bodies if body.carrier == AT_REST]
    for body in sorted(at_rest, key=lambda one: one.opacity < _LEAST_OPACITY):
        figure.add_trace(_trace([body], [body.vertices], origin))
    for group in _groups([body for body in motion.bodies if body.carrier != AT_REST]):
        vertices = [motion.world_vertices(body, 0) for body in group]
        moving.append(
            {
                "trace": len(figure.data),
                "vertices": _packed(np.vstack([body.vertices for body in group])),
                "carrier": [[body.carrier, len(body.vertices)] for body in group],
            }
        )
        figure.add_trace(_trace(group, vertices, origin))
    if len(motion.path):
        x, y, z = local(motion.path, origin)
        figure.add_trace(
            go.Scatter3d(
                x=x, y=y, z=z, mode="lines", name="tip", hoverinfo="name",
                line={"color": SEGMENTS[0], "width": 4},
            )
        )  # fmt: skip
    size = high - low
    aspect = 1.9 * size / np.linalg.norm(size)
    center, eye = _camera(motion, (low + high) / 2, aspect / size)
    shown = origin_of(low, high)
    axes = {
        f"{name}axis": {
            "range": [float(low[k] - origin[k]), float(high[k] - origin[k])],
            "title": {"text": f"{name} [m]" + (f" + {shown[k]:,.0f}" if shown[k] else "")},
            **_ticks(low[k], high[k], origin[k], shown[k]),
            "backgroundcolor": "#f3f3f1", "gridcolor": "#dddddd", "zerolinecolor": "#dddddd",
        }
        for k, name in enumerate("xyz")
    }  # fmt: skip
    figure.update_layout(
        scene={
            "aspectmode": "manual",
            "aspectratio": dict(zip("xyz", map(float, aspect), strict=True)),
            "camera": {"center": center, "eye": eye},
            "uirevision": "kept",
            **axes,
        },
        uirevision="kept",
        margin={"l": 0, "r": 0, "t": 0, "b": 0},
        legend={"x": 0.01, "y": 0.99, "bgcolor": "rgba(255,255,255,0.75)"},
        font={"color": INK},
    )
    return figure, moving


def _ticks(low: float, high: float, origin: float, shown: float) -> dict[str, list[Any]]:
    """Round numbers of the world, less `shown`, at their places about the origin."""
    values = [v for v in MaxNLocator(6).tick_values(low - shown, high - shown) if v >= low - shown]
    values = [v for v in values if v <= high - shown]
    return {
        "tickvals": [float(v + shown - origin) for v in values],
        "ticktext": [f"{v:g}".replace("-", "−") for v in np.round(values, 9)],
    }


def _camera(
    motion: Motion, middle: Floats, scale: Floats
) -> tuple[dict[str, float], dict[str, float]]:
    """Plotly's camera, which counts in its own units from the middle of the axes' box: at what
    moves, from the starboard bow."""
    low, high = motion.box()
    center = ((low + high) / 2 - middle) * scale
    back = np.array([0.55, -1.0, 0.38])
    away = _ROOM * float(np.linalg.norm((high - low) * scale)) / 2 / np.sin(np.radians(45 / 2))
    eye = center + away * back / np.linalg.norm(back)
    named = [dict(zip("xyz", map(float, point), strict=True)) for point in (center, eye)]
    return named[0], named[1]


def _groups(bodies: Sequence[Body]) -> list[list[Body]]:
    """Opaque bodies that move are one trace, of which a browser draws few faster than many."""
    opaque = [body for body in bodies if body.opacity >= _LEAST_OPACITY]
    rest = [[body] for body in bodies if body.opacity < _LEAST_OPACITY]
    return ([opaque] if opaque else []) + rest


def _trace(bodies: Sequence[Body], vertices: Sequence[Floats], origin: Floats) -> go.Mesh3d:
    if bodies[0].kind == "bottom":
        heights = vertices[0][:, 2] - origin[2]
        ends = np.quantile(heights, [0.002, 0.998])
        trace = bottom_trace(vertices[0], bodies[0].triangles, origin, (ends[0], ends[1]))
        return trace.update(showscale=False)
    first = np.cumsum([0, *(len(body.vertices) for body in bodies[:-1])])
    triangles = np.vstack([body.triangles + k for body, k in zip(bodies, first, strict=True)])
    x, y, z = local(np.vstack(vertices), origin)
    i, j, k = triangles.T
    colours: dict[str, Any] = {"color": bodies[0].colour}
    if len(bodies) > 1:
        colours = {"facecolor": [body.colour for body in bodies for _ in body.triangles]}
    return go.Mesh3d(
        x=x, y=y, z=z, i=i, j=j, k=k, name="arm" if len(bodies) > 1 else bodies[0].name,
        opacity=bodies[0].opacity, hoverinfo="name", showlegend=True,
        flatshading=bodies[0].kind == "hull",
        lighting=_LIGHTING,
        lightposition={"x": 20000, "y": -20000, "z": 30000}, **colours,
    )  # fmt: skip


def _curves(motion: Motion) -> go.Figure:
    panels = list(motion.panels)
    figure = make_subplots(
        rows=len(panels), cols=1, shared_xaxes=True, vertical_spacing=0.045,
        subplot_titles=[panel.title for panel in panels],
    )  # fmt: skip
    for row, panel in enumerate(panels, start=1):
        for number, (name, values) in enumerate(panel.curves.items()):
            finite = np.where(np.isfinite(values), values, np.nan)
            figure.add_trace(
                go.Scatter(
                    x=motion.time, y=finite, mode="lines", name=name, legend=_legend(row),
                    line={"color": _CURVES[number % len(_CURVES)], "width": 1.5},
                    hovertemplate=f"{html.escape(name)} %{{y:.4g}}<extra>%{{x:.2f}} s</extra>",
                ),
                row=row, col=1,
            )  # fmt: skip
        domain = figure.layout[f"yaxis{row if row > 1 else ''}"].domain
        figure.update_layout(
            {
                _legend(row): {
                    "y": domain[1], "yanchor": "top", "x": 1.01, "font": {"size": 10},
                    "tracegroupgap": 0,
                }
            }
        )  # fmt: skip
    last = f"xaxis{len(panels) if len(panels) > 1 else ''}"
    figure.update_layout({last: {"title": {"text": "time [s]"}}})
    span = {"type": "rect", "xref": "x", "yref": "paper", "y0": 0, "y1": 1, "layer": "below"}
    bands = [
        {**span, "x0": begin, "x1": end, "line": {"width": 0}, "fillcolor": _BANDS[number % 2]}
        for number, (_, begin, end) in enumerate(motion.phases)
    ]
    start = float(motion.time[0])
    figure.update_layout(
        shapes=bands, margin={"l": 48, "r": 10, "t": 22, "b": 38},
        font={"color": INK, "size": 11}, plot_bgcolor="#fbfbfa", hovermode="closest",
    )  # fmt: skip
    figure.update_annotations(font_size=12)
    figure.update_xaxes(
        range=[start, float(motion.time[-1])], gridcolor="#e4e4e1", zerolinecolor="#cccccc"
    )
    figure.update_yaxes(gridcolor="#e4e4e1", zerolinecolor="#b5b5b0")
    return figure


def _legend(row: int) -> str:
    return f"legend{row if row > 1 else ''}"


def _about(poses: Floats, origin: Floats) -> Floats:
    """(F, C, 12): rotation rows, then the place about the origin."""
    if not poses.size:
        return np.empty(0)
    rotation = poses[:, :, :3, :3].reshape(*poses.shape[:2], 9)
    return np.concatenate([rotation, poses[:, :, :3, 3] - origin], axis=2)


def _packed(values: Floats) -> str:
    """Numbers as a browser reads them fast: little-endian float32 in base64."""
    return base64.b64encode(np.ascontiguousarray(values, "<f4").tobytes()).decode("ascii")


def _rounded(values: NDArray[np.float64], digits: int) -> list[float]:
    return [round(float(value), digits) for value in values]


class MotionPage:
    """A motion to look at: in Jupyter where it is the last value of a cell, or as a file.

    Attributes
    ----------
    text : str
        The page, HTML that needs no network.
    """

    def __init__(self, motion: Motion) -> None:
        self.text = motion_page(motion)

    def write(self, path: PathLike) -> None:
        """Write the page; it appears whole or not at all.

        Raises
        ------
        OSError
            Where the file cannot be written.
        """
        with replacing(path) as aside:
            aside.write_text(self.text, encoding="utf-8")

    def _repr_html_(self) -> str:
        return (
            '<iframe style="width: 100%; height: 640px; border: 0" '
            f'srcdoc="{html.escape(self.text, quote=True)}"></iframe>'
        )
