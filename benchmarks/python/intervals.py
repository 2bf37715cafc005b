# SPDX-License-Identifier: BSD-3-Clause
"""Whether identify_arm's intervals hold the truth: ``python -m benchmarks.python.intervals``.

Simulated sets whose truth is known, by the cases of tests/support/interval_cases.py. Ends with
status 1 where an interval covers less than 93 % or more than 97 % of the sets, or a number that the
data tell is off by more than 0.1 of its scatter on average.
"""

import argparse
import time

import numpy as np

from tests.support.interval_cases import CASES, show

TITLES = {
    "tracked": "63 tracked positions",
    "with_distances": "63 touches, three distances given",
    "sockets": "400 touches of a Panda, ten pairs 50 mm apart, given",
    "without_distances": "63 touches, no distance given",
}


def run(sets: int) -> None:
    print("## Intervals of identified arms\n")
    print(
        "| case | numbers | least, greatest coverage of 95 % | greatest bias [σ] "
        "| found / reported std | sets |"
    )
    print("|---|---|---|---|---|---|")
    start = time.perf_counter()
    failed = []
    for case, make in CASES.items():
        fits, truth = make(sets)
        statuses = ("identified", "prior") if case == "untold" else ("identified",)
        for status in statuses:
            shown = show(fits, truth, (status,))
            least, greatest = shown.covered.min(), shown.covered.max()
            bias = np.abs(shown.bias).max()
            name = TITLES[case] + (": determined by the prior" if status == "prior" else "")
            print(
                f"| {name} | {len(shown.names)} | {100 * least:.1f}, {100 * greatest:.1f} % "
                f"| {bias:.3f} ({shown.names[np.abs(shown.bias).argmax()]}) "
                f"| {shown.spread.min():.3f} … {shown.spread.max():.3f} | {sets} |",
                flush=True,
            )
            if status == "identified" and not (0.93 < least < greatest < 0.97 and bias < 0.1):
                failed.append(name)
    print(
        f"\nArms of the prior's own spread in the last two rows, another in each set. Bias of the "
        f"mean over {sets} sets, itself known to {1 / np.sqrt(sets):.3f} σ. Touches draw a size "
        "that only a prior tells by (degrees of freedom) · (relative std)², for a smaller arm "
        f"scatters less; a given scale is freed of that. {time.perf_counter() - start:.0f} s."
    )
    if failed:
        raise SystemExit("outside the bounds: " + "; ".join(failed))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, default=5000)
    run(parser.parse_args().sets)
