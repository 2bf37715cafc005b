# SPDX-License-Identifier: BSD-3-Clause
"""bathyal run: a mission from its start to its end."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from bathyal.cli import options as opt
from bathyal.cli.talk import Talk


def run(
    *,
    file: Annotated[Path, typer.Argument(metavar="MISSION", help="A mission, .yaml.")],
    seed: Annotated[int, typer.Option(help="Of all noise.", min=0)] = 1,
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Folder for log and record; made if missing.")
    ] = Path("run"),
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on where a run in that folder was interrupted.")
    ] = False,
    speed: Annotated[
        float | None,
        typer.Option(help="Times real time; as fast as it goes unless given.", show_default=False),
    ] = None,
    replay: Annotated[
        Path | None,
        typer.Option(
            help="Folder of a run whose inputs are taken, in place of the mission's links.",
            show_default=False,
        ),
    ] = None,
    base: Annotated[
        Path | None,
        typer.Option(
            help="A run base: the run is added, and earlier ways lie under its map.",
            show_default=False,
        ),
    ] = None,
    picture: Annotated[
        bool, typer.Option("--picture/--no-picture", help="Draw four views, run.png.")
    ] = True,
    inside: Annotated[
        Path | None,
        typer.Option(
            help="Folder in which the files that it names may lie, in place of its own.",
            show_default=False,
        ),
    ] = None,
    json: opt.Json = False,
    quiet: opt.Quiet = False,
) -> None:
    """Run a mission: the same bytes for the same mission, seed and inputs.

    Writes mission.yaml, log.mcap (opens in Foxglove), run.json and run.png. Waits for programs at
    the mission's links; what they command is recorded.

    [bold]Example:[/]

      bathyal run dive/mission.yaml --seed 1 --out dive/run

      bathyal run dive/mission.yaml --seed 1 --out dive/again --replay dive/run
    """
    from bathyal.mission.files import read_mission
    from bathyal.mission.run import run as run_mission
    from bathyal.mission.run_base import RunBase

    talk = Talk(json=json, quiet=quiet)
    with talk.progress() as progress:
        with progress("Building"):
            given = read_mission(file, inside=inside)
        ports = [] if replay else _ports(given.sections, out)
        with progress(f"Running with programs at {', '.join(ports)}" if ports else "Running"):
            found = run_mission(
                given, seed=seed, out=out, resume=resume, speed=speed, replay=replay
            )
        files = [out / name for name in ("mission.yaml", "log.mcap", "run.json")]
        if ports or speed is not None:
            files.append(out / "links.json")
        known = None if base is None else RunBase(base)
        if picture:
            with progress("Drawing"):
                found.plot(out / "run.png", earlier=known.ways() if known else ())
            files.append(out / "run.png")
        if known:
            known.add_folder(out)
    names = [str(path) for path in files]
    events = [
        f"{event.time:8.1f} s  {event.kind}: {event.text}"
        for event in found.events
        if event.kind in ("fault", "report", "guard", "mark", "end")
    ]
    facts = {"status": found.status, "seed": seed, **found.metrics}
    rows: dict[str, str] = {
        "status": found.status,
        "duration": f"{found.metrics['duration']:.1f} s",
        "way": f"{found.metrics['distance']:.1f} m, to {found.metrics['deepest']:.1f} m deep",
        "position error": (
            f"rms {found.metrics['position_rms']:.2f} m, worst "
            f"{found.metrics['position_worst']:.2f} m"
        ),
        "energy": f"{found.metrics['energy_wh']:.1f} Wh",
        "events": "\n".join(events),
        "written": "\n".join(names),
    }
    talk.result({**facts, "events": [vars(event) for event in found.events], "files": names}, rows)


def _ports(sections: Any, out: Path) -> list[str]:
    """Where programs find the vehicle."""
    return [str(link.path(out)) if link.where == "pty" else link.where for link in sections.links]
