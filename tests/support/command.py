# SPDX-License-Identifier: BSD-3-Clause
"""The command line as the tests call it."""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys

import pytest

from bathyal import cli

FILES = ["path.csv", "path.json", "path.vtp", "plan.html", "plan.png", "seabed.vtp"]


def bathyal_run(*arguments: object, cwd: pathlib.Path | None = None) -> subprocess.CompletedProcess:
    """`bathyal …` in a process of its own."""
    program = "from bathyal.cli import app; app()"
    return subprocess.run(
        [sys.executable, "-c", program, *map(str, arguments)],
        capture_output=True, text=True, timeout=120, cwd=cwd, stdin=subprocess.DEVNULL,
        env={**os.environ, "COLUMNS": "100", "NO_COLOR": "1"},
    )  # fmt: skip


def run(capsys, *arguments: object) -> tuple[int, str, str]:
    """The same within this process: exit code, stdout, stderr."""
    capsys.readouterr()
    with pytest.raises(SystemExit) as left:
        cli.app([str(argument) for argument in arguments])
    out, err = capsys.readouterr()
    return left.value.code, out, err
