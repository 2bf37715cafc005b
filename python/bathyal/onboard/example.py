# SPDX-License-Identifier: BSD-3-Clause
"""An example of software on board, and of a mission that waits for it."""

from __future__ import annotations

from pathlib import Path

from bathyal.io.files import PathLike, replacing

MISSION = """\
# A program on board steers, at the end of a serial line that is not there; a thruster dies.
name: a program on board
world:
  water: {surface: 0, current: [0.05, 0, 0]}
  terrain: {seabed: {size: [60, 60], spacing: 1, depth: 10}}
vehicle: {preset: bluerov2_heavy}
start: {position: [0, 0, -0.5]}
origin: {latitude: 43.1, longitude: 131.9}
date: 2026-06-07T08:00:00Z

links:
  - {protocol: nmea, port: pty, name: vehicle}

faults:
  - {device: thruster_7, kind: dead, at: 30 s}

mission: [wait: {time: 1 min}]
"""

PROGRAM = '''\
"""Software on board: dives to 3 m and keeps there. python program.py PORT|LOG"""
import sys
import time
from pathlib import Path

import bathyal


def keep_down(vehicle):
    for moment in vehicle:
        depth = moment.latest("depth")
        if depth is not None:
            push = max(-1.0, min(1.0, 0.8 * (depth.values[0] - 3.0)))
            vehicle.command([0, 0, 0, 0, push, push, push, push])


if __name__ == "__main__":
    path = Path(sys.argv[1])
    while not path.exists():  # the run makes it
        time.sleep(0.1)
    replays = path.suffix == ".mcap"
    keep_down(bathyal.ReplayedVehicle(path) if replays else bathyal.SerialVehicle(path))
'''


def write_onboard_example(folder: PathLike) -> list[Path]:
    """Write ``with_program.yaml`` and ``program.py``, and return what was written."""
    written = []
    for name, text in (("with_program.yaml", MISSION), ("program.py", PROGRAM)):
        path = Path(folder) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(path) as temporary:
            Path(temporary).write_text(text, encoding="utf-8")
        written.append(path)
    return written
