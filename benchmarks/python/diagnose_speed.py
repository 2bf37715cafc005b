# SPDX-License-Identifier: BSD-3-Clause
"""Diagnosis of an arm against the same search written plainly with SciPy.

The peer (tests/support/diagnose_peer.py) refits geometry, base and tool with each form of each
effect in turn, by least_squares with its own derivatives on kinematics that NumPy computes for all
poses at once, one round: the best single form. Bathyal looks through more orders and moments, grows
sets, holds data out and weighs alternatives as well. Both must name what is hidden, and agree on
its size, before any time is printed.
"""

import argparse
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import scipy

import bathyal
from tests.simulated_cases.arm_draws import CATALOGUE
from tests.simulated_cases.arms import SimArm, pose
from tests.support.diagnose_peer import PlainSearch
from tests.support.real_arms import ARMS, ur10

NOISE = 1e-4  # per axis [m]
HIDDEN = (2, 3.0, 4e-4, -3e-4)  # joint, order, cos, sin: a harmonic of the elbow
COUNTS = (500, 1000, 2000, 4000, 8000)


def timed(call: Callable[[], Any]) -> tuple[float, Any]:
    begin = time.perf_counter()
    result = call()
    return time.perf_counter() - begin, result


def drawn() -> SimArm:
    """Six turning joints, with masses."""
    d, a, alpha, theta, sliding = (
        np.array(c) for c in zip(*CATALOGUE["elbow of six"], strict=True)
    )
    centers = np.zeros((7, 3))
    centers[1:, 0] = -a / 2
    return SimArm(
        theta, d, a, alpha, np.zeros(6), sliding, np.full(6, -2.8), np.full(6, 2.8),
        np.array([20, 7, 12, 5, 2, 2, 0.5]), centers, np.eye(4),
    )  # fmt: skip


