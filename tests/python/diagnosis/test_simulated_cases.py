# SPDX-License-Identifier: BSD-3-Clause
"""The generator of sealed effects is what it says: independent, of the sizes asked for, fair."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

import bathyal
from tests.simulated_cases.arm_draws import draw_arm
from tests.simulated_cases.cases import KINDS, Answer, draw_case, make_case, read_case, write_case
from tests.simulated_cases.effect_shapes import (
    Action,
    base_columns,
    basis,
    cantilever,
    column,
    columns,
    moved,
    project_out,
    torque,
)
from tests.simulated_cases.evaluation import evaluate
from tests.simulated_cases.oracle_report import OracleEffect, OracleReport, oracle
from tests.simulated_cases.score_card import card, run

INSIDE = [s for s in range(60) if KINDS[s % 20] == "inside"]


@pytest.mark.parametrize("seed", range(12))
def test_frames_are_those_of_the_arm_that_is_handed_over(seed):
    random = np.random.default_rng(seed)
    made = draw_arm(random)
    q = random.uniform(made.lower, made.upper, (20, made.size))
    arm = made.arm()
    arm.tool = made.tool
    frames, poses = made.walk(q), arm.forward(q)
    np.testing.assert_allclose(frames.tip, poses[:, :3, 3], atol=1e-13)
    np.testing.assert_allclose(frames.tool, poses[:, :3, :3], atol=1e-13)


def test_arms_are_of_all_kinds():
    made = [draw_arm(np.random.default_rng(seed)) for seed in range(120)]
    assert {arm.size for arm in made} == {3, 4, 5, 6, 7}
    for kind in ("urdf", "weighed"):
        assert {getattr(arm, kind) for arm in made} == {True, False}
    assert any(arm.sliding.any() for arm in made)


def test_a_seed_makes_the_same_case_again():
    for seed in (0, 6, 13):
        (arm, data, answer), (again, same, repeated) = make_case(seed), make_case(seed)
        assert answer == repeated
        np.testing.assert_array_equal(data.q, same.q)
        q = data.q[:3]
        np.testing.assert_array_equal(arm.forward(q), again.forward(q))
        if isinstance(data, bathyal.Tracked):
            np.testing.assert_array_equal(data.position, same.position)


@pytest.mark.parametrize("seed", [0, 1, 9, 11, 13])
def test_a_written_case_keeps_the_answer_apart(tmp_path, seed):
    write_case(tmp_path, seed)
    arm, data = read_case(tmp_path)
    made, same, answer = make_case(seed)
    np.testing.assert_array_equal(data.q, same.q)
    np.testing.assert_allclose(arm.forward(data.q), made.forward(data.q), atol=1e-13)
    assert data.covariates.keys() == same.covariates.keys()
    for name, values in same.covariates.items():
        np.testing.assert_array_equal(data.covariates[name], values)
    assert Answer(**json.loads((tmp_path / "answer.json").read_text())) == answer
    seen = set(np.load(tmp_path / "case.npz").files)
    assert not [n for n in seen if not n.startswith(("arm_", "covariate_"))
                and n not in ("q", "position", "pose", "point", "distances")]  # fmt: skip


@pytest.mark.parametrize("seed", INSIDE)
def test_effects_have_the_sizes_that_the_answer_tells(seed):
    case = draw_case(seed)
    poses, noise = case.sealed.poses, case.answer.noise
    facts = [f for f in case.answer.effects if f["name"] in {s.name for s in case.sealed.shapes}]
    for i, (shape, fact) in enumerate(zip(case.sealed.shapes, facts, strict=True)):
        assert shape.name == fact["name"]
        others = [columns(poses, s) for k, s in enumerate(case.sealed.shapes) if k != i]
        values = np.array(list(fact["parameters"].values()))
        left = columns(poses, shape) @ values
        left -= _fitted(np.hstack([base_columns(poses), *others]), left)
        assert np.sqrt(np.mean(left**2)) / noise == pytest.approx(fact["size"], rel=1e-4)


def _fitted(matrix, seen):
    """By another way than the generator's: normal equations of least norm."""
    size = np.linalg.norm(matrix, axis=0)
    matrix = matrix[:, size > 0] / size[size > 0]
    return matrix @ np.linalg.lstsq(matrix, seen, rcond=1e-10)[0]


@pytest.mark.parametrize("seed", [12, 13, 17, 19, 32, 34, 37])
def test_what_was_measured_is_noise_around_the_truth(seed):
    """The measurement, which is not linear, less all that the answer tells of it."""
    case = draw_case(seed)
    sealed, noise = case.sealed, case.answer.noise
    moves = sealed.poses.arm.walk(sealed.q).tip @ case.scene.base[:3, :3].T
    off = sealed.pose[:, :3, 3] - case.scene.base[:3, 3] - moves
    facts = {f["name"]: f for f in case.answer.effects}
    seen = off @ case.scene.base[:3, :3]
    poses = replace(sealed.poses, pose=False)
    for shape in sealed.shapes:
        values = list(facts[shape.name]["parameters"].values())
        for actions, value in zip(shape.actions.values(), values, strict=True):
            seen = seen - value * sum(moved(poses, a) for a in actions)
    rows = np.setdiff1d(np.arange(len(seen)), facts.get("outliers", {}).get("rows", []))
    left = project_out(basis(base_columns(poses)), column(poses, seen)).reshape(-1, 3)[rows]
    assert np.sqrt(np.mean(left**2)) / noise == pytest.approx(0.95, abs=0.12)


