# SPDX-License-Identifier: BSD-3-Clause
"""The whole plan on a million soundings, without reading: time of each stage and peak memory.

Each run is a process of its own, so that its peak of memory is its own. The plan is checked before
a time is printed: every target lies on the true bottom to within the survey's noise.
"""

import argparse
import json
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

RUNS = 5
GOAL_S, GOAL_MB = 2.0, 500.0
SURVEY = {"seed": 1, "length": 120.0, "beams": 510}
PLACES = [(0.1, 0.2), (0.3, 0.4), (0.45, 0.3), (0.6, 0.6), (0.8, 0.7), (0.9, 0.4)]


def peak_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def run(file: str) -> None:
    """One plan over the soundings of an .npy file; prints figures as JSON."""
    import bathyal

    points = np.load(file)
    low, high = points.min(axis=0), points.max(axis=0)
    places = low[:2] + np.array(PLACES) * (high - low)[:2]
    aims = np.column_stack(
        [places, np.full(len(places), high[2] + 3), np.tile([0.4, 0.0, -1.0], (len(places), 1))]
    )
    before = peak_mb()
    seconds, cpu = {}, {}
    cloud = bathyal.PointCloud(points)
    stages = {
        "clean": lambda: bathyal.clean_cloud(cloud).cloud,
        "triangulate": lambda: bathyal.triangulate(results["clean"]),
        "scene": lambda: bathyal.Scene(results["triangulate"]),
        "targets": lambda: bathyal.find_targets(results["scene"], aims),
        "path": lambda: bathyal.plan_toolpath(
            results["scene"], aims, step=0.1, standoff=0.1, normal_radius=0.3
        ),
    }
    results: dict = {}
    for name, stage in stages.items():
        begin, begin_cpu = time.perf_counter(), time.process_time()
        results[name] = stage()
        seconds[name] = time.perf_counter() - begin
        cpu[name] = time.process_time() - begin_cpu
    peak = peak_mb()
    target = results["targets"].point
    true = bathyal.survey_height(target[:, 0], target[:, 1], **SURVEY)
    print(
        json.dumps(
            {
                "seconds": seconds,
                "cpu": cpu,
                "peak_mb": peak,
                "above_input_mb": peak - before,
                "soundings": len(points),
                "triangles": len(results["triangulate"].triangles),
                "samples": len(results["path"].position),
                "worst_m": float(np.abs(target[:, 2] - true).max()),
            }
        )
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--child", help=argparse.SUPPRESS)
    child = parser.parse_args().child
    if child:
        run(child)
        return
    import bathyal

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "survey.npy"
        np.save(file, bathyal.generate_survey(**SURVEY).points)
        command = [sys.executable, __file__, "--child", str(file)]
        runs = [
            json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout)
            for _ in range(RUNS)
        ]
    worst = max(run["worst_m"] for run in runs)
    if not worst < 0.1:
        sys.exit(f"a target lies {worst:.3f} m off the true bottom")
    first = runs[0]
    median, cpu = (
        {name: statistics.median(run[kind][name] for run in runs) for name in first[kind]}
        for kind in ("seconds", "cpu")
    )
    total = statistics.median(sum(run["seconds"].values()) for run in runs)
    peak = max(run["peak_mb"] for run in runs)
    above = max(run["above_input_mb"] for run in runs)
    print(
        f"## Whole plan, {first['soundings']:,} soundings in memory\n\n"
        f"{first['triangles']:,} triangles, {first['samples']:,} samples of path; every "
        f"target within {worst * 100:.1f} cm of the true bottom. All threads, median of {RUNS} "
        "processes.\n"
    )
    print("| stage | seconds | seconds of processor, all threads together |\n|---|---|---|")
    for name, value in median.items():
        print(f"| {name} | {value:.3f} | {cpu[name]:.3f} |")
    print(f"| **all** (goal ≤ {GOAL_S:g} s) | **{total:.2f}** | {sum(cpu.values()):.2f} |\n")
    print(
        f"Peak memory of the process {peak:.0f} MB (goal ≤ {GOAL_MB:g} MB), of it {above:.0f} MB "
        "above Python and the soundings."
    )


if __name__ == "__main__":
    main()
