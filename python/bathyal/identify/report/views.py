# SPDX-License-Identifier: BSD-3-Clause
"""An identification in plotly figures that answer to the mouse: the arm among its touches, pairs
before and after, singular values, residuals against each joint."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go  # type: ignore[import-untyped]
from plotly.subplots import make_subplots  # type: ignore[import-untyped]

from bathyal._core import ArmFit, Touches, Tracked
from bathyal.arm.joint_values import joint_values
from bathyal.identify.report.curves import AXIS_COLOURS, curves_of, rank_gap, thinned
from bathyal.identify.report.tables import point_name
from bathyal.view.arm_views import show_arm
from bathyal.view.palette import AFTER, BEFORE, GAP, INK

_MOST_POSES = 6  # of the arm among its touches
_MOST_PLACES = 2000
_MOST_TITLES = 6  # of points side by side
_HEIGHT = 380
_PANEL = 230  # height of a row of panels
_PANELS_ABREAST = 4


def show_touches(fit: ArmFit, data: Touches | Tracked) -> go.Figure:
    """The arm that was found in a few of its poses, and the points as found.

    Parameters
    ----------
    fit : ArmFit
    data : Touches or Tracked
        What it was found from; measured positions are drawn where they were seen.

    Returns
    -------
    plotly.graph_objects.Figure
        In the world [m].
    """
    rows = thinned(len(data), _MOST_POSES)
    figure = show_arm(fit.arm, data.q[rows])
    if isinstance(data, Tracked):
        places = data.position[thinned(len(data), _MOST_PLACES)]
        names = ["measured"] * len(places)
        text = False
    else:
        places = fit.points
        names = [point_name(data, label) for label in fit.point_labels]
        text = True
    x, y, z = np.asarray(places).reshape(-1, 3).T
    figure.add_trace(
        go.Scatter3d(
            x=x, y=y, z=z, text=names, name="points", textposition="top center",
            mode="markers+text" if text else "markers",
            marker={"size": 5 if text else 2, "color": BEFORE}, hoverinfo="text+x+y+z",
        )
    )  # fmt: skip
    figure.update_layout(height=520)
    return figure


def show_before_and_after(fit: ArmFit, data: Touches | Tracked) -> go.Figure:
    """Distances of every pair of touches of one point before and after, point after point (figure
    4 of Yukhimets, Gubankov 2023); of tracked poses, from where they were seen [mm]."""
    curves = curves_of(fit, data)
    figure = go.Figure()
    start = 0
    for curve in curves.curves:
        place = start + np.arange(len(curve.before))
        for values, colour, name in ((curve.before, BEFORE, "before"),
                                     (curve.after, AFTER, "after")):  # fmt: skip
            figure.add_trace(
                go.Scattergl(
                    x=place, y=1e3 * values, mode="markers", name=name, legendgroup=name,
                    showlegend=start == 0, text=curve.marks, marker={"size": 3, "color": colour},
                    hovertemplate=f"{curve.name}, %{{text}}: %{{y:.4g}} mm<extra>{name}</extra>",
                )
            )  # fmt: skip
        for height, colour in ((curve.rms_before, BEFORE), (curve.rms_after, AFTER)):
            figure.add_trace(
                go.Scatter(
                    x=[place[0], place[-1]], y=[1e3 * height] * 2, mode="lines", showlegend=False,
                    line={"color": colour, "width": 1.5}, hoverinfo="skip",
                )
            )  # fmt: skip
        if len(curves.curves) <= _MOST_TITLES:
            rms = f"{1e3 * curve.rms_before:.3g} → {1e3 * curve.rms_after:.3g} mm"
            figure.add_annotation(
                x=(place[0] + place[-1]) / 2, y=1.0, yref="paper", yanchor="bottom",
                text=f"{curve.name}<br>{rms}", showarrow=False, font={"size": 11},
            )  # fmt: skip
        start += len(curve.before)
    low, high = (float(np.log10(1e3 * limit)) for limit in curves.limits)
    figure.update_yaxes(type="log", range=[low, high], title=f"{curves.what} [mm]")
    figure.update_xaxes(title=curves.across)
    return _dressed(figure, _HEIGHT)


def show_singular_values(fit: ArmFit) -> go.Figure:
    """What each direction of the parameters does to the tip; those beyond the rank do nothing."""
    values, low = rank_gap(fit)
    place = np.arange(1, len(values) + 1)
    figure = go.Figure()
    for mask, colour, name in (
        (place <= fit.rank, AFTER, "determined"), (place > fit.rank, GAP, "not determined"),
    ):  # fmt: skip
        figure.add_trace(
            go.Scatter(
                x=place[mask], y=values[mask], mode="markers", name=name,
                marker={"color": colour, "size": 7}, hovertemplate="%{y:.3g}<extra></extra>",
            )
        )  # fmt: skip
    figure.update_yaxes(
        type="log", title="mm at the tip per mm, mrad", exponentformat="power", dtick=3,
        range=[np.log10(low), np.log10(4 * values[0])],
    )  # fmt: skip
    figure.update_xaxes(title=f"direction; rank {fit.rank} of {len(values)}")
    return _dressed(figure, _HEIGHT)


def show_residuals(fit: ArmFit, data: Touches | Tracked) -> go.Figure:
    """Residuals by axis against each joint [mm]: a pattern is not due to geometry."""
    joints = joint_values(fit.arm, data)
    abreast = min(_PANELS_ABREAST, len(joints))
    down = -(-len(joints) // abreast)
    rows = thinned(len(data))
    figure = make_subplots(
        rows=down, cols=abreast, shared_yaxes=True, horizontal_spacing=0.02,
        vertical_spacing=0.36 / down,
    )  # fmt: skip
    marks = [f"row {row}" for row in rows]
    for k, joint in enumerate(joints):
        cell = {"row": k // abreast + 1, "col": k % abreast + 1}
        for axis, colour in enumerate(AXIS_COLOURS):
            figure.add_trace(
                go.Scattergl(
                    x=joint.values[rows], y=1e3 * fit.residuals[rows, axis], mode="markers",
                    name="xyz"[axis], legendgroup="xyz"[axis], showlegend=k == 0, text=marks,
                    marker={"size": 4, "color": colour, "opacity": 0.75},
                    hovertemplate="%{text}: %{y:.3g} mm<extra></extra>",
                ),
                **cell,
            )  # fmt: skip
        figure.update_xaxes(title=f"{joint.name} [{joint.unit}]", **cell)
    figure.update_yaxes(title="residual [mm]", col=1)
    return _dressed(figure, _PANEL * down + 60)


def _dressed(figure: go.Figure, height: int) -> go.Figure:
    figure.update_layout(
        height=height, margin={"l": 60, "r": 16, "t": 44, "b": 48}, font={"color": INK, "size": 12},
        plot_bgcolor="#f7f7f5",
        legend={
            "orientation": "h", "y": 0.02, "yanchor": "bottom", "x": 0.01, "xanchor": "left",
            "itemsizing": "constant", "bgcolor": "rgba(255,255,255,0.8)",
        },
    )  # fmt: skip
    figure.update_yaxes(gridcolor="#e2e2df", zerolinecolor="#bbbbbb")
    figure.update_xaxes(gridcolor="#e2e2df", zeroline=False)
    return figure
