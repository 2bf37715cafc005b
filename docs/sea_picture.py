# SPDX-License-Identifier: BSD-3-Clause
"""Draws the example world from above, and a side-scan flown over it.

Run as ``python docs/sea_picture.py docs/images``: sea_world.png and sea_survey.png.
"""

from __future__ import annotations

import io
import sys
import tempfile
from pathlib import Path

from matplotlib.figure import Figure
from PIL import Image

import bathyal
from bathyal.world.example import write_example


def save(figure: Figure, path: Path, *, dpi: int, colours: int = 0) -> None:
    """Without transparency; in so many colours where there are hardly more."""
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=dpi)
    picture = Image.open(drawn).convert("RGB")
    if colours:
        picture = picture.quantize(colours, dither=Image.Dither.NONE)
    picture.save(path, optimize=True)


def main(folder: str) -> None:
    out = Path(folder)
    with tempfile.TemporaryDirectory() as scratch:
        file, track = write_example(Path(scratch) / "world.yaml")
        world = bathyal.read_world(file)
        trajectory = bathyal.read_track(track, speed=2.0)
    save(world.show(), out / "sea_world.png", dpi=72)
    sonar = bathyal.sonars.side_scan(physics="real").replace(range=40.0)
    record = sonar.survey(world, trajectory)
    save(record.plot(), out / "sea_survey.png", dpi=42, colours=256)


if __name__ == "__main__":
    main(*sys.argv[1:])
