# SPDX-License-Identifier: BSD-3-Clause
"""Plans of touches as a table to touch by, and as a picture."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from bathyal._core import TouchPlan, arm_parts
from bathyal.io.files import PathLike, known_suffix, replacing
from bathyal.view.arm_views import plot_arm
from bathyal.view.palette import INK

_HOW_TO = (
    "bathyal touches: bring the tip to the point in about each of these poses, hold it still, and",
    "put what the joints then read in place of the row's numbers. Any tilt near the one planned",
    "will do; rows may be left out or added. Points, world [m]:",
)
# Apart from each other, and from the blue of links and the orange of joints.
_POINTS = ("#c2189b", "#0a8f4f", "#8f5bff", "#7a3b00", "#e3120b")
_DEGREE_DIGITS, _METRE_DIGITS = 3, 5


def write_plan(plan: TouchPlan, path: PathLike) -> None:
    """Write a plan as a table to touch by; what `TouchPlan.write` does.

    Parameters
    ----------
    plan : TouchPlan
    path : path
        ``.csv``: comments, then ``point,q1_deg,q2_deg,…``, one row a touch, ``_m`` for sliding
        joints: what `bathyal.read_touches` reads, once the joints' own readings are in it. The
        file appears whole or not at all.

    Raises
    ------
    ValueError
        For another suffix.
    OSError
        Where the file cannot be written.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "plan.csv"
    >>> plan = bathyal.plan_touches(bathyal.arms.ur10e(), 8, num_points=2)
    >>> plan.write(path)
    >>> bathyal.read_touches(path)
    Touches(8 poses, 6 joints)
    """
    known_suffix(path, (".csv",), "table")
    lines = [f"# {line}" for line in _HOW_TO]
    lines += [
        f"# point {number} at {x:.3f} {y:.3f} {z:.3f}"
        for number, (x, y, z) in enumerate(plan.points)
    ]
    lines += [f"# measure the distance between points {a} and {b}" for a, b in plan.known_distances]
    slides = sliding_coordinates(plan)
    lines.append(
        ",".join(["point", *(f"q{k + 1}_{'m' if s else 'deg'}" for k, s in enumerate(slides))])
    )
    digits = np.where(slides, _METRE_DIGITS, _DEGREE_DIGITS)
    for point, q in zip(plan.point, np.where(slides, plan.q, np.degrees(plan.q)), strict=True):
        cells = [f"{value:.{n}f}" for value, n in zip(q, digits, strict=True)]
        lines.append(",".join([str(point), *cells]))
    with replacing(path) as aside:
        aside.write_text("\n".join(lines) + "\n", encoding="utf-8")


def plot_plan(plan: TouchPlan, path: PathLike | None = None) -> Figure:
    """A picture of a plan: the arm in its poses, the points, the tool's directions at each.

    What `TouchPlan.plot` returns.

    Parameters
    ----------
    plan : TouchPlan
    path : path, optional
        ``.png``, ``.pdf`` or ``.svg`` to write it to, too. It appears whole or not at all.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "plan.png"
    >>> plan = bathyal.plan_touches(bathyal.arms.ur10e(), 8, num_points=2)
    >>> _ = plan.plot(path)
    >>> path.stat().st_size > 10_000
    True
    """
    figure = plot_arm(plan.arm, plan.q[_spread(plan)])
    axes: Any = figure.axes[0]
    poses = np.asarray(plan.arm.forward(plan.q))
    box = [axes.get_xlim(), axes.get_ylim(), axes.get_zlim()]
    stroke = 0.1 * float(np.ptp(box, axis=1).max())
    for number, place in enumerate(plan.points):
        colour = _POINTS[number % len(_POINTS)]
        mine = plan.point == number
        if not mine.any():
            continue
        tails = place - stroke * poses[mine, :3, 2]
        for tail in tails:
            axes.plot(*np.stack([tail, place]).T, color=colour, linewidth=1.1, zorder=8)
        axes.scatter(*place, s=46, color=colour, edgecolors="white", zorder=9, depthshade=False,
                     label=f"point {number}: {mine.sum()} touches")  # fmt: skip
    figure.legend(
        loc="upper right", bbox_to_anchor=(0.97, 0.975), frameon=False, fontsize=9, labelcolor=INK
    )
    text = (
        f"{len(plan)} touches, predicted to leave {1e3 * plan.worst_tip_std:.3g} mm at the worst "
        f"pose, {1e3 * plan.median_tip_std:.3g} mm at the median one"
    )
    figure.text(0.04, 0.928, text, fontsize=9, color=INK)
    if path is not None:
        with replacing(path) as aside:
            figure.savefig(aside)
    return figure


def sliding_coordinates(plan: TouchPlan) -> list[bool]:
    """Of each coordinate whether it is a length."""
    joints = arm_parts(plan.arm)["joints"]
    return [
        any(j["coordinate"] == k and j["type"] == "prismatic" for j in joints)
        for k in range(plan.arm.size)
    ]


def _spread(plan: TouchPlan) -> list[int]:
    """A few rows, some of each point."""
    most = 4
    rows: list[int] = []
    for number in np.unique(plan.point):
        mine = np.flatnonzero(plan.point == number)
        few = np.linspace(0, len(mine) - 1, min(most, len(mine))).round().astype(int)
        rows.extend(mine[few].tolist())
    return rows
