# SPDX-License-Identifier: BSD-3-Clause
"""The score card of hidden effects over two thousand cases: tables, JSON and pictures.

    python -m benchmarks.python.score_card [--seeds 7000:9000] [--out FOLDER]

Each case is sealed by tests/simulated_cases/cases.py, in NumPy and from its seed alone; bathyal
sees the data, the evaluation compares with the answer. See tests/simulated_cases/score_card.py.
Seeds below 7000 have been looked at while the engine was made; those of the card have not.
"""

import argparse
import json
import sys
import time
from dataclasses import asdict
from pathlib import Path

from tests.simulated_cases.score_card import card, draw, run, text

ROOT = Path(__file__).parents[2]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", default="7000:9000", help="first:end")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "score_card")
    options = parser.parse_args()
    seeds = range(*map(int, options.seeds.split(":")))
    begin = time.perf_counter()

    def told(done: int) -> None:
        if done % 100 == 0:
            seconds = time.perf_counter() - begin
            print(f"{done} of {len(seeds)} cases, {seconds:.0f} s", file=sys.stderr, flush=True)

    cases = run(seeds, processes=options.processes, progress=told)
    result = card(cases)
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "card.json").write_text(json.dumps(result, indent=1))
    (options.out / "cases.json").write_text(json.dumps([asdict(c) for c in cases], indent=1))
    draw(result, options.out)
    if result["failed"]:
        sys.exit("\n".join(["cases that stopped the diagnosis:", *result["failed"]]))
    print("## Diagnosis: hidden effects found\n")
    print(
        "Sealed cases, a seed each, one thread a case; the size of an effect is the rms per axis "
        "that it leaves beyond the refitted geometry and the other true effects, over the noise "
        "per axis; a case counts by its smallest effect. Exact: the very set of causes, joints and "
        "rows included.\n"
    )
    print(text(result))


if __name__ == "__main__":
    main()
