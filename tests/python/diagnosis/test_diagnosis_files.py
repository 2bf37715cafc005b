# SPDX-License-Identifier: BSD-3-Clause
"""The files of a diagnosis: JSON and tables."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest

from bathyal.diagnosis.files import contents, write_diagnosis, write_residuals
from tests.support import diagnosis_cases as cases

ALL = pytest.mark.parametrize("name", cases.CASES)


KEYS = [
    "ambiguous", "bathyal", "detectable_m", "effects", "format", "gain", "held_out", "joint_units",
    "leftover", "next", "next_poses", "noise_m", "noise_source", "poses", "residuals_after_m",
    "residuals_before_m", "schema", "shown", "summary", "verdict", "warnings",
]  # fmt: skip


@ALL
def test_json_keeps_its_names_and_goes_round(name, tmp_path):
    report = cases.CASES[name]()
    write_diagnosis(report, tmp_path / "r.json", settings={"tracked": True})
    kept = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))
    assert kept.pop("settings") == {"tracked": True}
    assert sorted(kept) == KEYS
    assert (kept["format"], kept["schema"]) == ("bathyal diagnosis", 1)
    assert json.loads(json.dumps(kept, allow_nan=False)) == kept
    assert np.shape(kept["residuals_before_m"]) == (len(report.data), 3)
    assert np.array_equal(kept["residuals_after_m"], report.residuals_after)
    assert sorted(contents(report)) == KEYS
    for effect, own in zip(kept["effects"], report.effects, strict=True):
        assert sorted(effect) == [
            "gain", "held_out_after_m", "held_out_before_m", "joint", "name",
            "nested_folds", "p_value", "parameters", "rivals", "rows", "size_m", "words",
        ]  # fmt: skip
        for number, estimate in own.parameters.items():
            kept_number = effect["parameters"][number]
            assert (kept_number["low"], kept_number["high"]) == estimate.interval
            assert sorted(kept_number) == ["high", "low", "std", "unit", "value"]


def test_json_holds_small_chances_and_no_nan(tmp_path):
    write_diagnosis(cases.named(), tmp_path / "r.json")
    kept = json.loads((tmp_path / "r.json").read_text(), parse_constant=pytest.fail)
    assert kept["effects"][0]["p_value"] == 1e-300
    write_diagnosis(cases.none(), tmp_path / "r.json")
    kept = json.loads((tmp_path / "r.json").read_text(), parse_constant=pytest.fail)
    assert kept["gain"] is None
    assert kept["held_out"]["before_m"] == [None] * 40


def test_residuals_as_a_table(tmp_path):
    report = cases.named()
    report.held_out.before = np.where(np.arange(240) == 7, np.nan, report.held_out.before)
    write_residuals(report, tmp_path / "r.csv")
    with open(tmp_path / "r.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 240
    assert rows[7]["held_out_before_m"] == ""
    assert float(rows[9]["held_out_before_m"]) == report.held_out.before[9]
    assert float(rows[9]["z_m"]) == report.residuals_after[9, 2]
    assert float(rows[9]["before_m"]) == pytest.approx(
        np.linalg.norm(report.residuals_before[9]), rel=1e-15
    )


def test_other_endings_are_refused_and_nothing_is_half_written(tmp_path):
    with pytest.raises(ValueError, match=r"`path`: expected a report file \(.html .json .png\)"):
        write_diagnosis(cases.named(), tmp_path / "r.pdf")
    (tmp_path / "r.html").write_text("old")
    broken = cases.named()
    broken.held_out = None
    with pytest.raises(AttributeError):
        write_diagnosis(broken, tmp_path / "r.html")
    assert (tmp_path / "r.html").read_text() == "old"
    assert [file.name for file in tmp_path.iterdir()] == ["r.html"]
