# SPDX-License-Identifier: BSD-3-Clause
"""The options of the command line: their help, their defaults, what they become inside."""

from __future__ import annotations

import numpy as np
import pytest
from typer.testing import CliRunner

import bathyal
from bathyal import cli
from bathyal.cli import values


def test_help_has_examples_and_defaults():
    for command in ("plan", "triangulate", "info", "soundings"):
        shown = CliRunner().invoke(cli.app, [command, "--help"], terminal_width=100)
        assert shown.exit_code == 0
        assert f"bathyal {command} " in shown.output
        assert "Exit codes" in shown.output
    shown = CliRunner().invoke(cli.app, ["plan", "--help"], terminal_width=120).output
    assert shown.count("default:") >= 12


def test_every_default_in_the_help_is_the_engines():
    speed = float(values.engine_default(bathyal.plan_toolpath, "speed"))
    flat = bathyal.Plane((0, 0, 1), -5.0)
    long = [[0, 0, 0, 0, 0, -1], [500, 0, 0, 0, 0, -1]]
    path = bathyal.plan_toolpath(flat, long)
    assert path.time[-1] == pytest.approx(500 / speed, rel=0.05)
    with pytest.raises(LookupError):
        values.engine_default(bathyal.plan_toolpath, "no_such_keyword")


def test_pose_turns_as_it_says():
    pose = values.pose_matrix((1.0, 2.0, -3.0, 0.0, 10.0, 90.0))
    nose = pose[:3, :3] @ [1, 0, 0]
    down = np.radians(10)
    np.testing.assert_allclose(nose, [0, np.cos(down), -np.sin(down)], atol=1e-12)
    np.testing.assert_allclose(pose[:3, 3], [1, 2, -3])
    port_up = values.pose_matrix((0, 0, 0, 10.0, 0, 0))[:3, :3] @ [0, 1, 0]
    assert port_up[2] > 0
    assert values.pose_matrix(None) is None


def test_columns_and_lengths():
    assert values.column_list("0, 1,2") == [0, 1, 2]
    assert values.column_list("easting,northing,depth") == ["easting", "northing", "depth"]
    assert values.length_or_none("none") == np.inf
    assert values.length_or_none("2.5") == 2.5
