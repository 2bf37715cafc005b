# SPDX-License-Identifier: BSD-3-Clause
"""Draws the example world from above, and a side-scan flown over it.

Run as ``python docs/sea_picture.py docs/images``: sea_world.png and sea_survey.png.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from small_png import save_png

import bathyal
from bathyal.world.example import write_example


def main(folder: str) -> None:
    out = Path(folder)
    with tempfile.TemporaryDirectory() as scratch:
        file, track = write_example(Path(scratch) / "world.yaml")
        world = bathyal.read_world(file)
        trajectory = bathyal.read_track(track, speed=2.0)
    save_png(world.show(), out / "sea_world.png", dpi=80)
    sonar = bathyal.sonars.side_scan(physics="real").replace(range=40.0)
    record = sonar.survey(world, trajectory)
    save_png(record.plot(), out / "sea_survey.png", dpi=38)


if __name__ == "__main__":
    main(*sys.argv[1:])
