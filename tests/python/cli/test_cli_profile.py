# SPDX-License-Identifier: BSD-3-Clause
"""bathyal profile: what a cast holds, its picture and its table."""

from __future__ import annotations

import json

import bathyal
from tests.support.cast_files import WRITTEN
from tests.support.command import run


def test_says_what_a_cast_holds(write, capsys):
    code, out, _ = run(capsys, "profile", str(write(WRITTEN["castaway"], "cast.csv")))
    assert code == 0
    assert "CastAway 12A" in out
    assert "50.50000°, -3.25000°" in out
    assert "2020-02-03 04:05:06 UTC" in out
    assert "1497.7 to 1498 m/s" in out


def test_picture_table_and_json(write, capsys, tmp_path):
    file = write(WRITTEN["oceanscience"], "cast.asc")
    picture, table = tmp_path / "cast.png", tmp_path / "out.csv"
    code, out, err = run(
        capsys, "profile", str(file), "--plot", str(picture), "--out", str(table), "--json"
    )
    assert code == 0, err
    said = json.loads(out)
    assert said["rows"] == 2
    assert said["sound_speed_computed"]
    assert "extrapolates" in said["warnings"][0]
    assert picture.read_bytes()[:4] == b"\x89PNG"
    again = bathyal.read_profile(table)
    assert again.sound_speed.tolist() == said["ranges"]["sound_speed"]


def test_a_broken_cast_is_an_error(write, capsys):
    code, _, err = run(capsys, "profile", str(write("no cast at all", "cast.csv")))
    assert code == 1
    assert "cast.csv" in err
