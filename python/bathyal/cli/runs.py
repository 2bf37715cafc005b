# SPDX-License-Identifier: BSD-3-Clause
"""bathyal runs add · list · show · compare · query: what a run base holds."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk

Base = Annotated[Path, typer.Argument(metavar="BASE", help="The run base, .db.")]
Number = Annotated[int, typer.Argument(metavar="ID", help="A run's number.")]


def add(
    *,
    base: Annotated[Path, typer.Argument(metavar="BASE", help="The run base; made if missing.")],
    folders: Annotated[
        list[Path], typer.Argument(metavar="FOLDER...", help="What bathyal run wrote.")
    ],
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Add runs that have ended.

    [bold]Example:[/]

      bathyal runs add runs.db dive/run
    """
    from bathyal.mission.run_base import RunBase

    opened = RunBase(base)
    added = {str(folder): opened.add_folder(folder) for folder in folders}
    rows = {str(number): folder for folder, number in added.items()}
    Talk(json=json, quiet=quiet).result({"added": added}, rows)


def list_runs(*, base: Base, json: opt.Json = False, quiet: opt.Quiet = False) -> None:
    """List all runs.

    [bold]Example:[/]

      bathyal runs list runs.db
    """
    _say(Talk(json=json, quiet=quiet), existing_base(base).list())


def query(
    *,
    base: Base,
    text: Annotated[str, typer.Argument(metavar="QUERY", help="A condition.")],
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """List the runs for which a condition holds.

    Compares metric NAME, id, seed and duration with numbers, name, status, folder and
    scenario_sha256 with quoted texts; event = 'KIND', fault = 'DEVICE'; and, or, not, parentheses.

    [bold]Example:[/]

      bathyal runs query runs.db "metric position_rms < 1 and status = 'done'"
    """
    _say(Talk(json=json, quiet=quiet), existing_base(base).query(text))


def show(*, base: Base, number: Number, json: opt.Json = False, quiet: opt.Quiet = False) -> None:
    """Show a run: how it ended, its metrics and events.

    [bold]Example:[/]

      bathyal runs show runs.db 1
    """
    run = existing_base(base).show(number)
    data = {
        "name": run.name,
        "seed": run.seed,
        "status": run.status,
        "metrics": run.metrics,
        "events": [asdict(event) for event in run.events],
        "versions": run.versions,
        "scenario_sha256": run.scenario_sha256,
        "folder": str(run.log.path.parent),
    }
    rows = {name: str(data[name]) for name in ("name", "seed", "status", "folder")}
    rows |= {name: f"{value:.6g}" for name, value in run.metrics.items()}
    rows["events"] = "\n".join(_event(event) for event in run.events)
    Talk(json=json, quiet=quiet).result(data, rows)


def compare(
    *,
    base: Base,
    first: Number,
    second: Annotated[int, typer.Argument(metavar="ID", help="Another one's.")],
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Compare two runs: metrics, events, the first message of their logs that differs.

    [bold]Example:[/]

      bathyal runs compare runs.db 1 2
    """
    talk = Talk(json=json, quiet=quiet)
    found = existing_base(base).compare(first, second)
    at = found.first_difference
    where = "none" if at is None else f"{at.time:g} s, {at.topic} {at.field}".rstrip()
    rows = {"the same": "yes" if found.same else "no"}
    if not found.note:
        rows["first difference"] = where
    rows |= {name: f"{one:.6g}, {two:.6g}" for name, (one, two) in found.metrics.items()}
    for name, events in (("first", found.only_first), ("second", found.only_second)):
        if events:
            rows[f"events of the {name}"] = "\n".join(_event(event) for event in events)
    if found.note:
        talk.warn([f"the logs are not compared: {found.note}"])
    talk.result({"same": found.same, **asdict(found)}, rows)


def existing_base(base: Path) -> Any:
    """A base that is read must be there: a mistyped name makes no file."""
    from bathyal.mission.run_base import RunBase

    if not base.is_file():
        raise FileNotFoundError(2, "no such run base", str(base))
    return RunBase(base)


def _say(talk: Talk, runs: list[Any]) -> None:
    rows = {
        str(run.id): f"{run.name}, seed {run.seed}: {run.status} after {run.duration:.6g} s"
        for run in runs
    }
    talk.result({"runs": [asdict(run) for run in runs]}, rows or {"runs": "none"})


def _event(event: Any) -> str:
    return f"{event.time:8.1f} s  {event.kind} {event.text}"
