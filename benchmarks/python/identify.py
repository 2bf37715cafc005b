# SPDX-License-Identifier: BSD-3-Clause
"""Identification of an arm against SciPy's least_squares.

The peer's residual is NumPy, vectorised over touches. It gets all parameters but the length that is
held, as bathyal does, and then only those that bathyal has found worth asking for. Costs are
compared before any time is printed. A round times each in turn; figures are medians.
"""

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray
from scipy.optimize import least_squares

import bathyal
from tests.support.identify_peer import Peer, built, touch

HERE = Path(__file__).parent

Array = NDArray[Any]
SERIES_A = "arms/ipa-ur10/Series_A/measurements_grid.csv"
JOINTS = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"]
HELD = {"fixed": ["a_2"], "length_prior": 100.0, "noise": 1e-4}  # the scale, by one length


def timed(call: Callable[[], object]) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def touches_row(rounds: int) -> str:
    arm = bathyal.arms.ur10e()
    q, point = touch(built(arm, 1e-3, 1), 21, 2)
    data = bathyal.Touches(q + 5e-5 * np.random.default_rng(3).normal(size=q.shape), point)
    fit = bathyal.identify_arm(arm, data, **HELD)
    peer = Peer(arm, fit, data.q, data.point)
    every = [i for i, p in enumerate(fit.parameters) if p.status != "fixed"]
    free = [i for i in every if fit.parameters[i].status != "gauge"]

    def scipys(columns: list[int], derivatives: bool = False, **options: Any) -> Any:
        def at(y: Array) -> Array:
            x = peer.nominal.copy()
            x[columns] += 1e-3 * y
            return x

        def jacobian(y: Array) -> Array:
            return peer.jacobian(at(y))[:, columns]

        if derivatives:
            options["jac"] = jacobian
        return least_squares(
            lambda y: 1e3 * peer.residuals(at(y)), np.zeros(len(columns)), **options
        )

    # As it comes SciPy stops within 1e-8 or so of the minimum: that is what is timed.
    tight = {"xtol": 1e-13, "ftol": 1e-13, "gtol": 1e-13}
    costs = [2e-6 * scipys(free, derivatives=own, **tight).cost for own in (False, True)]
    pairs = bathyal.identify_arm(arm, data, criterion="pairs", **HELD)
    costs.append(float(np.sum(pairs.residuals**2)))
    ours = float(np.sum(fit.residuals**2))
    differ = max(abs(cost / ours - 1) for cost in costs)
    if differ > 1e-8:
        sys.exit(f"costs differ: {[f'{cost / ours - 1:.1e}' for cost in costs]}")
    runs: list[Callable[[], object]] = [
        lambda: bathyal.identify_arm(arm, data, num_threads=1, **HELD),
        lambda: bathyal.identify_arm(arm, data, num_threads=1, criterion="pairs", **HELD),
        lambda: bathyal.identify_arm(arm, data, num_threads=1),
        lambda: scipys(every),
        lambda: scipys(free),
        lambda: scipys(free, derivatives=True),
    ]
    times = np.array([[timed(run) for run in runs] for _ in range(rounds)])
    centroid, all_pairs, default, *scipy_ms = 1e3 * np.median(times, axis=0)
    ratios = np.median(times[:, 3:] / times[:, :1], axis=0)
    peers = ["left to itself", f"given which {len(free)}", "and their derivatives"]
    lines = [
        f"| {len(data)} touches × {len(fit.parameters)} parameters | time / ours | ms |",
        "|---|---|---|",
        f"| ours | **1 ×** | {centroid:.2f} |",
        f"| ours, all pairs (eq 7) | {all_pairs / centroid:.1f} × | {all_pairs:.2f} |",
        f"| ours, the noise and the size to be found too | {default / centroid:.1f} × "
        f"| {default:.2f} |",
        *(
            f"| SciPy, {peer} | **{ratio:.0f} ×** | {ms:.0f} |"
            for peer, ratio, ms in zip(peers, ratios, scipy_ms, strict=True)
        ),
        f"\nCosts differ by {differ:.0e} of themselves.",
    ]
    return "\n".join(lines)


def tracked_row(file: Path, rounds: int) -> str:
    if not file.exists():
        return f"\nTracked poses were left out: {file.name} is not there.\n"
    data = bathyal.read_tracked(
        file,
        joints=[f"{name}_joint" for name in JOINTS],
        unit="rad",
        position=["measurement_x", "measurement_y", "measurement_z"],
        position_unit="mm",
        orientation=["measurement_rx", "measurement_ry", "measurement_rz"],
        orientation_unit="deg",
        euler="XYZ",
    )
    arm = bathyal.arms.ur10()
    fits = [bathyal.identify_arm(arm, data, num_threads=threads) for threads in (1, 2)]
    if not np.array_equal(fits[0].residuals, fits[1].residuals):
        sys.exit("one thread and two differ")
    times = np.median(
        [
            [timed(lambda n=n: bathyal.identify_arm(arm, data, num_threads=n)) for n in (1, 2)]
            for _ in range(rounds)
        ],
        axis=0,
    )
    return (
        "\n| tracked poses × parameters | 1 thread [s] | 2 threads [s] | rms [mm] |\n"
        "|---|---|---|---|\n"
        f"| {len(data)} × {len(fits[0].parameters)} | {times[0]:.2f} | {times[1]:.2f} "
        f"| {1e3 * fits[0].rms_before:.3f} to {1e3 * fits[0].rms_after:.3f} |\n"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--data", type=Path, default=HERE.parents[2] / "shared" / "data")
    options = parser.parse_args()
    print("## Identification against SciPy\n")
    print(
        "The whole of `identify_arm`, one thread: start, what can be determined, search, "
        "covariance, checks, report. SciPy's `least_squares` as it comes, on a residual that NumPy "
        "computes for all touches at once: left to itself with all parameters, given which of "
        "them base and tool leave, and given exact derivatives of those. One length is held: all "
        "minimise the same.\n"
    )
    print(touches_row(options.rounds))
    print(tracked_row(options.data / SERIES_A, max(3, options.rounds // 3)))
    print(f"Medians of interleaved rounds. SciPy {scipy.__version__}, numpy {np.__version__}.")


if __name__ == "__main__":
    main()
