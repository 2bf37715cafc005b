# SPDX-License-Identifier: BSD-3-Clause
"""Reading a text of soundings: bathyal against pandas' C engine and pyarrow, in the same run.

    .venv/bin/python -m benchmarks.python.read_text [--rows 1000000] [--rounds 15]

The peers are installed when they are missing. Every reader must give the same numbers to the last
bit, by the very call that is timed, before any time is taken. All get the same file from the page
cache, all its columns, as float64; pandas.read_csv is given the separator, that there is no header,
and its C engine, and rounds as it does by default, which pandas 3 does correctly. Rounds are
interleaved, a ratio is taken within each round, and the medians are in the table, wall time
first; the ratios of processor time on one thread behind them stay the same while others use the
machine. The peers are timed to their own kind of table, bathyal to the (N, 3) array in C order that
the rest of it works on; `read_cloud` is the public call, with its look at names and notes and the
point cloud it makes, on all threads.
"""

from __future__ import annotations

import argparse
import datetime
import importlib.util
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from bathyal import PointCloud, _core, generate_survey, read_cloud

PEERS = {"pandas": "pandas>=3", "pyarrow": "pyarrow>=16"}


def install_peers() -> None:
    missing = [spec for name, spec in PEERS.items() if importlib.util.find_spec(name) is None]
    if missing:
        subprocess.run([sys.executable, "-m", "pip", "install", "-q", *missing], check=True)


def soundings(rows: int) -> np.ndarray:
    """At least `rows` soundings of a generated survey, in the order they were taken."""
    lines = 1 + rows // 100_000
    points = generate_survey(seed=1, lines=lines, width=20.0 * lines, lost_width=0.0).points
    return points[:rows]


def readers(path: Path, separator: str) -> dict[str, Callable[[], object]]:
    import pandas
    from pyarrow import csv

    def arrow(threads: bool) -> object:
        return csv.read_csv(
            path,
            read_options=csv.ReadOptions(column_names=["x", "y", "z"], use_threads=threads),
            parse_options=csv.ParseOptions(delimiter=separator),
        )

    return {
        "bathyal 1": lambda: _core.read_text_table(path, num_threads=1),
        "bathyal 2": lambda: _core.read_text_table(path, num_threads=2),
        "read_cloud": lambda: read_cloud(path, separator=separator),
        "pandas": lambda: pandas.read_csv(path, sep=separator, header=None, engine="c"),
        "pyarrow 1": lambda: arrow(False),
        "pyarrow 2": lambda: arrow(True),
    }


def check_same(path: Path, separator: str, points: np.ndarray | None) -> None:
    """The same bits from all."""
    read = readers(path, separator)
    expected = np.ascontiguousarray(read["pandas"]().to_numpy())
    if points is not None:
        np.testing.assert_array_equal(expected.view(np.uint64), points.view(np.uint64))
    for name in ("bathyal 1", "bathyal 2"):
        np.testing.assert_array_equal(read[name]().table.view(np.uint64), expected.view(np.uint64))
    cloud = read["read_cloud"]().points
    np.testing.assert_array_equal(cloud.view(np.uint64), expected.view(np.uint64))
    for name in ("pyarrow 1", "pyarrow 2"):
        table = np.column_stack([column.to_numpy() for column in read[name]().columns])
        np.testing.assert_array_equal(table.view(np.uint64), expected.view(np.uint64))


Times = dict[str, list[float]]


def measure(path: Path, separator: str, rounds: int) -> tuple[Times, Times]:
    """Seconds of the wall clock and of the processor, round by round."""
    read = readers(path, separator)
    wall: Times = {name: [] for name in read}
    processor: Times = {name: [] for name in read}
    for _ in range(rounds):
        for name, call in read.items():
            start, start_processor = time.perf_counter(), time.process_time()
            result = call()
            wall[name].append(time.perf_counter() - start)
            processor[name].append(time.process_time() - start_processor)
            del result
    return wall, processor


def ratio(times: Times, peer: str, ours: str) -> float:
    return statistics.median(a / b for a, b in zip(times[peer], times[ours], strict=True))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=15)
    arguments = parser.parse_args()
    install_peers()
    import pandas
    import pyarrow

    pyarrow.set_cpu_count(2)
    points = soundings(arguments.rows)
    cases = [
        ("millimetres, comma", ",", 3),
        ("millimetres, blank", " ", 3),
        ("all digits, comma", ",", -1),
    ]
    print(
        "## Reading text\n\n"
        f"{len(points)} rows of x y z, {platform.machine()}, {os.cpu_count()} processors, "
        f"Python {platform.python_version()}, numpy {np.__version__}, pandas {pandas.__version__}, "
        f"pyarrow {pyarrow.__version__}, {datetime.date.today()}, "
        f"median of {arguments.rounds} rounds\n"
    )
    print(
        "| file | MB | pandas / ours, 1 thread | pyarrow / ours, 1 | pandas / ours, 2 "
        "| pyarrow / ours, 2 | pandas / `read_cloud` | processor: pandas, pyarrow / ours "
        "| ours 1, 2 [ms] | ours 1, 2 [MB/s] | `read_cloud` [ms] | pandas [ms] "
        "| pyarrow 1, 2 [ms] |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, separator, decimals in cases:
            path = Path(folder) / "survey.csv"
            _core.write_xyz(path, PointCloud(points), separator=separator, decimals=decimals)
            check_same(path, separator, points if decimals < 0 else None)
            times, processor = measure(path, separator, arguments.rounds)
            ms = {key: 1e3 * statistics.median(values) for key, values in times.items()}
            megabytes = path.stat().st_size / 1e6
            print(
                f"| {name} | {megabytes:.0f} "
                f"| **{ratio(times, 'pandas', 'bathyal 1'):.2f}** "
                f"| **{ratio(times, 'pyarrow 1', 'bathyal 1'):.2f}** "
                f"| **{ratio(times, 'pandas', 'bathyal 2'):.2f}** "
                f"| **{ratio(times, 'pyarrow 2', 'bathyal 2'):.2f}** "
                f"| **{ratio(times, 'pandas', 'read_cloud'):.2f}** "
                f"| {ratio(processor, 'pandas', 'bathyal 1'):.2f}, "
                f"{ratio(processor, 'pyarrow 1', 'bathyal 1'):.2f} "
                f"| {ms['bathyal 1']:.0f}, {ms['bathyal 2']:.0f} "
                f"| {1e3 * megabytes / ms['bathyal 1']:.0f}, "
                f"{1e3 * megabytes / ms['bathyal 2']:.0f} "
                f"| {ms['read_cloud']:.0f} | {ms['pandas']:.0f} "
                f"| {ms['pyarrow 1']:.0f}, {ms['pyarrow 2']:.0f} |"
            )


if __name__ == "__main__":
    main()
