# SPDX-License-Identifier: BSD-3-Clause
"""The score card: sealed cases, a diagnosis, and how often it was right, by size of effect.

    python -m tests.simulated_cases.score_card --seeds 0:400 [--oracle] [--out FOLDER]

`--oracle` asks an oracle that knows noise and shapes in the diagnosis' place: it shows what the
cases allow.
"""

from __future__ import annotations

import argparse
import json
import os
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np

from tests.simulated_cases.evaluation import Diagnose, Evaluated, engine, evaluate

CLASSES = (0.25, 0.5, 1.0, 2.0, 4.0)


def run(
    seeds: Iterable[int],
    diagnose: Diagnose = engine,
    processes: int = 1,
    progress: Callable[[int], None] = lambda done: None,
) -> list[Evaluated]:
    """Evaluates the cases of `seeds`, in their order; `progress` hears how many are done."""
    work = partial(evaluate, diagnose=diagnose)
    out = []
    if processes == 1:
        for seed in seeds:
            out.append(work(seed))
            progress(len(out))
        return out
    with _one_thread_each(), get_context("spawn").Pool(processes) as pool:
        for evaluated in pool.imap(work, seeds, chunksize=4):
            out.append(evaluated)
            progress(len(out))
    return out


@contextmanager
def _one_thread_each() -> Iterator[None]:
    """Cases run in parallel: NumPy is to use one thread in each process that starts."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")
    before = {n: os.environ.get(n) for n in names}
    os.environ |= dict.fromkeys(names, "1")
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def card(cases: Sequence[Evaluated]) -> dict[str, Any]:
    """All that the card says, as plain numbers."""
    kinds: dict[str, list[Evaluated]] = defaultdict(list)
    for case in cases:
        kinds[case.kind].append(case)
    return {
        "cases": len(cases),
        "failed": [f"{c.seed}: {c.failure}" for c in cases if c.failure],
        "inside": [_inside(size, _at(kinds["inside"], size)) for size in (*CLASSES, None)],
        "outside": [_outside(size, _at(kinds["outside"], size)) for size in (*CLASSES[1:], None)],
        "clean": _shares(kinds["clean"]),
        "held out": _median([c.held_out for c in kinds["clean"] if np.isfinite(c.held_out)]),
        "confounded": _confounded(kinds["confounded"]),
        "coverage": _coverage(cases),
        "error": {
            "named exactly": _error([c for c in kinds["inside"] if c.exact]),
            "all with effects at 1 and more": _error([c for c in kinds["inside"] if c.size >= 1]),
            "clean": _error(kinds["clean"]),
        },
        "confusion": _confusion(cases),
        "outside kinds": {
            name: _outside(None, [c for c in kinds["outside"] if c.outside == name])
            for name in sorted({c.outside for c in kinds["outside"]})
        },
        "seconds": {
            "median": float(np.median([c.seconds for c in cases])) if cases else 0.0,
            "largest": max((c.seconds for c in cases), default=0.0),
        },
    }


def _at(cases: list[Evaluated], size: float | None) -> list[Evaluated]:
    """Of a class of sizes; None is all from 1 on."""
    return [c for c in cases if (c.size >= 1 if size is None else c.size == size)]


def _share(cases: list[Evaluated], good: Callable[[Evaluated], bool]) -> float:
    return sum(good(c) for c in cases) / len(cases) if cases else float("nan")


def _inside(size: float | None, cases: list[Evaluated]) -> dict[str, Any]:
    held = [c for c in cases if c.holds]
    return {
        "size": "1 and more" if size is None else f"{size:g}",
        "cases": len(cases),
        "exact": _share(cases, lambda c: c.exact),
        "ambiguous with the truth": _share(cases, lambda c: c.holds),
        "mean list": float(np.mean([c.listed for c in held])) if held else 0.0,
        "named otherwise": _share(cases, lambda c: c.verdict == "named" and not c.exact),
        "unknown": _share(cases, lambda c: c.verdict == "unknown"),
        "clean": _share(cases, lambda c: c.verdict == "clean"),
    }


def _outside(size: float | None, cases: list[Evaluated]) -> dict[str, Any]:
    return {
        "size": "1 and more" if size is None else f"{size:g}",
        "cases": len(cases),
        "unknown": _share(cases, lambda c: c.exact),
        "named": _share(cases, lambda c: c.verdict == "named"),
        "ambiguous": _share(cases, lambda c: c.verdict == "ambiguous"),
        "clean": _share(cases, lambda c: c.verdict == "clean"),
        "unknown with partial names": _share(cases, lambda c: c.exact and c.partial > 0),
    }


def _shares(cases: list[Evaluated]) -> dict[str, Any]:
    verdicts = Counter(c.verdict for c in cases)
    return {"cases": len(cases)} | {v: n / len(cases) for v, n in sorted(verdicts.items())}


def _confounded(cases: list[Evaluated]) -> dict[str, Any]:
    right = [c for c in cases if c.exact]
    return {
        "cases": len(cases),
        "ambiguous with both": _share(cases, lambda c: c.exact),
        "mean list": float(np.mean([c.listed for c in right])) if right else 0.0,
        "verdicts": _shares(cases),
    }


def _coverage(cases: Sequence[Evaluated]) -> dict[str, Any]:
    each: dict[str, list[bool]] = defaultdict(list)
    off = []
    for case in cases:
        for name, z, inside in case.inside:
            each[name.split(".")[0]].append(inside)
            off.append(abs(z))
    total = [inside for many in each.values() for inside in many]
    # How often the truth lies within so many standard deviations, by what a normal law says.
    levels = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99]
    return {
        "parameters": len(total),
        "covered": float(np.mean(total)) if total else float("nan"),
        "by effect": {n: [float(np.mean(v)), len(v)] for n, v in sorted(each.items())},
        "levels": levels,
        "observed": [float(np.mean(np.array(off) <= _quantile(p))) if off else 0.0 for p in levels],
    }


def _quantile(level: float) -> float:
    return NormalDist().inv_cdf(0.5 + level / 2)


def _median(values: list[float]) -> float:
    return float(np.median(values)) if values else float("nan")


def _error(cases: list[Evaluated]) -> dict[str, Any]:
    """Predicted tips against the truth, over what a refit comes to that is given the causes."""
    known = [c for c in cases if np.isfinite(c.error) and c.refit_error > 0]
    if not known:
        return {"cases": 0, "ratio": float("nan"), "median": float("nan")}
    square = np.array([[c.error**2, c.refit_error**2] for c in known])
    return {
        "cases": len(known),
        "ratio": float(np.sqrt(square[:, 0].sum() / square[:, 1].sum())),
        "median": float(np.median(np.sqrt(square[:, 0] / square[:, 1]))),
    }


def _confusion(cases: Sequence[Evaluated]) -> dict[str, dict[str, int]]:
    table: dict[str, Counter[str]] = defaultdict(Counter)
    for case in cases:
        for true, given in case.pairs:
            table[true][given] += 1
    return {true: dict(sorted(given.items())) for true, given in sorted(table.items())}


# --- as text and pictures ------------------------------------------------------------------------


def text(result: dict[str, Any]) -> str:
    """Tables in Markdown."""
    clean, both = result["clean"], result["confounded"]
    cover, error = result["coverage"], result["error"]
    lines = [
        f"{result['cases']} sealed cases.",
        "",
        *_table("smallest effect / noise", result["inside"]),
        "",
        *_table("outside the library / noise", result["outside"]),
        "",
        "| of other kinds | cases | share |",
        "|---|---|---|",
        f"| clean, called clean | {clean['cases']} | {_percent(clean.get('clean', 0.0))} |",
        f"| clean, error held out / noise (median; below 1 where blocks leak) | {clean['cases']} "
        f"| {result['held out']:.3f} |",
        f"| confounded, ambiguous with both names (mean list {both['mean list']:.1f}) "
        f"| {both['cases']} | {_percent(both['ambiguous with both'])} |",
        f"| 95 % intervals that hold the truth | {cover['parameters']} numbers "
        f"| {_percent(cover['covered'])} |",
        *(
            f"| error / that of a refit given the causes, {name} | {e['cases']} "
            f"| {e['ratio']:.2f} × (median {e['median']:.2f}) |"
            for name, e in error.items()
        ),
        f"| seconds a case, median (largest) | | {result['seconds']['median']:.2f} "
        f"({result['seconds']['largest']:.1f}) |",
    ]
    if result["failed"]:
        lines += ["", f"{len(result['failed'])} failed:", *result["failed"][:20]]
    return "\n".join(lines)


def _table(first: str, rows: list[dict[str, Any]]) -> list[str]:
    columns = [c for c in rows[0] if c != "size"]
    out = [f"| {first} | " + " | ".join(columns) + " |", "|---" * (len(columns) + 1) + "|"]
    for row in rows:
        cells = [
            str(row[c]) if c == "cases" else f"{row[c]:.1f}" if "list" in c else _percent(row[c])
            for c in columns
        ]
        out.append(f"| {row['size']} | " + " | ".join(cells) + " |")
    return out


def _percent(share: float) -> str:
    return "–" if np.isnan(share) else f"{100 * share:.1f} %"


def draw(result: dict[str, Any], folder: Path) -> None:
    """confusion.png and reliability.png."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    table = result["confusion"]
    rows = list(table)
    columns = sorted({given for row in table.values() for given in row})
    columns = [c for c in rows if c in columns] + [c for c in columns if c not in rows]
    share = np.zeros((len(rows), len(columns)))
    for i, true in enumerate(rows):
        for given, number in table[true].items():
            share[i, columns.index(given)] = number / sum(table[true].values())
    figure, axes = plt.subplots(figsize=(9, 7.5), layout="constrained")
    axes.imshow(share, cmap="Blues", vmin=0, vmax=1)
    for i, j in zip(*np.nonzero(share > 0.004), strict=True):
        shade = "white" if share[i, j] > 0.6 else "black"
        axes.text(j, i, f"{100 * share[i, j]:.0f}", ha="center", va="center", color=shade, size=7)
    axes.set_xticks(range(len(columns)), [c.replace("_", " ") for c in columns], rotation=90)
    names = [f"{r.replace('_', ' ')} ({sum(table[r].values())})" for r in rows]
    axes.set_yticks(range(len(rows)), names)
    axes.set(xlabel="called", ylabel="hidden (how many)", title="Of 100 hidden, how many called so")
    figure.savefig(folder / "confusion.png", dpi=130)
    plt.close(figure)

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4.2), layout="constrained")
    cover = result["coverage"]
    left.plot([0, 1], [0, 1], color="0.7", lw=1)
    if cover["parameters"]:
        left.plot(cover["levels"], cover["observed"], "o-", color="tab:blue")
    left.set(xlabel="interval's level", ylabel="share that holds the truth", title="Intervals")
    inside = [r for r in result["inside"] if r["size"] != "1 and more" and r["cases"]]
    beyond = [r for r in result["outside"] if r["size"] != "1 and more" and r["cases"]]
    right.semilogx([float(r["size"]) for r in inside], [r["exact"] for r in inside], "o-")
    right.semilogx([float(r["size"]) for r in beyond], [r["unknown"] for r in beyond], "s--")
    right.legend(["all causes named", "outside the library, called unknown"])
    right.set_xticks(CLASSES, [f"{c:g}" for c in CLASSES])
    right.minorticks_off()
    right.set(xlabel="size / noise", ylabel="share of cases", ylim=(0, 1.03), title="Verdicts")
    figure.savefig(folder / "reliability.png", dpi=130)
    plt.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", default="0:400", help="first:end")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--oracle", action="store_true")
    parser.add_argument("--out", type=Path)
    options = parser.parse_args()
    diagnose: Diagnose = engine
    if options.oracle:
        from tests.simulated_cases.oracle_report import oracle

        diagnose = oracle
    first, end = map(int, options.seeds.split(":"))
    cases = run(range(first, end), diagnose, options.processes)
    result = card(cases)
    print(text(result))
    wrong = [c for c in cases if not c.exact]
    print(f"\n{len(wrong)} not as asked:")
    for c in wrong:
        hidden = ", ".join(c.expected) or c.outside or "nothing"
        print(f"{c.seed} {c.kind} {c.size:g}: {hidden} -> {c.verdict}: {', '.join(c.named)}")
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        (options.out / "card.json").write_text(json.dumps(result, indent=1))
        (options.out / "cases.json").write_text(json.dumps([asdict(c) for c in cases]))
        draw(result, options.out)


if __name__ == "__main__":
    main()
