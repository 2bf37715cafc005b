# SPDX-License-Identifier: BSD-3-Clause
"""What diagnosis makes of recordings of real arms: a table and the causes it names.

    python -m benchmarks.python.diagnose_real [NAME ...]

Reads ../shared/data; names are those of RUNS ("UR10 C"), TRANSFERS ("A-B"), SITES, "quarters" and
"fifths" (of each UR10), by default all.
Errors are 3-D rms in millimetres, of rows or poses that taught nothing.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Callable, Iterable
from functools import cache

import numpy as np
from numpy.typing import NDArray

import bathyal
from tests.support.real_arms import hilti, hilti_tilts, sockets, trailblazer, ur10

MM = 1e3
AT_START = {"time": 0.0}  # before anything drifted or slipped
TEMPERATURES = {"flat": 21.0, "outdoor": 9.0}  # of Hilti's sites, by their file [°C]
FEWEST_ROWS = 10  # that an error is reported of
TOLD_CAUSES = 6  # of each run, the largest first


def tracked(series: str) -> bathyal.Tracked:
    every = ur10(series)
    return bathyal.Tracked(every.q, every.position)


RUNS: dict[str, tuple[Callable[[], bathyal.Arm], Callable[[], bathyal.Touches | bathyal.Tracked]]]
RUNS = {
    **{f"UR10 {s}": (bathyal.arms.ur10, lambda s=s: tracked(s)) for s in "CBA"},
    "Panda 2": (bathyal.arms.panda, lambda: sockets("panda_2_clean")),
    "Panda 3": (bathyal.arms.panda, lambda: sockets("panda_3")),
    "Kinova 1": (bathyal.arms.gen3_lite, lambda: sockets("dinova_1")),
    "Kinova 2": (bathyal.arms.gen3_lite, lambda: sockets("dinova_2")),
    "Hilti flat": (trailblazer, lambda: hilti("flat")[0]),
}  # fmt: skip
TRANSFERS = [("A", "B"), ("B", "A"), ("A", "C"), ("B", "C")]
SITES = ["diagonal_wood", "orthogonal_wood", "outdoor", "pallet", "seesaw", "wood_left_track"]


@cache
def diagnosed(name: str) -> tuple[bathyal.Diagnosis, float]:
    arm, data = RUNS[name]
    asked = arm(), data()
    begin = time.perf_counter()
    report = bathyal.diagnose(*asked)
    return report, time.perf_counter() - begin


def rms(errors: NDArray[np.float64]) -> float:
    return float(np.sqrt((errors**2).sum(axis=1).mean()))


def line(name: str) -> str:
    report, seconds = diagnosed(name)
    held = report.held_out
    rows = len(RUNS[name][1]().q)
    parts = {part.name: part for part in held.parts}
    within = parts.get("within others' ranges")
    beyond = parts["beyond others' ranges"].rows if within else 0
    inside = f"{within.rms_after * MM:.3f} ({beyond} beyond)" if within else ""
    left = report.leftover
    return (
        f"| {name} | {rows:,} | {report.verdict} | {held.rms_before * MM:.3f} | "
        f"{held.rms_after * MM:.3f} | {inside} | {held.noise * MM:.3f} | {len(report.effects)} | "
        f"{left.words} ({left.share:.1%}) | {seconds:.0f} |"
    )


def causes(name: str) -> Iterable[str]:
    report, _ = diagnosed(name)
    for effect in report.effects[:TOLD_CAUSES]:
        others = ", ".join(r.words for r in effect.rivals if r.odds > 0.05)
        yield (
            f"  - {effect.words}: {effect.size * MM:.3f} mm per axis, p {effect.p_value:.0e}"
            + (f"; as well: {others}" if others else "")
        )


def transfer(taught: str, asked: str) -> str:
    report, _ = diagnosed(f"UR10 {taught}")
    return f"| {' | '.join([f'{taught} → {asked}', *carried(report, asked)])} |"


def quarter(start: int) -> str:
    """What hangs on which rows were taken: each fourth pose of A by itself, asked for B."""
    data = tracked("A")
    some = bathyal.Tracked(data.q[start::4], data.position[start::4])
    begin = time.perf_counter()
    report = bathyal.diagnose(bathyal.arms.ur10(), some)
    seconds = time.perf_counter() - begin
    held = f"{report.held_out.rms_after * MM:.3f}"
    return f"| {start + 1} | {held} | {' | '.join(carried(report, 'B'))} | {seconds:.0f} |"


def fifth(series: str) -> str:
    """What names, orders and sizes are worth where all are chosen without the predicted rows: each
    random fifth of the poses, with their repeats, is left out of the whole diagnosis and predicted
    by its model. Outliers: rows that the diagnosis of the whole session excludes."""
    data = tracked(series)
    report, _ = diagnosed(f"UR10 {series}")
    outliers = {row for effect in report.effects for row in effect.rows}
    belongs = np.array([row not in outliers for row in range(len(data.q))])
    pose = np.unique(np.round(data.q, 2), axis=0, return_inverse=True)[1].ravel()
    part = np.random.default_rng(0).permutation(pose.max() + 1)[pose] % 5
    table, taken, begin = [], [], time.perf_counter()
    for number in range(5):
        own = part == number
        others = bathyal.Tracked(data.q[~own], data.position[~own])
        found = bathyal.diagnose(bathyal.arms.ur10(), others)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bathyal.SupportWarning)
            off = [
                arm.forward(data.q[own])[:, :3, 3] - data.position[own]
                for arm in (found.fit.arm, found.model)
            ]
        table.append([rms(off[0]), rms(off[1]), rms(off[1][belongs[own]])])
        taken.append(f"{table[-1][2] * MM:.3f}")
    seconds = time.perf_counter() - begin
    geometry, all_rows, belonging = np.mean(table, axis=0) * MM
    page = report.held_out.rms_after * MM
    return (
        f"| UR10 {series} | {geometry:.3f} | {all_rows:.3f} | {belonging:.3f} | "
        f"{', '.join(taken)} | {len(outliers)} | {page:.3f} | {seconds:.0f} |"
    )


def carried(report: bathyal.Diagnosis, asked: str) -> list[str]:
    """Geometry and effects of one session at the poses of another, within the support and beyond.

    A motion of the whole base is fitted to each alike: the tracker was elsewhere.
    """
    data = tracked(asked)
    within = report.model.in_support(data.q)
    cells = [f"{within.mean():.1%}"]
    for rows in (within, ~within):
        if rows.sum() < FEWEST_ROWS:
            cells += ["none", "", ""]
            continue
        q, places = data.q[rows], data.position[rows]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bathyal.SupportWarning)  # that is what is asked
            before, after = (
                bathyal.verify_arm(arm, q, places).rms_after
                for arm in (report.fit.arm, report.model)
            )
        cells += [f"{before * MM:.3f}", f"{after * MM:.3f}", f"{1 - after / before:.0%}"]
    return cells


def stationed_error(
    arm: bathyal.Arm | bathyal.CorrectedArm,
    data: bathyal.Tracked,
    stationing: NDArray[np.bool_],
    covariates: dict[str, float] | None,
) -> float:
    """Of the rows that the site was not stationed by."""
    there = bathyal.verify_arm(
        arm, data.q[stationing], data.position[stationing], covariates=covariates
    ).measured_from_predicted
    keywords = {} if covariates is None else {"covariates": covariates}
    tips = arm.forward(data.q[~stationing], **keywords)[:, :3, 3] @ there[:3, :3].T + there[:3, 3]
    return rms(tips - data.position[~stationing])


def at_site(site: str) -> str:
    """Hilti's geometry and effects of `flat` at another site, stationed by the rows that the site
    itself was stationed by. How its base moved since is not known: it is taken as at the start."""
    report, _ = diagnosed("Hilti flat")
    data, stationing = hilti(site)
    within = report.model.in_support(data.q, covariates=AT_START)
    cells = [site, f"{len(data.q)}", f"{within.mean():.0%}"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bathyal.SupportWarning)
        before, after = (
            stationed_error(arm, data, stationing, covariates)
            for arm, covariates in ((report.fit.arm, None), (report.model, AT_START))
        )
    cells += [f"{before * MM:.2f}", f"{after * MM:.2f}", f"{1 - after / before:.0%}"]
    return f"| {' | '.join(cells)} |"


def lean(site: str) -> str:
    """How fast base and column lean by their own sensors, which diagnosis is not given; what the
    reach and height of the arm do to them is fitted with it."""
    data, _ = hilti(site)
    hours = data.covariates["time"].ravel() / 3600
    height, turn = data.q[:, 0], data.q[:, 1]
    columns_of_site = [np.ones_like(hours), height, np.cos(turn), np.sin(turn)]
    columns_of_site += [height * np.cos(turn), height * np.sin(turn)]
    columns = np.column_stack([hours, *columns_of_site])
    inverse = np.linalg.inv(columns.T @ columns)
    leans = []
    for part, tilt in hilti_tilts(site).items():
        rates = inverse @ columns.T @ np.degrees(tilt)
        left = np.degrees(tilt) - columns @ rates
        std = np.sqrt(inverse[0, 0] * (left**2).sum(axis=0) / (len(hours) - columns.shape[1]))
        axis = int(np.argmax(np.abs(rates[0])))
        leans.append(f"the {part} {rates[0, axis]:.3f} ± {2 * std[axis]:.3f} °/h")
    return f"\nBy its own sensors {site} leans: {', '.join(leans)}."


def two_temperatures(one: str, other: str) -> str:
    """Two sites with their temperatures as sessions of one arm: what growth is named."""
    arm = trailblazer()
    first, second = hilti(one)[0], hilti(other)[0]
    arm_there = bathyal.identify_arm(arm, first).arm
    away = np.linalg.inv(
        bathyal.verify_arm(arm_there, second.q, second.position).measured_from_predicted
    )
    there = second.position @ away[:3, :3].T + away[:3, 3]
    count = len(first), len(second)
    data = bathyal.Tracked(
        np.vstack([first.q, second.q]),
        np.vstack([first.position, there]),
        covariates={
            "temperature": np.repeat([TEMPERATURES[one], TEMPERATURES[other]], count),
            "time": np.concatenate(
                [first.covariates["time"], 1e5 + second.covariates["time"]]
            ).ravel(),
        },
        session=np.repeat([0, 1], count),
    )
    report = bathyal.diagnose(arm, data)
    growth = [e.parameters["expansion"].value for e in report.effects if e.name == "thermal"]
    named = f"growth by {growth[0]:.1e} per kelvin" if growth else "no growth"
    others = [e.words for e in report.effects if e.name in ("base_shift", "tool_change")]
    return f"\n{one} and {other} together: {report.verdict}, {named}; {'; '.join(others)}."


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    transfers = {f"{a}-{b}": (a, b) for a, b in TRANSFERS}
    every = [*RUNS, *transfers, "quarters", "fifths", *SITES]
    parser.add_argument("names", nargs="*", choices=[[], *every], default=[])
    names = parser.parse_args().names or every
    print("## Diagnosis of real arms\n")
    print(
        "| data | rows | verdict | geometry alone, held out | with what is named | within the "
        "others' joint ranges | floor | causes | unexplained (share of the variance) | s |\n|"
        + "---|"
        * 10
    )
    for name in RUNS:
        if name in names:
            print(line(name), flush=True)
    for name in RUNS:
        if name in names:
            print(f"\n- {name}", *causes(name), sep="\n")
    if any(name in names for name in transfers):
        print(
            "\n| taught → asked | within the support | geometry | with effects | below "
            "| beyond it: geometry | with effects | below |\n|" + "---|" * 8
        )
    for name, pair in transfers.items():
        if name in names:
            print(transfer(*pair), flush=True)
    if "quarters" in names:
        print(
            "\n| quarter of A | held out | A → B: within the support | geometry | with effects "
            "| below | beyond it: geometry | with effects | below | s |\n|" + "---|" * 10
        )
        for start in range(4):
            print(quarter(start), flush=True)
    if "fifths" in names:
        print(
            "\n| a fifth left out of the whole diagnosis | geometry | with what is named | the "
            "same without outliers | each fifth | outliers | folds of values alone | s |\n|"
            + "---|"
            * 8
        )
        for series in "CBA":
            print(fifth(series), flush=True)
    if any(name in names for name in SITES):
        print(
            "\n| Hilti flat → | rows | within the support | geometry | with effects | below |\n|"
            + "---|" * 6
        )
    for name in SITES:
        if name in names:
            print(at_site(name), flush=True)
    if "Hilti flat" in names:
        print(lean("flat"), two_temperatures("flat", "outdoor"), sep="\n", flush=True)


if __name__ == "__main__":
    main()
