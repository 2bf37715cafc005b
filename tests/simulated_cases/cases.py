# SPDX-License-Identifier: BSD-3-Clause
"""Seals effects in made data: a seed makes an arm, what was measured of it, and the answer.

    python -m tests.simulated_cases.cases FOLDER SEED ...

Everything is computed here in NumPy; bathyal only holds the numbers that are handed over. Seeds
are distinguished by their last digits: of 20, five are clean, five carry what the library does not
have, two what their data do not distinguish, eight one to three effects of the library.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict, dataclass, field
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

import bathyal
from tests.simulated_cases.arms import Array, SimArm
from tests.simulated_cases.scenario import Plan, Scene, plan_case
from tests.simulated_cases.simulate import Sealed, seal

KINDS = ["clean"] * 5 + ["outside"] * 5 + ["confounded"] * 2 + ["inside"] * 8
SIZES = {0.25: 0.15, 0.5: 0.2, 1.0: 0.25, 2.0: 0.25, 4.0: 0.15}


@dataclass
class Answer:
    """What the diagnosis never sees."""

    seed: int
    kind: str  # clean, inside, outside, confounded
    verdict: str  # clean, named, unknown, ambiguous
    size: float  # of the smallest effect, in noises; 0 of clean ones
    noise: float  # per axis [m]
    effects: list[dict[str, Any]] = field(default_factory=list)
    alternatives: list[str] = field(
        default_factory=list
    )  # names that these data do not distinguish
    outside: str = ""  # what the library does not have
    unexplained: float = 0.0  # share of it, in size, that four effects of the library leave
    attempts: int = 1


@dataclass
class Case:
    """A sealed case: what is handed over, and what only the evaluation uses."""

    arm: SimArm  # as drawn by its maker
    scene: Scene
    sealed: Sealed
    answer: Answer

    def bathyal_arm(self) -> bathyal.Arm:
        return self.arm.arm()

    def data(self) -> bathyal.Tracked | bathyal.Touches:
        return handed_over(self.record())

    def record(self) -> dict[str, Array]:
        """Arrays that the diagnosis may see."""
        sealed = self.sealed
        out = {"q": sealed.q}
        if self.scene.plan.form == "touches":
            assert sealed.point is not None
            out["point"] = sealed.point
            if sealed.distances is not None:
                out["distances"] = sealed.distances
        elif self.scene.plan.form == "pose":
            out["pose"] = sealed.pose
        else:
            out["position"] = sealed.pose[:, :3, 3]
        return out | {f"covariate_{k}": v for k, v in sealed.covariates.items()}


def handed_over(record: dict[str, Array]) -> bathyal.Tracked | bathyal.Touches:
    """The data of a case from its arrays."""
    start = "covariate_"
    covariates = {k.removeprefix(start): v for k, v in record.items() if k.startswith(start)}
    session = covariates.pop("session", None)
    more = {} if session is None else {"session": session.astype(int)}
    if "point" in record:
        distances = {
            (int(a), int(b)): float(length) for a, b, length in record.get("distances", np.empty(0))
        }
        return bathyal.Touches(
            record["q"],
            record["point"].astype(int),
            known_distances=distances or None,
            covariates=covariates,
            **more,
        )
    if "pose" in record:
        return bathyal.Tracked(record["q"], pose=record["pose"], covariates=covariates, **more)
    return bathyal.Tracked(record["q"], record["position"], covariates=covariates, **more)


def draw_case(seed: int) -> Case:
    """The case of a seed: what cannot be, or cannot be determined, is drawn anew."""
    kind = KINDS[seed % len(KINDS)]
    for attempt in count():
        random = np.random.default_rng([seed, attempt, 5])
        plan = plan_case(random, kind, list(SIZES), list(SIZES.values()))
        scene = Scene.draw(random, plan)
        sealed = seal(random, scene) if scene else None
        if scene and sealed:
            return Case(scene.drawn, scene, sealed, _answer(seed, attempt + 1, plan, sealed))
    raise AssertionError("unreachable")


def _answer(seed: int, attempts: int, plan: Plan, sealed: Sealed) -> Answer:
    verdict = {"inside": "named", "outside": "unknown", "confounded": "ambiguous"}
    sizes = [e["size"] for e in sealed.effects] + ([sealed.outside_size] if plan.outside else [])
    return Answer(
        seed,
        plan.kind,
        verdict.get(plan.kind, "clean"),
        min(sizes, default=0.0),
        plan.noise,
        sealed.effects,
        plan.alternatives,
        plan.outside,
        sealed.unexplained,
        attempts,
    )


def make_case(seed: int) -> tuple[bathyal.Arm, bathyal.Tracked | bathyal.Touches, Answer]:
    case = draw_case(seed)
    return case.bathyal_arm(), case.data(), case.answer


def write_case(folder: Path, seed: int) -> None:
    """case.npz and arm.urdf (or the table, in case.npz), and answer.json apart from them."""
    case = draw_case(seed)
    folder.mkdir(parents=True, exist_ok=True)
    record = case.record()
    if case.arm.urdf:
        (folder / "arm.urdf").write_text(case.arm.urdf_text())
    else:
        names = ("theta", "d", "a", "alpha", "beta", "sliding", "lower", "upper")
        record |= {f"arm_{n}": np.asarray(getattr(case.arm, n), float) for n in names}
        record |= {"arm_masses": case.arm.masses, "arm_centers": case.arm.centers}
    np.savez(folder / "case.npz", **record)  # type: ignore[arg-type]
    (folder / "answer.json").write_text(json.dumps(asdict(case.answer), indent=1))


def read_case(folder: Path) -> tuple[bathyal.Arm, bathyal.Tracked | bathyal.Touches]:
    """What the diagnosis sees of a written case: nothing of answer.json."""
    with np.load(folder / "case.npz") as file:
        record = {name: np.array(file[name]) for name in file.files}
    table = {n.removeprefix("arm_"): record.pop(n) for n in list(record) if n.startswith("arm_")}
    if (folder / "arm.urdf").exists():
        arm = bathyal.Arm.from_urdf(folder / "arm.urdf", tip="tip")
    else:
        table["sliding"] = table["sliding"].astype(bool)
        arm = SimArm(**table, tool=np.eye(4)).arm()  # type: ignore[arg-type]
    return arm, handed_over(record)


if __name__ == "__main__":
    for word in sys.argv[2:]:
        write_case(Path(sys.argv[1]) / word, int(word))
