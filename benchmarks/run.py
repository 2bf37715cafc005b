# SPDX-License-Identifier: BSD-3-Clause
"""Runs every benchmark and writes benchmarks/README.md: machine, versions, date, tables.

Each benchmark is a program that compares its result with the peers' before it prints a time, and
prints one section of Markdown. One that fails ends the run with its status, and the page is left as
it was.
"""

import argparse
import datetime
import importlib.metadata
import os
import platform
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAGE = HERE / "README.md"
PYTHON = [
    "rays",
    "instances",
    "segments",
    "section",
    "inside",
    "workspace",
    "contact",
    "plan",
    "reach_map",
]
PYTHON += ["sonar_pings", "long_survey"]
PYTHON += ["uvms_trim", "uvms_dynamics", "navigation", "vehicle_step", "mission_speed", "watchers"]
PYTHON += ["read_text", "whole_plan", "identify"]
PYTHON += ["intervals", "diagnose_speed", "diagnose_real", "score_card"]
CPP = ["bench_delaunay", "bench_greedy", "bench_arm_forward", "bench_arm_inverse"]
CPP += ["bench_body_tree", "bench_gram"]
PACKAGES = ["numpy", "scipy", "coal", "open3d-cpu", "embreex", "vtk", "pandas", "pyarrow", "pin"]
PACKAGES += ["mujoco"]
DEBIAN = [
    "g++",
    "libcgal-dev",
    "libpcl-dev",
    "libeigen3-dev",
    "liborocos-kdl-dev",
    "libnlopt-cxx-dev",
]


def machine() -> str:
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    cpu = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    return f"{cpu}, {os.cpu_count()} cores, {platform.system()} {platform.machine()}"


def versions() -> str:
    names = [f"{name} {importlib.metadata.version(name)}" for name in PACKAGES]
    for name in DEBIAN:
        query = ["dpkg-query", "-W", "-f=${Version}", name]
        version = subprocess.run(query, capture_output=True, text=True, check=True).stdout
        names.append(f"{name} {version}")
    return ", ".join([f"Python {platform.python_version()}", *names])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--cpp", type=Path, required=True, help="folder of the built C++ benchmarks"
    )
    folder: Path = parser.parse_args().cpp.resolve()
    sections = [
        "# Benchmarks\n\n"
        "Made by `make bench`. Peers run in the same process or the same interleaved run, results "
        "are compared before any time is printed, figures are medians, and ratios come first: the "
        "machine is shared and noisy, so a ratio says more than a second.\n\n"
        f"- machine: {machine()}\n- versions: {versions()}\n"
        f"- date: {datetime.datetime.now(tz=datetime.timezone.utc):%Y-%m-%d}\n"
    ]
    commands = [[str(folder / name)] for name in CPP]
    commands += [[sys.executable, "-m", f"benchmarks.python.{name}"] for name in PYTHON]
    for command in commands:
        print("running", " ".join(command), flush=True)
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, cwd=HERE.parent)
        if done.returncode != 0:
            sys.exit(f"{command[-1]} failed with status {done.returncode}")
        print(done.stdout, flush=True)
        sections.append(done.stdout.strip() + "\n")
    PAGE.write_text("\n".join(sections), encoding="utf-8")
    print(f"The table is {PAGE}.")


if __name__ == "__main__":
    main()