def measured(rows: int) -> dict[str, Any]:
    """Poses, positions and covariates: everything that the library could ask for."""
    # Seed 500 draws noise that happens to grow with the range at p < 0.002, and is named so.
    random = np.random.default_rng(rows + 1)
    arm = drawn()
    q = random.uniform(arm.lower, arm.upper, (rows, 6))
    joint, order, cos, sin = HIDDEN
    real = q.copy()
    real[:, joint] += cos * np.cos(order * q[:, joint]) + sin * np.sin(order * q[:, joint])
    true = arm.built(random, 5e-4, 1e-3)
    base = pose(np.array([3e-3, -2e-3, 1e-3]), np.array([2e-3, 1e-3, -3e-3]))
    tip = true.walk(real).tip @ base[:3, :3].T + base[:3, 3]
    return {
        "q": q,
        "position": tip + NOISE * random.normal(size=tip.shape),
        "covariates": {
            "time": 10.0 * np.arange(rows),
            "temperature": 20 + 4 * np.sin(np.linspace(0, 9, rows)),
            "payload": random.choice([0.0, 2.0, 5.0], rows),
            "direction": random.choice([-1.0, 1.0], (rows, 6)),
            "session": np.repeat([0, 1, 2], -(-rows // 3))[:rows].astype(float),
        },
    }


def tracked(data: dict[str, Any]) -> bathyal.Tracked:
    covariates = dict(data["covariates"])
    session = covariates.pop("session").astype(int)
    return bathyal.Tracked(data["q"], data["position"], covariates=covariates, session=session)


def check(report: Any) -> None:
    """The hidden harmonic, and nothing else."""
    joint, order, cos, sin = HIDDEN
    names = [(e.name, e.joint) for e in report.effects]
    if report.verdict != "named" or names not in (
        [("joint_harmonic", joint)],
        [("joint_map", joint)],
    ):
        sys.exit(f"bathyal says {report.verdict}: {names}")
    found = report.effects[0].parameters
    mark = "" if report.effects[0].name == "joint_harmonic" else f"_{order:.0f}"
    for name, true in (("cos", cos), ("sin", sin)):
        if abs(found[name + mark].value - true) > 5 * found[name + mark].std:
            sys.exit(f"bathyal's {name} is {found[name + mark].value}, hidden was {true}")


def beside_scipy(rounds: int) -> str:
    data = measured(COUNTS[0])
    search = PlainSearch(drawn(), **data)
    scipy_s, found = timed(search.search)
    joint, _, cos, sin = HIDDEN
    best = found.shapes[0]
    if best.cause != ("curve", joint):
        sys.exit(f"SciPy's best is {best.name} of joint {best.joint}")
    if best.name == "joint_harmonic" and not np.allclose(
        list(found.values(0).values()), [cos, sin], atol=5e-5
    ):
        sys.exit(f"SciPy's harmonic is {found.values(0)}")
    arm, given = drawn().arm(), tracked(data)
    runs = {
        n: [timed(lambda n=n: bathyal.diagnose(arm, given, num_threads=n)) for _ in range(rounds)]
        for n in (1, 2)
    }
    seconds = {n: float(np.median([s for s, _ in each])) for n, each in runs.items()}
    one, two = runs[1][0][1], runs[2][0][1]
    check(one)
    if not np.array_equal(one.residuals_after, two.residuals_after):
        sys.exit("one thread and two differ")
    rows = [
        f"| {len(given)} poses, whole library | time / ours on one thread | s |",
        "|---|---|---|",
        f"| ours, one thread | **1 ×** | {seconds[1]:.2f} |",
        f"| ours, two threads | {seconds[2] / seconds[1]:.2f} × | {seconds[2]:.2f} |",
        f"| SciPy, one round of {found.forms} forms | **{scipy_s / seconds[1]:.0f} ×** "
        f"| {scipy_s:.0f} |",
        "\nBoth name the harmonic that is hidden, with its sine and cosine; the goal is 10 s.",
    ]
    return "\n".join(rows)


def growth() -> str:
    lines = ["\n| poses | two threads [s] | µs a pose |", "|---|---|---|"]
    for rows in COUNTS:
        seconds, report = timed(
            lambda n=rows: bathyal.diagnose(drawn().arm(), tracked(measured(n)))
        )
        check(report)
        lines.append(f"| {rows} | {seconds:.2f} | {1e6 * seconds / rows:.0f} |")
    return "\n".join(lines)


def real() -> str:
    """One session, and three together, each with a base of its own."""
    if not ARMS.exists():
        return "\nThe recordings of a real arm were left out: the shared data is not here.\n"
    sessions = [ur10(series) for series in "CBA"]
    together = bathyal.Tracked(
        np.vstack([one.q for one in sessions]),
        np.vstack([one.position for one in sessions]),
        station=np.repeat(range(3), [len(one) for one in sessions]),
    )
    lines = [
        "\n| IPA's UR10, positions, two threads | poses | s | goal | verdict | causes | "
        "held out: geometry [mm] | with what is named | floor |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for name, data, goal in (
        ("series A", sessions[2], 60),
        ("series A, B and C together, a station each", together, 120),
    ):
        seconds, report = timed(lambda data=data: bathyal.diagnose(bathyal.arms.ur10(), data))
        held = report.held_out
        lines.append(
            f"| {name} | {len(data):,} | {seconds:.0f} | {goal} | {report.verdict} "
            f"| {len(report.effects)} | {1e3 * held.rms_before:.3f} | {1e3 * held.rms_after:.3f} "
            f"| {1e3 * held.noise:.3f} |"
        )
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    print("## Diagnosis against a plain search with SciPy\n")
    print(
        "The whole of `diagnose`. SciPy's `least_squares` (MINPACK) refits geometry, base and tool "
        "with each form of each effect in turn, with its own derivatives, on kinematics that NumPy "
        "computes for all poses at once; one round, without held-out data, sets or alternatives.\n"
    )
    print(beside_scipy(options.rounds))
    print(growth())
    print(real())
    print(f"SciPy {scipy.__version__}, numpy {np.__version__}.")


if __name__ == "__main__":
    main()
