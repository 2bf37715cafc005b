# SPDX-License-Identifier: BSD-3-Clause
"""Cells of text in tables: nothing that a spreadsheet would run, and read back as it was."""

from __future__ import annotations

import csv

import numpy as np
import pytest

import bathyal
from bathyal import Touches
from bathyal.identify.simulate import write_touches
from bathyal.io.tables import read_table, write_table

FORMULA = ("=", "+", "-", "@", "\t", "\r")
NAMES = [
    "=cmd|' /C calc'!A0", "+1+1", "-2+3", "@SUM(1)", "\t=1", "'=1", "''+a", "#left", "'#left", "-5",
    "'-5", "a,b", 'say "x"', "left", "'quoted'", "µ; ä",
]  # fmt: skip


def cells(path):
    with path.open(encoding="utf-8", newline="") as stream:
        return [cell for row in csv.reader(stream) for cell in row]


def harmless(cell):
    """Numbers begin with a sign and are none the less no formulas."""
    try:
        return bool(float(cell)) or True
    except ValueError:
        return not cell.startswith(FORMULA)


def touches():
    label = np.repeat(np.arange(len(NAMES)), 2)
    q = np.linspace(-1, 1, 2 * len(label)).reshape(-1, 2)
    return Touches(q, label, names=dict(enumerate(NAMES)))


def test_names_of_points_come_back(tmp_path):
    path = tmp_path / "touches.csv"
    write_touches(touches(), path, comment="one\ntwo")
    assert all(map(harmless, cells(path)))
    back = bathyal.read_touches(path)
    assert [back.names[number] for number in range(len(NAMES))] == NAMES
    assert np.array_equal(back.point, touches().point)
    known = bathyal.read_touches(path, known_distances={("=cmd|' /C calc'!A0", "@SUM(1)"): 0.5})
    assert known.known_distances == {(0, 3): 0.5}


@pytest.mark.parametrize("name", ["a\nb", "a\r", "\rb", "a\u2028b"])
def test_names_of_several_lines_are_refused(tmp_path, name):
    data = Touches([[0.0], [1.0]], [0, 0], names={0: name})
    with pytest.raises(ValueError, match="`touches`: expected names of points of one line"):
        write_touches(data, tmp_path / "a.csv")


def test_tables_come_back(tmp_path):
    path = tmp_path / "a.csv"
    write_table(path, ["=name", "value"], [[name, -1.5] for name in NAMES], comments=["= a note"])
    assert path.read_text().startswith("# = a note\n'=name,value\n'=cmd|")
    table = read_table(path)
    assert table.titles == ["=name", "value"]
    assert table.text("=name") == NAMES
    assert table.numbers("value", {}, "").tolist() == [-1.5] * len(NAMES)


def test_reports_hold_no_formulas(tmp_path):
    from bathyal.identify.report.tables import write_parameters, write_residuals
    from bathyal.identify.simulate import simulate_touches

    made = simulate_touches(bathyal.arms.ur10e(), count=8)
    data = Touches(
        made.touches.q, made.touches.point, names={0: "=A1", 1: "@b", 2: "-c"},
        known_distances={(0, 1): made.apart},
    )  # fmt: skip
    fit = bathyal.identify_arm(bathyal.arms.ur10e(), data)
    write_residuals(fit, data, tmp_path / "residuals.csv")
    write_parameters(fit, tmp_path / "parameters.csv")
    for file in tmp_path.iterdir():
        assert all(map(harmless, cells(file))), file
    assert set(read_table(tmp_path / "residuals.csv").text("group")) == {"=A1", "@b", "-c"}


def test_names_of_attributes_are_no_formulas(tmp_path):
    path = tmp_path / "a.csv"
    names = ["=a", "+b", "-c", "@d", "e-f", "g+h"]
    cloud = bathyal.PointCloud([[1.0, 2, 3]], attributes={name: [-4.0] for name in names})
    bathyal.write_cloud(cloud, path)
    assert all(map(harmless, cells(path)))
    assert set(bathyal.read_cloud(path).attributes) == set(names)
