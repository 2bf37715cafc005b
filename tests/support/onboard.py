# SPDX-License-Identifier: BSD-3-Clause
"""Missions with lines to programs, and programs at their ends."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bathyal

MISSION = """\
world: {water: {surface: 0}, terrain: {seabed: {size: [60, 60], spacing: 1, depth: 10}}}
vehicle: {preset: bluerov2_heavy}
start: {position: [3, 4, -0.5]}
origin: {latitude: 43.1, longitude: 131.9}
links:
  - {protocol: nmea, port: pty, name: port, timeout: 20}
mission: [wait: {time: 20 s}]
"""


@dataclass
class Ended:
    """A run, and what its program has returned."""

    result: bathyal.RunResult
    program: Any


def run_with(
    mission: Path, out: Path, program: Callable[[Path], Any], *, name: str = "port", **given: Any
) -> Ended:
    """Runs a mission and, in a thread, a program at the end of its pseudo-terminal."""
    returned: list[Any] = []
    port = out / name

    def connect() -> None:
        while not port.exists():
            time.sleep(0.005)
        returned.append(program(port))

    thread = threading.Thread(target=connect, daemon=True)
    thread.start()
    result = bathyal.run(mission, out=out, **{"seed": 1, **given})
    thread.join(20)
    return Ended(result, returned[0] if returned else None)


def keep_down(vehicle):
    """Software on board: keeps a depth of 2 m."""
    for moment in vehicle:
        depth = moment.latest("depth")
        if depth is not None:
            push = max(-1.0, min(1.0, 0.5 * (depth.values[0] - 2.0)))
            vehicle.command([0, 0, 0, 0, push, push, push, push])
    return vehicle


def free_port(kind: socket.SocketKind = socket.SOCK_STREAM) -> int:
    """A port of this machine that nobody has."""
    with socket.socket(type=kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
