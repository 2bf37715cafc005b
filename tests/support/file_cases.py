# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of files share: measured data, and processes that watch their memory."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

MEASURED = Path(__file__).resolve().parents[2].parent / "shared" / "data"


def measured(name: str) -> Path:
    """A file of the measured data next to the project; the test is skipped where it is absent."""
    path = MEASURED / name
    if not path.exists():
        pytest.skip(f"measured data are not at {path}")
    return path


def refusal_and_memory(call: str, path: Path) -> tuple[str, int]:
    """Run `bathyal.<call>(path)` in a process of its own.

    Returns the name of the exception it raised ("" when it raised none) and how many bytes its
    largest memory in use grew by.
    """
    if not Path("/proc/self/status").exists():
        pytest.skip("no /proc to read the largest memory from")
    script = f"""
import re, sys, bathyal, numpy
def peak():  # not ru_maxrss, which starts at what the parent had
    return 1024 * int(re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read())[1])
numpy.fromstring("1 2", sep=" ")
before = peak()
try:
    bathyal.{call}(sys.argv[1]); name = ""
except (bathyal.Error, ValueError) as error:
    name = type(error).__name__
print(name, peak() - before, sep=",")
"""
    done = subprocess.run(
        [sys.executable, "-c", script, str(path)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    name, grown = done.stdout.strip().splitlines()[-1].split(",")
    return name, int(grown)
