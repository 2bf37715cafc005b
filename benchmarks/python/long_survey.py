# SPDX-License-Identifier: BSD-3-Clause
"""A survey of 10,000 pings into a folder: ``python -m benchmarks.python.long_survey``.

A side-scan over a seabed of 204,800 triangles. Each survey runs in a process of its own, whose
largest memory is measured: one of a tenth, the whole in one process, and the whole by two processes
that fill one folder at the same time; the folders are compared byte by byte.
"""

import argparse
import hashlib
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import bathyal


def hear(out, first, count, pings):
    """The pings `first` to `first + count` of `pings`."""
    world = bathyal.World()
    bottom = bathyal.make_seabed((320.0, 320.0), 1.0, seed=1)
    world.add(bottom, material="sand")
    pose = np.stack([np.eye(4)] * 2)
    pose[:, 2, 3] = float(bottom.vertices[:, 2].max()) + 10.0
    pose[:, 0, 3] = -150.0, 150.0
    sonar = bathyal.sonars.side_scan(physics="real").replace(multiples=0, ping_rate=10.0)
    track = bathyal.Trajectory([0.0, (pings - 1) / 10.0], pose)
    start = time.perf_counter()
    sonar.survey(world, track, out=out, first=first, count=count)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{time.perf_counter() - start} {peak}")


def started(out, first, count, pings):
    command = [sys.executable, "-m", __spec__.name, "--part", str(out), str(first), str(count)]
    return subprocess.Popen([*command, "--pings", str(pings)], stdout=subprocess.PIPE, text=True)


def figures(processes):
    """Longest time [s] and largest memory [MB] of processes that run at the same time."""
    outs = [process.communicate()[0] for process in processes]
    if any(process.returncode for process in processes):
        raise SystemExit("a survey failed")
    rows = np.array([[float(word) for word in out.split()[-2:]] for out in outs])
    return rows.max(axis=0)


def digest(folder):
    files = sorted(path for path in Path(folder).rglob("*") if path.is_file())
    whole = hashlib.sha256()
    for path in files:
        whole.update(str(path.relative_to(folder)).encode() + path.read_bytes())
    return whole.hexdigest(), sum(path.stat().st_size for path in files)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pings", type=int, default=10_000)
    parser.add_argument("--part", nargs=3, help="of one process: folder, first ping, count")
    arguments = parser.parse_args()
    pings = arguments.pings
    if arguments.part:
        out, first, count = arguments.part
        hear(out, int(first), int(count), pings)
        return
    with tempfile.TemporaryDirectory() as scratch:
        folders = {name: Path(scratch) / name / "survey.zarr" for name in ("tenth", "one", "two")}
        rows = {
            f"{pings // 10:,} pings": figures([started(folders["tenth"], 0, pings // 10, pings)]),
            f"{pings:,} pings": figures([started(folders["one"], 0, pings, pings)]),
            f"{pings:,} pings by two processes": figures([
                started(folders["two"], 0, pings // 2, pings),
                started(folders["two"], pings // 2, pings - pings // 2, pings),
            ]),
        }  # fmt: skip
        one, two = digest(folders["one"]), digest(folders["two"])
    print("## A long survey into a folder\n")
    print("| survey | time [s] | largest memory of a process [MB] |\n|---|---|---|")
    for name, (seconds, memory) in rows.items():
        print(f"| {name} | {seconds:.0f} | {memory:.0f} |")
    same = "the same bytes" if one[0] == two[0] else "OTHER BYTES"
    print(f"\n{one[1] / 1e6:.0f} MB; one process and two: {same}.")


if __name__ == "__main__":
    main()
