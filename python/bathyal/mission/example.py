# SPDX-License-Identifier: BSD-3-Clause
"""An example of a mission."""

from __future__ import annotations

from pathlib import Path

from bathyal.io.files import PathLike, replacing

MISSION = """\
# A survey over an uneven bottom; a thruster dies at minute two, and the dive goes on without it.
# Numbers are SI, or carry a unit. x, y level, z up; headings count from x towards y.
name: rehearsal
world:
  water: {surface: 0, current: [0.08, 0.03, 0]}
  terrain: {seabed: {size: [80, 80], spacing: 0.5, seed: 3, depth: 12, relief_rms: 0.4}}
vehicle:
  preset: bluerov2_heavy
  weights: [{name: ballast, mass: 1.5, volume: 0.00019, position: [0, 0, -0.1]}]
start: {position: [-12, -8, -0.3]}

faults:
  - {device: thruster_2, kind: dead, at: 2 min}

always:
  - {name: too deep, when: depth > 15 m, do: [drop_weight, surface]}
  - {name: too near, when: altitude < 0.7 m, persist: 1 s, do: surface}
  - {name: battery, when: battery < 20 %, do: surface}
  - {name: leak, when: fault.hull, do: [drop_weight, surface]}
  - {name: lost, when: dvl_age > 20 s and depth > 1 m, do: [drop_weight, surface]}

mission:
  - dive: {depth: 6 m}
  - survey: {corner: [-12, -8], size: [24, 12], spacing: 4 m, altitude: 3 m, speed: 0.4 m/s}
  - fallback:
      - timeout: {after: 3 min, do: {leg: {to: [0, 0], altitude: 2 m}}}
      - surface
  - hold: {time: 20 s, at: [0, 0], altitude: 2 m}
  - photo: {name: marker}
  - surface
"""


def write_mission_example(path: PathLike) -> list[Path]:
    """Write the example, and return what was written."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as temporary:
        Path(temporary).write_text(MISSION, encoding="utf-8")
    return [path]
