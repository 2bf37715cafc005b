# SPDX-License-Identifier: BSD-3-Clause
"""Soundings from columns of text and ESRI grids."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support.cloud_cases import survey, write_text


def test_text_columns_found_by_name(tmp_path):
    text = "time,Northing [m],Easting [m],Elevation,TVU,note\n1,7e6,6e5,-51.5,0.3,4\n"
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.csv", text))
    assert cloud.points.tolist() == [[6e5, 7e6, -51.5]]
    attributes = {name: values.tolist() for name, values in cloud.attributes.items()}
    assert attributes == {"time": [1.0], "uncertainty": [0.3], "note": [4.0]}


def test_text_names_in_a_comment(tmp_path):
    text = "# crs EPSG:32602\n# vertical_datum: MSL\n# y x z intensity\n1 2 3 4\n5 6 7 8\n"
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.xyz", text))
    assert cloud.points.tolist() == [[2, 1, 3], [6, 5, 7]]
    assert cloud.attributes["intensity"].tolist() == [4, 8]
    assert (cloud.crs, cloud.vertical_datum) == ("EPSG:32602", "MSL")
    assert bathyal.read_cloud(tmp_path / "a.xyz", crs="EPSG:32603").crs == "EPSG:32603"


def test_text_names_that_come_twice_lose_nothing(tmp_path):
    path = write_text(tmp_path / "rgb.csv", "x,y,z,R,G,B,std\n1,2,3,4,5,6,7\n")
    assert sorted(bathyal.read_cloud(path).attributes) == ["blue", "green", "red", "std"]
    path = write_text(tmp_path / "a.csv", "x,y,z,x,a,a,\n1,2,3,4,5,6,7\n")
    cloud = bathyal.read_cloud(path)
    assert cloud.points.tolist() == [[1, 2, 3]]
    attributes = {name: values.tolist() for name, values in cloud.attributes.items()}
    assert attributes == {"column_3": [4], "a": [5], "column_5": [6], "column_6": [7]}
    for suffix in (".xyz", ".csv", ".ply"):
        with pytest.raises(ValueError, match="`attributes`: expected names other"):
            survey(1, attributes={"x": np.zeros(1)}).write(tmp_path / f"b{suffix}")


def test_text_without_names(tmp_path):
    title = "Survey north\n# made by hand\n1 2 3\n4 5 6\n"
    cloud = bathyal.read_cloud(write_text(tmp_path / "b.xyz", title))
    assert cloud.points.tolist() == [[1, 2, 3], [4, 5, 6]]
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.txt", "1;2;3;4\n5;6;7;8\n"))
    assert cloud.points.tolist() == [[1, 2, 3], [5, 6, 7]]
    assert cloud.attributes["column_3"].tolist() == [4, 8]


@pytest.mark.parametrize(
    "columns",
    [[2, 1, 0, 3], ["c", "b", "a", "d"], {"x": 2, "y": "b", "z": 0, "d": 3}],
)
def test_text_columns_said(tmp_path, columns):
    path = write_text(tmp_path / "a.csv", "a,b,c,d,e\n1,2,3,4,word\n")
    cloud = bathyal.read_cloud(path, columns=columns)
    assert cloud.points.tolist() == [[3, 2, 1]]
    assert {name: v.tolist() for name, v in cloud.attributes.items()} == {"d": [4]}


def test_text_options_reach_the_reader(tmp_path):
    path = write_text(tmp_path / "a.txt", "made by hand\n1,5;2,5;3,5\n")
    cloud = bathyal.read_cloud(path, skip_lines=1, decimal=",", separator=";")
    assert cloud.points.tolist() == [[1.5, 2.5, 3.5]]


def test_esri_grid(tmp_path):
    text = ("ncols 2\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\nnodata_value -1\n"
            "5 6\n-1 8\n")  # fmt: skip
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.asc", text), z="down", scale=2.0)
    assert cloud.points.tolist() == [[210, 430, -10], [230, 430, -12], [230, 410, -16]]


def test_depths_are_said_not_guessed(tmp_path):
    path = write_text(tmp_path / "a.csv", "x,y,Depth (m),tvu\n1,2,51.5,0.3\n")
    with pytest.raises(ValueError, match=r"`z`: expected .* calls it 'Depth \(m\)', got None"):
        bathyal.read_cloud(path)
    assert bathyal.read_cloud(path, z="down").points.tolist() == [[1, 2, -51.5]]
    assert bathyal.read_cloud(path, z="up").points.tolist() == [[1, 2, 51.5]]
    with pytest.raises(ValueError, match="`z`: expected"):
        bathyal.read_cloud(path, columns=["x", "y", "Depth (m)"])
    nameless = write_text(tmp_path / "b.csv", "1,2,51.5\n")
    assert bathyal.read_cloud(nameless).points[0, 2] == 51.5
    assert bathyal.read_cloud(nameless, z="down").points[0, 2] == -51.5


def test_units_are_said_not_guessed(tmp_path):
    path = write_text(tmp_path / "a.csv", "x [m],y [m],z [ft],uncertainty\n1,2,10,1\n")
    with pytest.raises(ValueError, match=r"`scale`: expected metres .* 'ft'"):
        bathyal.read_cloud(path)
    cloud = bathyal.read_cloud(path, scale=(1, 1, 0.3048))
    assert cloud.points.tolist() == [[1, 2, 3.048]]
    assert cloud.attributes["uncertainty"].tolist() == [0.3048]


def test_degrees_are_refused_with_the_reason(tmp_path):
    path = write_text(tmp_path / "a.csv", "lon,lat,z\n10.5,60.1,-5\n")
    with pytest.raises(bathyal.Error, match="longitude and latitude in degrees: project them"):
        bathyal.read_cloud(path)
    path = write_text(tmp_path / "b.csv", "lon,lat,x,y,z\n10.5,60.1,1,2,-5\n")
    assert bathyal.read_cloud(path).points.tolist() == [[1, 2, -5]]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("a,b,c\n1,2,3\n", "no column is called x or y or depth among a, b, c"),
        ("1 2\n3 4\n", "at least three columns, got 2"),
        ("x y z\n", "no row of numbers"),
        ("1 2 3\n4 5\n", r":2: expected 3 columns"),
        ("1 2 3\n4 five 6\n", ':2: expected a number in column 1, got "five"'),
        ("ncols 2\n1 2 3\n", "header lacks nrows"),
        ("\0\1\2\3", "text"),
    ],
)
def test_text_faults_are_errors(tmp_path, text, reason):
    path = write_text(tmp_path / "a.xyz", text)
    with pytest.raises(bathyal.Error, match=reason):
        bathyal.read_cloud(path)
