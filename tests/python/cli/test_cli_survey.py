# SPDX-License-Identifier: BSD-3-Clause
"""bathyal survey: a sonar flown over a world's file."""

from __future__ import annotations

import json

import numpy as np
import pytest

import bathyal
from tests.support.command import run

WORLD = """\
name: small
water: {surface: 0}
terrain:
  material: sand
  seabed: {size: [60, 60], spacing: 1.0, seed: 3, depth: 20}
"""
TRACK = "x,y,z\n-10,0,-10\n10,0,-10\n"


@pytest.fixture
def sea(tmp_path):
    (tmp_path / "world.yaml").write_text(WORLD)
    (tmp_path / "track.csv").write_text(TRACK)
    return [
        tmp_path / "world.yaml", "--track", tmp_path / "track.csv", "--speed", 10,
        "--out", tmp_path / "out", "--range", 30,
    ]  # fmt: skip


def test_writes_a_record_and_its_picture(sea, tmp_path, capsys) -> None:
    code, out, err = run(capsys, "survey", *sea, "--json", "--truth", "--navigation", "compass")
    assert code == 0, err
    said = json.loads(out)
    assert said["pings"] == 21
    names = ["survey.zarr", "survey.xtf", "survey.png"]
    assert said["files"] == [str(tmp_path / "out" / name) for name in names]
    record = bathyal.read_sonar(tmp_path / "out" / "survey.zarr")
    xtf = bathyal.read_sonar(tmp_path / "out" / "survey.xtf")
    assert xtf.intensity.shape == record.intensity.shape == (21, 2, 1500)
    assert np.allclose(record.truth.pose[:, :3, 3], [[x, 0, -10] for x in range(-10, 11)])
    off = np.linalg.norm(record.navigation.position[-1] - record.truth.pose[-1, :3, 3])
    assert 0.05 < off < 5.0


def test_a_survey_is_continued_and_another_is_refused(sea, tmp_path, capsys) -> None:
    sonar = bathyal.sonars.echo_sounder(physics="real").replace(range=30.0)
    world = bathyal.read_world(tmp_path / "world.yaml")
    track = bathyal.read_track(tmp_path / "track.csv", speed=10.0)
    folder = tmp_path / "out" / "survey.zarr"
    assert len(sonar.survey(world, track, out=folder, count=4)) == 4
    code, out, err = run(capsys, "survey", *sea, "--sonar", "echo_sounder", "--json")
    assert code == 0, err
    assert json.loads(out)["files"] == [str(folder)]
    assert len(bathyal.read_sonar(folder)) == 11
    code, _, err = run(capsys, "survey", *sea, "--sonar", "echo_sounder", "--seed", 4)
    assert code == 1
    assert "differs in survey.seed" in " ".join(err.split())
    code, _, err = run(
        capsys, "survey", *sea, "--sonar", "echo_sounder", "--seed", 4, "--overwrite"
    )
    assert code == 0, err


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--sonar", "radar"], "sonar"),
        (["--navigation", "stars"], "name"),
        (["--physics", "some"], "physics"),
        (["--range", "-3"], "range"),
    ],
)
def test_what_is_none_is_refused(sea, more, message: str, capsys) -> None:
    code, _, err = run(capsys, "survey", *sea, *more)
    assert code == 1
    assert f"`{message}`: expected" in err
