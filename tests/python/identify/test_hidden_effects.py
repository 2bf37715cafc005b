# SPDX-License-Identifier: BSD-3-Clause
"""Effects hidden in simulated touches: bathyal touches example --hide, and what diagnose names."""

from __future__ import annotations

import json

import numpy as np
import pytest

import bathyal
from bathyal.identify.hidden import HIDEABLE
from bathyal.identify.simulate import simulate_touches, write_touches
from tests.support.command import run


def with_distance(made):
    """The touches with the known distance."""
    data = made.touches
    return bathyal.Touches(
        data.q, data.point, names=data.names, covariates=data.covariates,
        known_distances={(0, 1): made.apart},
    )  # fmt: skip


@pytest.mark.parametrize("seed", [0, 3])
@pytest.mark.parametrize(
    ("hide", "name", "joint"),
    [("joint_harmonic@3", "joint_harmonic", 2), ("joint_compliance", "joint_compliance", 1),
     ("base_shift", "base_shift", None)],
)  # fmt: skip
def test_diagnose_names_what_was_hidden_and_where(hide, name, joint, seed):
    made = simulate_touches(bathyal.arms.ur10e(), hide=hide, seed=seed)
    assert (made.hidden.name, made.hidden.joint) == (name, joint)
    report = bathyal.diagnose(bathyal.arms.ur10e(), with_distance(made))
    assert report.verdict == "named"
    assert (report.effects[0].name, report.effects[0].joint) == (name, joint)
    if name == "joint_harmonic":
        for key, value in made.hidden.parameters.items():
            low, high = report.effects[0].parameters[key].interval
            assert low - (high - low) < value < high + (high - low)


@pytest.mark.parametrize("name", HIDEABLE)
def test_every_effect_moves_the_tip_by_its_size(name):
    arm = bathyal.arms.ur10e()
    rigid = simulate_touches(arm, count=12, noise=0)
    made = simulate_touches(arm, count=12, noise=0, hide=name, hide_size=0.8e-3)
    assert made.hidden.size == 0.8e-3
    assert len(made.touches) == 36
    tip = made.true_arm.forward(made.touches.q)[:, :3, 3]
    off = tip - rigid.points[made.touches.point]
    # Reached with the effect; without it the same joint values miss by its size.
    assert np.sqrt(np.mean(np.sum(off**2, axis=1))) == pytest.approx(0.8e-3, rel=0.03)
    again = simulate_touches(arm, count=12, noise=0, hide=name, hide_size=0.8e-3)
    assert np.array_equal(again.touches.q, made.touches.q)


@pytest.mark.parametrize("name", ["base_shift", "drift", "thermal", "backlash"])
def test_covariates_come_back_from_the_table(name, tmp_path):
    made = simulate_touches(bathyal.arms.ur10e(), count=6, hide=name)
    write_touches(made.touches, tmp_path / "t.csv")
    read = bathyal.read_touches(tmp_path / "t.csv")
    assert read.names[int(read.point[1])] == "right"
    assert list(read.covariates) == list(made.touches.covariates) != []
    for key, values in made.touches.covariates.items():
        assert np.allclose(read.covariates[key], values)
    assert np.allclose(read.q, made.touches.q, atol=1e-6)


def test_touches_without_a_hidden_effect_are_as_before():
    made = simulate_touches(bathyal.arms.ur10e())
    assert made.hidden is None
    assert len(made.touches) == 63
    assert not made.touches.covariates


def test_what_was_hidden_is_printed_and_not_written(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, "touches", "example", "t.csv", "--hide", "joint_scale@2")
    assert code == 0, err
    assert "joint_scale of joint 2, 1 mm rms at the tip" in out
    assert "scale" not in (tmp_path / "t.csv").read_text()
    code, out, _ = run(
        capsys, "touches", "example", "t.csv", "--hide", "thermal", "--hide-size", "0.2mm", "--json"
    )
    told = json.loads(out)["hidden"]
    assert (told["name"], told["joint"], told["size_m"]) == ("thermal", None, 2e-4)
    assert list(told["parameters"]) == ["expansion"]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--hide", "eccentricity"], "`hide`: expected one of joint_harmonic, "),
        (["--hide", "joint_scale@"], "`hide`: expected one of"),
        (["--hide", "joint_scale@7"], "`hide`: expected a joint from 1 to 6, got 'joint_scale@7'"),
        (["--hide", "joint_scale@0"], "`hide`: expected a joint from 1 to 6"),
        (["--hide", "thermal@2"], "`hide`: expected thermal without a joint"),
        (["--hide", "joint_scale", "--hide-size", "0mm"], "`hide_size`: expected a length above 0"),
        (["--hide", "drift", "--hide-size", "3m"], "`drift`: expected a size that keeps all"),
        (["--hide-size", "1mm"], "`hide_size`: expected nothing without hide"),
    ],
)
def test_what_cannot_be_hidden_is_refused(arguments, says, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    code, _, err = run(capsys, "touches", "example", "t.csv", *arguments)
    assert code == 1, err
    assert says in err
    assert err.count("\n") == 1
    assert not (tmp_path / "t.csv").exists()


def test_help_names_every_effect_that_can_be_hidden(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "400")
    _, out, _ = run(capsys, "touches", "example", "--help")
    assert all(name in out for name in HIDEABLE)
