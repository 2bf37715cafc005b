# SPDX-License-Identifier: BSD-3-Clause
"""A run base that two programs write, and queries in 100 000 runs.

    python -m benchmarks.python.run_base

Every run must be there, and each query's answer must be that of a loop over all runs, before a time
is printed.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import bathyal
from bathyal.mission.log import RunLog

WRITTEN, QUERIED, ROUNDS = 10_000, 100_000, 9
WRITER = "import sys; from benchmarks.python.run_base import write; write(*sys.argv[1:])"
STATUSES = ("done", "failed", "aborted", "timeout")
QUERIES: list[tuple[str, Callable[[bathyal.RunResult], bool]]] = [
    ("metric depth_max < 20 and status = 'done'",
     lambda run: run.metrics["depth_max"] < 20 and run.status == "done"),
    ("metric energy_wh > 99 and metric depth_max < 50",
     lambda run: run.metrics["energy_wh"] > 99 and run.metrics["depth_max"] < 50),
    ("fault = 'thruster_3' and not event = 'guard'",
     lambda run: any(e.text.startswith("thruster_3 ") for e in run.faults)
     and all(e.kind != "guard" for e in run.events)),
]  # fmt: skip


def made(seed: int) -> bathyal.RunResult:
    """A run's record of twelve metrics and up to four events, without a log."""
    random = np.random.default_rng(seed)
    metrics = dict(zip([f"metric_{k}" for k in range(9)], random.random(9), strict=True))
    metrics |= {"depth_max": 1000 * random.random(), "energy_wh": 100 * random.random()}
    events = [bathyal.RunEvent(0.0, "start", "made"), bathyal.RunEvent(9.0, "end", "done")]
    if random.random() < 0.05:
        device = f"thruster_{random.integers(1, 9)}"
        events.insert(1, bathyal.RunEvent(4.0, "fault", f"{device} dead begins"))
    if random.random() < 0.5:
        events.insert(1, bathyal.RunEvent(5.0, "guard", "depth"))
    return bathyal.RunResult(
        name="made", seed=seed, status=STATUSES[seed % 4], events=events,
        metrics={"duration": 9.0, **{name: float(value) for name, value in metrics.items()}},
        log=RunLog("nowhere/log.mcap"), versions={"bathyal": "0"}, scenario_sha256="0" * 64,
    )  # fmt: skip


def write(path: str, first: str, last: str) -> None:
    """What each of the two programs does."""
    base = bathyal.RunBase(path)
    for seed in range(int(first), int(last)):
        base.add(made(seed))


def two_writers(path: Path) -> float:
    begun = time.perf_counter()
    half = WRITTEN // 2
    writers = [
        subprocess.Popen([sys.executable, "-c", WRITER, str(path), str(at), str(at + half)])
        for at in (0, half)
    ]
    assert [writer.wait() for writer in writers] == [0, 0]
    seconds = time.perf_counter() - begun
    assert sorted(run.seed for run in bathyal.RunBase(path).list()) == list(range(WRITTEN))
    return seconds


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "runs.db"
        seconds = two_writers(path)
        print(f"| {WRITTEN:,} runs from two programs, none lost | {seconds:.1f} s |")
        write(str(path), str(WRITTEN), str(QUERIED))
        base = bathyal.RunBase(path)
        for text, holds in QUERIES:
            times = []
            for _ in range(ROUNDS):
                begun = time.perf_counter()
                rows = base.query(text)
                times.append(time.perf_counter() - begun)
            expected = {seed for seed in range(QUERIED) if holds(made(seed))}
            assert {run.seed for run in rows} == expected
            took = 1e3 * statistics.median(times)
            print(f"| `{text}`: {len(rows):,} of {QUERIED:,} | {took:.1f} ms |")


if __name__ == "__main__":
    main()
