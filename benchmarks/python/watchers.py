# SPDX-License-Identifier: BSD-3-Clause
"""Faults that watchers on board see: how many, of which device, how late; and false alarms.

    python -m benchmarks.python.watchers [--seeds 100]

Each fault begins at 60 s of a dive; it counts as seen when anything is reported within 60 s, as
named when the first report names its device. Runs without faults give the alarms that are false.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
from pathlib import Path

import bathyal

MISSION = """\
world: {water: {surface: 0, current: [0.1, 0, 0]},
        terrain: {seabed: {size: [120, 120], spacing: 1, depth: 15, relief_rms: 0.3}}}
vehicle: {preset: bluerov2_heavy}
start: {position: [-20, -20, -1]}
longest: LONGEST s
faults: [FAULT]
mission:
  - dive: {depth: 8 m}
  - survey: {corner: [-20, -20], size: [40, 40], spacing: 5 m, depth: 10 m, speed: 0.4 m/s}
  - wait: {time: 10 h}
"""
FAULTS = [
    ("dvl", "off", 0.0),
    ("dvl", "stuck", 0.0),
    ("dvl", "garbage", 1.0),
    ("depth", "off", 0.0),
    ("depth", "stuck", 0.0),
    ("depth", "bias", 2.0),
    ("depth", "drift", 0.05),
    ("compass", "off", 0.0),
    ("thruster_1", "dead", 0.0),
    ("thruster_3", "weak", 0.5),
    ("thruster_6", "reversed", 0.0),
    ("hull", "leak", 0.05),
]
BEGINS, PATIENCE = 60.0, 60.0
HOUR = 3600.0


def reports(folder: Path, fault: str, longest: float, seed: int) -> list[tuple[float, str]]:
    path = folder / "mission.yaml"
    path.write_text(MISSION.replace("FAULT", fault).replace("LONGEST", f"{longest:.0f}"))
    run = bathyal.Run(path, seed=seed, log=folder / "log.mcap")
    while run.step(count=100):
        pass
    return [(event.time, event.text) for event in run.events if event.kind == "report"]


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=100)
    seeds = parser.parse_args().seeds
    print("| fault | seen | its device named | median delay |\n|---|---|---|---|")
    seen_all, named_all = 0, 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for device, kind, size in FAULTS:
            fault = f"{{device: {device}, kind: {kind}, size: {size}, at: {BEGINS:.0f} s}}"
            delays, named = [], 0
            for seed in range(seeds):
                late = [
                    (time, text)
                    for time, text in reports(folder, fault, BEGINS + PATIENCE, seed)
                    if time >= BEGINS
                ]
                if late:
                    delays.append(late[0][0] - BEGINS)
                    named += late[0][1].startswith(device)
            seen_all += len(delays)
            named_all += named
            median = f"{statistics.median(delays):.1f} s" if delays else "—"
            print(
                f"| {device} {kind} {size or ''} | {len(delays)} of {seeds} | {named} | {median} |"
            )
        total = seeds * len(FAULTS)
        print(
            f"| all | **{100 * seen_all / total:.1f} %** | **{100 * named_all / total:.1f} %** | |"
        )
        alarms = sum(len(reports(folder, "", HOUR, seed)) for seed in range(seeds))
        print(f"\n{alarms} false alarms in {seeds} hours without a fault.")


if __name__ == "__main__":
    main()
