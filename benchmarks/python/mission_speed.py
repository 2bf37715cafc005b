# SPDX-License-Identifier: BSD-3-Clause
"""An hour of a survey with its log, and what a saved state costs.

    python -m benchmarks.python.mission_speed

Processor time of one process. The survey is run five times: all logs must have the same bytes
before any time is printed.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from pathlib import Path

import bathyal

SURVEY = """\
world: {water: {surface: 0}, terrain: {seabed: {size: [700, 300], spacing: 2, depth: 20}}}
vehicle: {preset: bluerov2_heavy}
start: {position: [-250, -60, -1]}
longest: 1 h
mission:
  - dive: {depth: 10 m}
  - survey: {corner: [-250, -60], size: [500, 120], spacing: 10 m, depth: 15 m, speed: 0.5 m/s}
"""
ROUNDS = 5


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mission.yaml"
        path.write_text(SURVEY)
        mission = bathyal.read_mission(path)
        times, logs = [], []
        for row in range(ROUNDS):
            begun = time.process_time()
            result = bathyal.run(mission, seed=1, out=Path(folder) / str(row))
            times.append(time.process_time() - begun)
            logs.append((Path(folder) / str(row) / "log.mcap").read_bytes())
        assert all(log == logs[0] for log in logs)
        assert result.metrics["duration"] == 3600.0, result
        seconds = statistics.median(times)
        print(f"| an hour's survey, {len(logs[0]) / 1e6:.0f} MB of log | {seconds:.2f} s |"
              f" {3600 / seconds:,.0f} × real time |")  # fmt: skip
        going = bathyal.Run(mission, seed=1, log=Path(folder) / "going.mcap")
        going.step(count=6000)
        saves = []
        for _ in range(200):
            begun = time.perf_counter()
            state = going.save()
            saves.append(time.perf_counter() - begun)
            going.step()
        took = 1e3 * statistics.median(saves)
        print(f"| a saved state, {len(state) / 1e3:.0f} kB | {took:.2f} ms | |")
        resumes = []
        (Path(folder) / "copy.mcap").write_bytes((Path(folder) / "going.mcap").read_bytes())
        for _ in range(20):
            begun = time.perf_counter()
            bathyal.Run(mission, seed=1, log=Path(folder) / "copy.mcap", state=state)
            resumes.append(time.perf_counter() - begun)
        print(f"| resumed from it | {1e3 * statistics.median(resumes):.1f} ms | |")


if __name__ == "__main__":
    main()
