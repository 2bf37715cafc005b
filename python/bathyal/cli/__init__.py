# SPDX-License-Identifier: BSD-3-Clause
"""The command line: bathyal plan · triangulate · info · soundings · identify · diagnose · touches ·
check · reach · sample · scenario · profile ·
world · survey · xtf · mission · run."""

from __future__ import annotations

from importlib.metadata import version
from typing import Annotated

import typer

from bathyal.cli.check import check
from bathyal.cli.diagnose import diagnose
from bathyal.cli.groups import spread
from bathyal.cli.identify import identify
from bathyal.cli.info import info
from bathyal.cli.mission import mission
from bathyal.cli.plan import plan
from bathyal.cli.profile import profile
from bathyal.cli.reach import reach
from bathyal.cli.run import run
from bathyal.cli.runs import add, compare, list_runs, query, show
from bathyal.cli.sample import sample
from bathyal.cli.scenario_example import example as example_scenario
from bathyal.cli.soundings import soundings
from bathyal.cli.survey import survey
from bathyal.cli.talk import Commands
from bathyal.cli.touches_example import example
from bathyal.cli.touches_plan import plan as plan_of_touches
from bathyal.cli.triangulate import triangulate
from bathyal.cli.world import world
from bathyal.cli.xtf import xtf

_EXIT_CODES = (
    "Exit codes: 0 done (warnings are printed, they do not fail a job), 1 the job failed or a file "
    "is broken, 2 wrong usage, 3 the arm may not do what was asked (check, sample), "
    "130 interrupted (Ctrl-C), 143 terminated (SIGTERM)."
)

app = typer.Typer(
    name="bathyal",
    cls=Commands,
    rich_markup_mode="rich",
    add_completion=False,
    pretty_exceptions_enable=False,
    epilog=_EXIT_CODES,
)
for command in (
    plan, triangulate, info, soundings, identify, diagnose, check, reach, sample, profile, world,
    survey, xtf, mission, run,
):  # fmt: skip
    app.command(epilog=_EXIT_CODES)(spread(command))

touches = typer.Typer(rich_markup_mode="rich", no_args_is_help=True)
for verb in (example, plan_of_touches):
    touches.command(epilog=_EXIT_CODES)(spread(verb))
app.add_typer(
    touches,
    name="touches",
    help="Plans and tables of touches, for `bathyal identify` and `diagnose`.",
)

scenario = typer.Typer(rich_markup_mode="rich", no_args_is_help=True)
scenario.command(epilog=_EXIT_CODES)(spread(example_scenario))
scenario.callback()(lambda: None)  # a group, though it has one verb
app.add_typer(
    scenario,
    name="scenario",
    help="Scenarios of an arm on its vehicle, for `bathyal check`, `reach` and `sample`.",
)

runs = typer.Typer(rich_markup_mode="rich", no_args_is_help=True)
for run_verb in (add, show, compare, query):
    runs.command(epilog=_EXIT_CODES)(spread(run_verb))
runs.command("list", epilog=_EXIT_CODES)(spread(list_runs))
app.add_typer(runs, name="runs", help="The run base: what runs were made of and how they ended.")


@app.callback(invoke_without_command=True)
def main(
    context: typer.Context,
    show_version: Annotated[bool, typer.Option("--version", help="Say the version.")] = False,
    debug: Annotated[
        bool, typer.Option("--debug", help="Show where in the program an error came from.")
    ] = False,
) -> None:
    """From soundings and camera axes to an oriented tool path along the bottom, from touches to
    the arm that is to follow it, and from a scenario to the motion that takes a sample.

    [bold]Try it:[/]

      bathyal soundings survey.xyz --aims-out aims.csv

      bathyal plan survey.xyz --aims aims.csv --out plan

      bathyal touches example touches.csv --arm ur10e

      bathyal identify touches.csv --arm ur10e --known-distance left,right=350mm --out found

      bathyal diagnose touches.csv --arm ur10e --known-distance left,right=350mm --out diagnosis

      bathyal scenario example scene

      bathyal check scene/scenario.yaml

      bathyal sample scene/scenario.yaml --out sample

      bathyal world sea/world.yaml --example

      bathyal survey sea/world.yaml --track sea/track.csv --speed 2 --out sea/survey

      bathyal xtf sea/survey/survey.xtf --out sea/image

      bathyal mission dive/mission.yaml --example

      bathyal run dive/mission.yaml --out dive/run
    """
    if show_version:
        typer.echo(f"bathyal {version('bathyal')}")
        raise typer.Exit
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())