def test_torques_are_slopes_of_potential_energy():
    case = _weighed_case()
    poses = case.sealed.poses
    arm, step = poses.arm, 1e-6

    def energy(q):
        frames = arm.walk(q)
        total = 0.0
        for k in range(arm.size + 1):
            place = frames.origin[k] + frames.rotation[k] @ arm.centers[k]
            total = total + arm.masses[k] * 9.80665 * place[:, 2]
        return total + poses.covariates.get("payload", 0.0) * 9.80665 * frames.tip[:, 2]

    bare = {k: v for k, v in poses.covariates.items() if k != "gravity"}
    poses = replace(poses, covariates=bare)
    for j in range(arm.size):
        up, down = poses.q.copy(), poses.q.copy()
        up[:, j] += step
        down[:, j] -= step
        slope = (energy(up) - energy(down)) / (2 * step)
        np.testing.assert_allclose(torque(poses, j), -slope, atol=1e-6)


def test_a_beam_bends_as_the_sum_of_many_short_ones():
    """Integrates curvature along the link in place of the formula."""
    case = _weighed_case()
    poses = case.sealed.poses
    row = int(np.argmax(np.hypot(poses.arm.a, poses.arm.d)[:-1] * ~poses.arm.sliding[:-1]))
    frames, end = poses.frames, row + 1
    computed = cantilever(poses, row)
    i = 0
    into = frames.rotation[end][i].T
    beam = into @ (frames.origin[end][i] - frames.origin[row][i])
    gravity = poses.covariates.get("gravity", np.tile([0, 0, -9.80665], (len(poses.q), 1)))[i]
    force, about = np.zeros(3), np.zeros(3)
    for k in range(end + 1, poses.arm.size + 1):
        place = frames.origin[k][i] + frames.rotation[k][i] @ poses.arm.centers[k]
        weight = poses.arm.masses[k] * gravity
        force += into @ weight
        about += into @ np.cross(place - frames.origin[end][i], weight)
    load = poses.covariates.get("payload", np.zeros(len(poses.q)))[i] * gravity
    force += into @ load
    about += into @ np.cross(frames.tip[i] - frames.origin[end][i], load)
    length = np.linalg.norm(beam)
    along = beam / length
    pieces = 20_000
    shift, turn = np.zeros(3), np.zeros(3)
    for s in (np.arange(pieces) + 0.5) / pieces:
        moment = about + np.cross((1 - s) * beam, force)
        moment -= along * (along @ moment)
        bend = moment * length / pieces
        turn += bend
        shift += np.cross(bend, (1 - s) * beam)
    np.testing.assert_allclose(computed[i], [*shift, *turn], atol=1e-6 * np.abs(computed[i]).max())


def _weighed_case():
    cases = (draw_case(seed) for seed in INSIDE)
    return next(c for c in cases if c.arm.weighed and c.arm.size > 4)


def test_movements_are_derivatives_of_the_frames():
    case = draw_case(INSIDE[0])
    poses = replace(case.sealed.poses, pose=False)
    arm, step, rows = poses.arm, 1e-6, len(poses.q)
    random = np.random.default_rng(1)
    for k in range(arm.size + 2):
        values = random.normal(size=(rows, 6))
        ways = [arm.walk(poses.q, {k: s * step * values}).tip for s in (1, -1)]
        slope = (ways[0] - ways[1]) / (2 * step)
        np.testing.assert_allclose(moved(poses, Action("frame", k, values)), slope, atol=1e-8)
    warm = random.normal(size=rows)
    ways = [arm.walk(poses.q, stretch=s * step * warm).tip for s in (1, -1)]
    slope = (ways[0] - ways[1]) / (2 * step)
    np.testing.assert_allclose(moved(poses, Action("length", 0, warm)), slope, atol=1e-8)


def test_an_oracle_finds_what_is_hidden():
    """The cases are fair: who knows the shapes gets nearly all of them right."""
    cases = run(range(20), oracle)
    result = card(cases)
    assert not result["failed"]
    right = {k: [c.exact for c in cases if c.kind == k] for k in set(KINDS)}
    assert np.mean(right["inside"]) >= 0.9
    assert np.mean(right["clean"]) >= 0.9
    assert np.mean(right["confounded"]) >= 0.75
    assert np.mean(right["outside"]) >= 0.7


def test_the_card_fails_who_guesses():
    def says(verdict, effects=()):
        return lambda case: OracleReport(verdict, list(effects))

    seeds = [0, 5, 10, 13]  # clean, outside, confounded, inside
    assert [evaluate(s, says("clean")).exact for s in seeds] == [True, False, False, False]
    assert [evaluate(s, says("unknown")).exact for s in seeds] == [False, True, False, False]
    curve = [OracleEffect("joint_harmonic", 0)]
    assert not any(evaluate(s, says("named", curve)).exact for s in seeds)

    def another_joint(case):
        report = oracle(case)
        for effect in report.effects:
            if effect.joint is not None:
                effect.joint = (effect.joint + 1) % case.arm.size
        return report

    joints = [s for s in INSIDE if any(e["joint"] is not None for e in make_case(s)[2].effects)]
    assert not any(evaluate(s, another_joint).exact for s in joints[:2])


def test_a_case_that_stops_the_diagnosis_is_on_the_card():
    def stops(case):
        raise RuntimeError("no")

    result = card(run([13], stops))
    assert result["failed"] == ["13: RuntimeError: no"]
    assert result["inside"][-1]["exact"] == 0.0
