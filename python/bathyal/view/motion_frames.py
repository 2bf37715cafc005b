# SPDX-License-Identifier: BSD-3-Clause
"""A motion as a series of PNG, and a sheet with some of them and the curves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from bathyal.errors import argument_error
from bathyal.io.files import PathLike, replacing
from bathyal.view.figure import write_png
from bathyal.view.motion import AT_REST, Floats, Motion, frames_of
from bathyal.view.motion_page import LIGHTS
from bathyal.view.palette import GAP, INK
from bathyal.view.render import Drawn, Stage, looking_at

_DPI = 100
_SIZE = (720, 450)  # pixels of a frame
_STRIP = 46  # of the line of text under it
_SHEET_IN = (11.69, 8.27)
_ON_SHEET = 6
_MOST_FRAMES = 999

Picture = NDArray[np.uint8]


def write_frames(
    motion: Motion, folder: PathLike, *, count: int = 20, size: tuple[int, int] = _SIZE
) -> list[Path]:
    """Write ``0001.png`` … into a folder: the motion at evenly spread times.

    Parameters
    ----------
    motion : Motion
    folder : path
        Made where it is missing.
    count : int
        How many, 1 to 999; one of a posture at rest.
    size : (int, int)
        Width and height [pixels].

    Returns
    -------
    list of pathlib.Path
    """
    if not 1 <= count <= _MOST_FRAMES:
        raise argument_error("count", f"1 to {_MOST_FRAMES}", count)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    pictures = _Pictures(motion, size)
    paths = []
    moments = np.linspace(motion.time[0], motion.time[-1], count if len(motion.time) > 1 else 1)
    for number, moment in enumerate(moments.tolist(), start=1):
        path = folder / f"{number:04d}.png"
        frame = motion.row_at(moment)
        write_png(_labelled(motion, pictures.at(frame), frame, _text(motion, moment)), path)
        paths.append(path)
    return paths


def motion_sheet(motion: Motion, *, title: str = "") -> Figure:
    """One page: six moments of a motion, and its curves below.

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own: no window, and nothing of pyplot's state is touched.
    """
    figure = Figure(figsize=_SHEET_IN, dpi=160, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.03, 0.955, title or motion.title, fontsize=13, weight="bold", color=INK)
    facts = "   ".join(f"{name} {value}" for name, value in motion.facts.items())
    figure.text(0.03, 0.93, facts, fontsize=8.5, color=INK, alpha=0.8)
    pictures = _Pictures(motion, (560, 350))
    for place, frame in enumerate(moments_of(motion, _ON_SHEET)):
        row, column = divmod(place, 3)
        axes = figure.add_axes((0.03 + 0.316 * column, 0.633 - 0.29 * row, 0.308, 0.265))
        axes.imshow(pictures.at(frame))
        axes.set_axis_off()
        axes.set_title(
            _text(motion, float(motion.time[frame])), fontsize=8, color=INK, loc="left", pad=3
        )
        for k, light in enumerate(motion.lights):
            axes.plot(
                0.965 - 0.05 * k, 0.93, "o", transform=axes.transAxes, markersize=8,
                color=LIGHTS[light.state[frame]], markeredgecolor="white",
            )  # fmt: skip
    _draw_panels(figure, motion)
    return figure


def write_sheet(motion: Motion, path: PathLike, *, title: str = "") -> None:
    """Save `motion_sheet`, ``.png``, ``.pdf`` or ``.svg``; the whole file or none of it."""
    figure = motion_sheet(motion, title=title)
    if Path(path).suffix.lower() == ".png":
        write_png(figure, path)
        return
    with replacing(path) as aside:
        figure.savefig(aside)


def moments_of(motion: Motion, count: int) -> list[int]:
    """Rows that show a motion in short: the ends of its phases where they are enough, else evenly
    spread ones."""
    ends = [begin for _, begin, _ in motion.phases[:1]] + [end for _, _, end in motion.phases]
    if len(ends) < count:
        return [int(row) for row in frames_of(motion.time, count)]
    ends = [ends[int(k)] for k in np.unique(np.linspace(0, len(ends) - 1, count).round())]
    return [motion.row_at(end) for end in ends]


class _Pictures:
    """Frames of one motion from one camera."""

    def __init__(self, motion: Motion, size: tuple[int, int]) -> None:
        self.motion = motion
        still = [body for body in motion.bodies if body.carrier == AT_REST]
        low, high = motion.box()
        self.stage = Stage(
            [Drawn(b.vertices, b.triangles, b.colour, b.opacity) for b in still],
            looking_at(low, high, size[0] / size[1]),
            size,
        )

    def at(self, frame: int) -> Picture:
        moving = [
            Drawn(self.motion.world_vertices(b, frame), b.triangles, b.colour, b.opacity)
            for b in self.motion.bodies
            if b.carrier != AT_REST
        ]
        return self.stage.picture(moving)


def _text(motion: Motion, moment: float) -> str:
    phase = motion.phase_at(moment)
    return f"{moment:.2f} s" + (f", {phase}" if phase else "")


def _labelled(motion: Motion, picture: Picture, frame: int, label: str) -> Figure:
    height, width = picture.shape[:2]
    figure = Figure(figsize=(width / _DPI, (height + _STRIP) / _DPI), dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    share = _STRIP / (height + _STRIP)
    axes = figure.add_axes((0, share, 1, 1 - share))
    axes.imshow(picture, aspect="auto", interpolation="none")
    axes.set_axis_off()
    figure.text(0.02, share / 2, label, fontsize=11, color=INK, va="center")
    strip = figure.add_axes((0, 0, 1, share))
    strip.set(xlim=(0, 1), ylim=(0, 1))
    strip.set_axis_off()
    for k, light in enumerate(motion.lights):
        left = 0.32 + 0.34 * k
        colour = LIGHTS[light.state[frame]]
        strip.plot(left, 0.5, "o", markersize=11, color=colour, markeredgecolor="#555555")
        strip.text(left + 0.02, 0.5, light.text[frame], fontsize=10, color=INK, va="center")
    return figure


def _draw_panels(figure: Figure, motion: Motion) -> None:
    panels = list(motion.panels)
    count = max(len(panels), 1)
    width = (0.95 - 0.045 * count) / count
    for k, panel in enumerate(panels):
        axes = figure.add_axes((0.045 + k * (width + 0.045), 0.06, width, 0.235))
        for name, values in panel.curves.items():
            finite: Floats = np.where(np.isfinite(values), values, np.nan)
            axes.plot(motion.time, finite, label=name, linewidth=1)
        for _, begin, _ in motion.phases[1:]:
            axes.axvline(begin, color="#cccccc", linewidth=0.6)
        if panel.title.startswith("clearance"):
            axes.axhline(0, color=GAP, linewidth=0.6)
        axes.set_title(panel.title, fontsize=8, color=INK)
        axes.set_xlabel("time [s]", fontsize=7)
        axes.tick_params(labelsize=7)
        axes.legend(fontsize=6, frameon=False)
