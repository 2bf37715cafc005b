# SPDX-License-Identifier: BSD-3-Clause
"""Commands in the README and the tutorials run as written and print what is quoted there."""

from __future__ import annotations

import pathlib
import re
import shlex

import pytest

from tests.support.command import run

ROOT = pathlib.Path(__file__).parents[3]


def console(path):
    """(command, quoted output) of each command of bathyal in a page, in order."""
    found = []
    for block in re.findall(r"```console\n(.*?)```", (ROOT / path).read_text("utf-8"), re.DOTALL):
        for line in block.splitlines():
            if line.startswith("$ "):
                found.append((shlex.split(line[2:], comments=True), []))
            else:
                found[-1][1].append(line.rstrip())
    return [pair for pair in found if pathlib.Path(pair[0][0]).name == "bathyal"]


RUN = ("touches", "identify", "diagnose", "scenario", "check", "reach", "sample")


@pytest.mark.parametrize(
    "page",
    ["README.md", "docs/tutorial_know_your_arm.md", "docs/tutorial_take_a_sample.md"],
)
def test_commands_print_what_is_quoted(page, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    commands = [pair for pair in console(page) if pair[0][1] in RUN]
    assert any(quoted for _, quoted in commands)
    for command, quoted in commands:
        code, out, err = run(capsys, *command[1:])
        assert code == 0, err
        if quoted:
            assert [line.rstrip() for line in out.splitlines()] == quoted


def test_the_readme_names_an_effect_that_was_hidden():
    commands = console("README.md")
    hidden = next(command for command, _ in commands if "--hide" in command)
    output = next(quoted for command, quoted in commands if command[1] == "diagnose")
    assert "joint_harmonic@3" in hidden
    assert output[0].startswith("Named: a wave of order 1")
    assert "along joint 3" in output[0]
