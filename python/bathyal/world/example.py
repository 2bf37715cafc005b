# SPDX-License-Identifier: BSD-3-Clause
"""An example of a world, and a track over it."""

from __future__ import annotations

from pathlib import Path

from bathyal.io.files import PathLike, replacing

WORLD = """\
# A sandy bottom with ripples and boulders, a pipeline with a free span, a wreck, a cable, fish.
# Lengths in metres; z up, the surface at 0.
name: example
water: {surface: 0, temperature: 9, salinity: 34.5}
terrain:
  material: sand
  seabed:
    size: [160, 90]
    spacing: 0.2
    seed: 7
    depth: 22
    relief_rms: 0.25
    ripple_height: 0.07
    ripple_wavelength: 1.1
    ripple_direction: 0.6
pipelines:
  - name: pipeline
    route: [[-79, -18], [-30, -14], [20, -17], [79, -12]]
    diameter: 0.7
    material: concrete
    options: {burial: 0.2, spans: [[62, 78]], span_gap: 0.35}
cables:
  - {name: cable, route: [[-70, 40], [-20, 22], [30, 28], [75, 20]], diameter: 0.12}
objects:
  - name: wreck
    wreck: {length: 18, beam: 5, seed: 3}
    material: steel
    on_ground: true
    pose: {position: [28, 12, -0.4], rpy_deg: [0, 0, 35]}
  - name: mine
    mine: {kind: manta}
    material: steel
    on_ground: true
    pose: {position: [-35, 14, -0.1]}
clones:
  - name: boulder
    boulder: {radius: 0.45, seed: 5}
    count: 120
    material: rock
    options: {seed: 2, scale: [0.3, 2.2], apart: 1.5}
paint:
  - {polygon: [[-60, -45], [-15, -45], [-25, 10], [-55, 5]], material: gravel}
fish:
  - {name: fish, count: 6, length: 0.5, duration: 120, seed: 4}
"""

TRACK = """\
x,y,z,heading_deg
-70,0,-13,90
70,0,-13,90
"""


def write_example(path: PathLike) -> list[Path]:
    """Writes the world at `path` and the track next to it, track.csv.

    Returns
    -------
    list of Path
    """
    world = Path(path)
    world.parent.mkdir(parents=True, exist_ok=True)
    files = [world, world.parent / "track.csv"]
    for file, text in zip(files, (WORLD, TRACK), strict=True):
        with replacing(file) as target:
            Path(target).write_text(text, encoding="utf-8")
    return files
