# SPDX-License-Identifier: BSD-3-Clause
"""Tool paths as files: the three formats agree, number for number."""

from __future__ import annotations

import csv
import json
import os
import pathlib

import numpy as np
import pytest

import bathyal
from bathyal.io.formats.vtp.reader import read_vtp
from bathyal.io.json import json_text
from bathyal.toolpath.paths import path_columns, write_path
from tests.support import scenes


@pytest.fixture(scope="module")
def path():
    return scenes.planned(offset=scenes.UTM, standoff=0.1)[2]


def read_csv(file: pathlib.Path) -> tuple[list[str], dict[str, np.ndarray]]:
    lines = file.read_text().splitlines()
    notes = [line for line in lines if line.startswith("#")]
    header, *rows = csv.reader(lines[len(notes) :])
    table = np.array(rows, float)
    return notes, {name: table[:, k] for k, name in enumerate(header)}


def test_csv_keeps_every_bit(path, tmp_path):
    write_path(path, tmp_path / "path.csv")
    _, columns = read_csv(tmp_path / "path.csv")
    for k, axis in enumerate("xyz"):
        np.testing.assert_array_equal(columns[f"position_{axis}_m"], path.position[:, k])
        np.testing.assert_array_equal(columns[f"approach_{axis}"], path.approach[:, k])
    for k, part in enumerate("xyzw"):
        np.testing.assert_array_equal(columns[f"quaternion_{part}"], path.quaternion[:, k])
    np.testing.assert_array_equal(columns["time_s"], path.time)
    np.testing.assert_array_equal(columns["gap"], path.gap)
    assert path.gap.any()


def test_csv_reads_with_numpy(path, tmp_path):
    write_path(path, tmp_path / "path.csv")
    table = np.genfromtxt(tmp_path / "path.csv", delimiter=",", names=True, skip_header=1)
    np.testing.assert_array_equal(table["arc_length_m"], path.arc_length)


def test_formats_agree(path, tmp_path):
    for suffix in ("csv", "json", "vtp"):
        path.write(tmp_path / f"path.{suffix}")
    _, rows = read_csv(tmp_path / "path.csv")
    columns = json.loads((tmp_path / "path.json").read_text())["path"]
    assert list(rows) == list(columns)
    for name, values in rows.items():
        content = np.array(columns[name], float)  # null is NaN
        np.testing.assert_array_equal(content, values, err_msg=name)
    vtp = read_vtp(tmp_path / "path.vtp")
    np.testing.assert_array_equal(vtp.points, path.position)
    for name in ("approach", "travel", "side", "quaternion", "segment", "time", "surface"):
        np.testing.assert_array_equal(vtp.point_data[name], getattr(path, name), err_msg=name)
    np.testing.assert_array_equal(vtp.point_data["gap"], path.gap)


def test_vtp_lines_stop_at_gaps(path, tmp_path):
    path.write(tmp_path / "path.vtp")
    lines = read_vtp(tmp_path / "path.vtp").lines.lists()
    assert len(lines) == path.gap.sum() + 1
    assert np.concatenate(lines).tolist() == list(range(len(path)))
    assert [line[-1] for line in lines[:-1]] == np.flatnonzero(path.gap).tolist()


def test_json_tells_targets_and_provenance(path, tmp_path):
    write_path(path, tmp_path / "p.json", crs="EPSG:32602", provenance={"input": {"file": "a.xyz"}})
    content = json.loads((tmp_path / "p.json").read_text())
    assert content["crs"] == "EPSG:32602"
    assert content["provenance"]["input"]["file"] == "a.xyz"
    assert content["targets"]["status"] == path.targets.status.tolist()
    assert content["targets"]["point_x_m"][3] is None  # the aim that met nothing
    assert content["warnings"] == path.warnings
    assert content["warnings"]


def test_datum_rides_along(path, tmp_path):
    wkt = 'PROJCS["WGS 84 / UTM zone 2N",\n  GEOGCS["WGS 84"]]'
    for suffix in ("csv", "vtp"):
        write_path(path, tmp_path / f"p.{suffix}", crs=wkt, vertical_datum="MLLW")
    notes, _ = read_csv(tmp_path / "p.csv")
    assert notes[1:] == [f"# crs {' '.join(wkt.split())}", "# vertical_datum MLLW"]
    fields = read_vtp(tmp_path / "p.vtp").field_data
    assert fields["vertical_datum"].item() == "MLLW"
    assert fields["crs"].item() == wkt


def test_path_of_one_sample(tmp_path):
    path = bathyal.plan_toolpath(bathyal.Plane((0, 0, 1), -5.0), [[0, 0, 0, 0, 0, -1]])
    for suffix in ("csv", "json", "vtp"):
        path.write(tmp_path / f"one.{suffix}")
    vtp = read_vtp(tmp_path / "one.vtp")
    assert len(vtp.points) == 1
    assert len(vtp.vertices) == 1


def test_numbers_that_are_not_finite_are_null():
    text = json_text({"a": np.array([1.5, np.nan, np.inf]), "b": {"c": np.float64(-np.inf)}})
    assert json.loads(text) == {"a": [1.5, None, None], "b": {"c": None}}


def test_every_column_says_its_unit(path):
    names = list(path_columns(path))
    assert names[:3] == ["position_x_m", "position_y_m", "position_z_m"]
    for name in ("time_s", "arc_length_m", "normal_std_rad", "surface_z_m"):
        assert name in names


def test_other_suffix_is_refused(path, tmp_path):
    with pytest.raises(ValueError, match=r"filename.*\.vtp"):
        write_path(path, tmp_path / "path.txt")


def test_missing_folder_is_reported_by_name(path, tmp_path):
    with pytest.raises(OSError, match="nowhere"):
        write_path(path, tmp_path / "nowhere" / "path.csv")


def test_interrupted_writing_leaves_the_old_file(path, tmp_path):
    file = tmp_path / "path.csv"
    file.write_text("old")

    class Interrupted:
        targets, warnings = path.targets, []

        def __getattr__(self, name):
            if name == "triangle":  # the last column
                raise KeyboardInterrupt
            return getattr(path, name)

    for suffix in ("csv", "json"):
        with pytest.raises(KeyboardInterrupt):
            write_path(Interrupted(), tmp_path / f"path.{suffix}")
    assert file.read_text() == "old"
    assert os.listdir(tmp_path) == ["path.csv"]
