# SPDX-License-Identifier: BSD-3-Clause
"""Diagnosis asked amiss: arguments that make no sense, effects of the user's own that fail, runs
that are interrupted, files that cannot be written or read.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bathyal
from bathyal import Tracked
from bathyal.effects import Effect
from tests.support.command import run
from tests.support.diagnosis_record import ARM, NAN, N, P, Q, diagnosed, is_right, refuses

# Arguments ----------------------------------------------------------------------------------------

LIBRARY = bathyal.effects.list()
ARGUMENTS: dict[str, tuple[dict[str, Any], str]] = {
    "name": ({"effects": "drift"}, "`effects`: expected a list of effects, .* got str"),
    "names": ({"effects": ["drift"]}, "`effects`: expected a list of effects, .* got 'drift' in"),
    "alone": ({"effects": LIBRARY[0]}, "`effects`: expected a list of effects, .* got Effect"),
    "number": ({"effects": 5}, "`effects`: expected a list of effects, .* got int"),
    "hole": ({"effects": [None]}, "`effects`: expected a list of effects, .* got None in"),
    "twice": ({"effects": [*LIBRARY, LIBRARY[2]]}, "`effects`: expected each effect once, got joi"),
    "progress": ({"progress": "bar"}, "`progress`: expected a function"),
    "blocks": ({"blocks": 2}, "`blocks`: expected a number from 3 to 50"),
    "few groups": ({"groups": np.arange(N - 1)}, f"`groups`: expected {N} labels, .* got {N - 1}"),
    "one group": ({"groups": ["east"] * N}, '`groups`: expected two groups or more, got "east" in'),
    "no groups": ({"groups": []}, r"`groups`: expected whole .* got shape \(0,\)"),
    "table": ({"groups": np.zeros((N, 2), int)}, r"`groups`: expected .* got shape \(90, 2\)"),
    "word": ({"groups": "placement"}, "`groups`: expected whole numbers or text of shape"),
    "parts": ({"groups": np.linspace(0, 1, N)}, "`groups`: expected .* got 0.01.* in it"),
    "gaps": ({"groups": [None] * N}, "`groups`: expected whole numbers or text .* None in it"),
    "odds": ({"rival_odds": NAN}, "`rival_odds`: expected a number from 0 to 1, got nan"),
    "leftover": ({"leftover": -1}, "`leftover`: expected"),
    "poses": ({"num_next_poses": -1}, "`num_next_poses`: expected"),
    "fixed": ({"fixed": ["elbow"]}, "`fixed`: expected names of parameters"),
    "threads": ({"num_threads": -1}, "`num_threads`: expected"),
}


@pytest.mark.parametrize("case", ARGUMENTS)
def test_arguments_that_make_no_sense_are_refused(case: str) -> None:
    options, message = ARGUMENTS[case]
    refuses(lambda: diagnosed(options=options), message)


@pytest.mark.parametrize("arm", [None, "ur10", 3])
def test_only_an_arm_is_one(arm: Any) -> None:
    refuses(lambda: bathyal.diagnose(arm, Tracked(Q, P)), "`arm`: expected an Arm; of a corrected")


def test_a_corrected_arm_is_diagnosed_by_its_rigid_part() -> None:
    model = diagnosed().model
    refuses(lambda: bathyal.diagnose(model, Tracked(Q, P)), "rigid part, `.arm`, got CorrectedArm")
    is_right(bathyal.diagnose(model.arm, Tracked(Q, P)))


def test_without_effects_structure_has_no_name() -> None:
    report = diagnosed(options={"effects": []})
    assert (report.verdict, report.effects) == ("unknown", [])
    assert report.leftover.size > 1e-4


# Effects of the user's own ------------------------------------------------------------------------


def boom(data: Any, joint: int) -> Any:
    raise KeyError("depth")


def moody(data: Any, joint: int) -> Any:
    return np.random.default_rng().normal(size=len(data))


OWN: dict[str, tuple[Callable[..., Any], type[Exception], str]] = {
    "throws": (boom, bathyal.Error, "effect mine: its function raised KeyError: 'depth' .line"),
    "nan": (lambda d, j: np.full(len(d), NAN), ValueError, "finite numbers .* got nan in row 0"),
    "inf": (lambda d, j: np.full(len(d), np.inf), ValueError, "finite numbers .* got inf in row 0"),
    "huge": (lambda d, j: 1e300 * d.q[:, j], ValueError, r"finite numbers within 1e\+100, got "),
    "shape": (lambda d, j: np.ones(3), ValueError, r"of shape \(90, 1\), got shape \(3,\)"),
    "no_column": (lambda d, j: np.ones((90, 0)), ValueError, r"got shape \(90, 0\)"),
    "nothing": (lambda d, j: None, ValueError, "real numbers of shape"),
    "complex": (lambda d, j: 1j * d.q[:, j], ValueError, "got dtype complex128"),
    "arguments": (lambda d: d.q[:, 0], bathyal.Error, "its function raised TypeError"),
    "writes": (lambda d, j: d.q.sort(), bathyal.Error, "read-only"),
    "moody": (moody, ValueError, "the same numbers whenever it is asked, got others"),
}


def mine(function: Callable[..., Any], **more: Any) -> dict[str, Any]:
    options: dict[str, Any] = {"parameters": {"pull": "rad"}, "joints": "each", **more}
    return {"effects": [*LIBRARY, Effect("mine", function, **options)]}


@pytest.mark.parametrize("case", OWN)
def test_effects_that_fail_are_reported_by_their_name(case: str) -> None:
    function, kind, message = OWN[case]
    with pytest.raises(kind, match=message) as caught:
        diagnosed(options=mine(function))
    assert "effect mine" in str(caught.value)


def test_effects_that_do_nothing_or_too_much_change_nothing() -> None:
    for function in (lambda d, j: 0 * d.q[:, j], lambda d, j: 1e-300 * d.q[:, 0] ** 2):
        is_right(diagnosed(options=mine(function)))
    many = {f"a{i}": "rad" for i in range(200)}
    wide = np.random.default_rng(0).normal(size=(N, 200))
    report = diagnosed(options=mine(lambda d, j: wide, parameters=many))
    is_right(report)
    assert "mine was not tried with 200 numbers" in report.warnings[0]


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"joints": [9]}, "joints from 0 to 2, got 9"),
        ({"joints": [1, 1]}, "each joint once, got 1 twice"),
        ({"joints": []}, "`joints` where its site"),
        ({"scales": {"push": 1.0}}, '`scales`: expected names of parameters, got "push"'),
        ({"scales": {"pull": NAN}}, "above 0, got nan"),
        ({"parameters": {}}, "one parameter or more"),
    ],
)
def test_effects_that_are_defined_wrongly_are_refused(more: dict[str, Any], message: str) -> None:
    refuses(lambda: diagnosed(options=mine(lambda d, j: d.q[:, 0], **more)), message)


# Interruption -------------------------------------------------------------------------------------


@pytest.mark.parametrize("error", [KeyboardInterrupt, ZeroDivisionError, SystemExit])
@pytest.mark.parametrize("share", [0.0, 0.5])
def test_whatever_progress_raises_comes_back(error: type[BaseException], share: float) -> None:
    def stop(done: float, stage: str) -> None:
        if done >= share:
            raise error

    with pytest.raises(error):
        diagnosed(options={"progress": stop})
    is_right(diagnosed())  # and nothing is left behind


@pytest.fixture
def alarm() -> Any:
    """A true signal that comes while the engine works, as Ctrl-C does; set off by progress."""
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    calls: list[float] = []

    def progress(done: float, stage: str) -> None:
        if not calls:
            signal.setitimer(signal.ITIMER_REAL, 1e-3)
        calls.append(done)

    yield progress, calls
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    signal.signal(signal.SIGALRM, before)


def test_a_signal_stops_the_engine_before_its_stage_is_over(alarm: Any) -> None:
    progress, calls = alarm
    with pytest.raises(KeyboardInterrupt):
        diagnosed(options={"progress": progress})
    assert max(calls) < 0.5


def test_progress_is_asked_often_within_the_search_so_that_it_can_be_stopped() -> None:
    calls: list[tuple[float, str]] = []
    diagnosed(options={"progress": lambda done, stage: calls.append((done, stage))})
    assert calls == sorted(calls, key=lambda one: one[0])
    assert calls.count((0.2, "looking for causes")) > 5
    assert calls[-1] == (1.0, "done")


def test_an_interrupted_command_leaves_nothing(
    alarm: Any, tmp_path: Path, capsys: Any, monkeypatch: Any
) -> None:
    table = tmp_path / "tracked.csv"
    rows = (",".join(map(repr, row)) for row in np.c_[Q, P].tolist())
    table.write_text("\n".join(["q1_rad,q2_rad,q3_rad,x_m,y_m,z_m", *rows]))
    ARM.save(tmp_path / "arm.json")
    diagnose = bathyal.diagnose
    monkeypatch.setattr(
        "bathyal.diagnosis.job.diagnose",
        lambda arm, data, **_: diagnose(arm, data, progress=alarm[0]),
    )
    code, _, err = run(capsys, "diagnose", table, "--tracked", "--arm", tmp_path / "arm.json", "-o",
                       tmp_path / "out")  # fmt: skip
    assert (code, "interrupted" in err) == (130, True)
    assert sorted(os.listdir(tmp_path)) == ["arm.json", "tracked.csv"]


# Files --------------------------------------------------------------------------------------------


def test_a_report_is_not_written_over_a_folder(tmp_path: Path) -> None:
    report = diagnosed()
    for name in ("report.html", "report.json", "report.png"):
        (tmp_path / name).mkdir()
        with pytest.raises(OSError, match=name):
            report.write(tmp_path / name)
        with pytest.raises(OSError, match="none"):
            report.write(tmp_path / "none" / name)
    (tmp_path / "model.json").mkdir()
    with pytest.raises(OSError, match=r"model\.json"):
        report.model.save(tmp_path / "model.json")
    assert sorted(os.listdir(tmp_path)) == [
        "model.json",
        "report.html",
        "report.json",
        "report.png",
    ]


def test_any_cut_through_a_model_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "model.json"
    diagnosed().model.save(path)
    text = path.read_text()
    for share in np.linspace(0, 0.999, 25):
        path.write_text(text[: int(share * len(text.rstrip()))])
        with pytest.raises(bathyal.Error, match=r"model\.json"):
            bathyal.read_arm(path)


def test_hostile_model_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "model.json"
    diagnosed().model.save(path)
    text = path.read_text()
    hostile = [
        text.replace('"value": ', '"value": 1e999, "was": ', 1),
        text.replace('"value": ', '"value": [[]], "was": ', 1),
        text.replace('"order": ', '"order": "two", "was": ', 1),
        text.replace('"joint": 1', '"joint": 1e30'),
        text.replace('"joint": 1', '"joint": -5'),
        text.replace('"low": [', '"low": [[', 1),
        text.replace('"name": "joint_harmonic"', '"name": "__import__(\'os\')"'),
        text.replace('"name": "joint_harmonic"', '"name": {"$ref": "#"}'),
        "[" * 100_000,
        '{"format": "bathyal diagnosis"}',
        "\0" * 100,
        "\ufeff",
    ]
    for contents in hostile:
        assert contents != text
        path.write_text(contents)
        with pytest.raises(bathyal.Error, match=r"model\.json"):
            bathyal.read_arm(path)
