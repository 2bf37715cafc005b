# SPDX-License-Identifier: BSD-3-Clause
"""A soil sample from a scenario to files: what `bathyal sample` does."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Workspace
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, known_suffix
from bathyal.io.json import json_text
from bathyal.io.provenance import Step
from bathyal.io.result_sets import filling
from bathyal.io.tables import write_table
from bathyal.view.brief import Brief
from bathyal.view.motion import Motion
from bathyal.workspace.joint_trajectory import write_joint_trajectory
from bathyal.workspace.motion import Phase, motion_of
from bathyal.workspace.scenario import Scenario

if TYPE_CHECKING:
    from bathyal._core import SamplingPlan

Floats = NDArray[np.float64]

FRAMES = 12
_TOUCHING = ("press", "grab", "lift")
_SHORT = {
    "start": "Refused: the arm may not begin, or end, where it is asked to.",
    "forbidden": "Refused: the target is where the tool may not be.",
    "unreachable": "Not found: the tool does not reach the target.",
    "collision": "Refused: the target is reached only by touching something.",
    "no_bottom": "Not found: there is no bottom at the target.",
    "no_approach": "Not found: no motion to the target.",
    "no_transport": "Not found: no motion away from the target with the sample.",
    "no_retreat": "Refused: there is no safe way back.",
}
_NEXT = {
    "start": "Choose another q_start: in arm, q_start_deg.",
    "forbidden": "Choose another target: bathyal check lists them.",
}


@dataclass(frozen=True)
class Sampled:
    """A plan to take a sample and what it was made from; `write` makes the files of
    `bathyal sample`.

    Attributes
    ----------
    scenario : Scenario
    row : int
        Of the target.
    plan : SamplingPlan
    """

    scenario: Scenario
    row: int
    plan: SamplingPlan

    @property
    def planned(self) -> bool:
        """Whether there is a motion."""
        return bool(self.plan.phases)

    @property
    def summary(self) -> dict[str, Any]:
        """Numbers for programs, SI units in the names."""
        plan, name = self.plan, self.scenario.target_names[self.row]
        known: dict[str, Any] = {
            "format": "bathyal sample",
            "bathyal": version("bathyal"),
            "scenario": self.scenario.name,
            "target": name,
            "target_m": self.scenario.targets[self.row],
            "status": plan.status,
            "reason": plan.reason,
            "joints": list(self.scenario.arm.joint_names),
            "warnings": self.scenario.warnings,
        }
        if not self.planned:
            return known
        wrench, lowest = np.asarray(plan.wrench), clearances(self.scenario.workspace, plan)
        return known | {
            "seconds": float(plan.time[-1] - plan.time[0]),
            "phases": [
                {
                    "name": phase.name,
                    "begin_s": float(phase.time[0]),
                    "end_s": float(phase.time[-1]),
                    "rows": len(phase.time),
                    "clearance_m": float(np.min(lowest[name_rows(plan, k)])),
                }
                for k, phase in enumerate(plan.phases)
            ],
            "clearance_m": float(np.min(lowest)),
            "contact_m": plan.contact,
            "depth_m": float(plan.depth),
            "contact_force_N": float(np.max(plan.contact_force)),
            "force_low_N": wrench[:, :3].min(axis=0),
            "force_high_N": wrench[:, :3].max(axis=0),
            "moment_low_Nm": wrench[:, 3:].min(axis=0),
            "moment_high_Nm": wrench[:, 3:].max(axis=0),
        }

    @property
    def brief(self) -> Brief:
        """The plan at first sight."""
        known = self.summary
        if not self.planned:
            return Brief(
                _SHORT.get(self.plan.status, f"Refused: {self.plan.status}."),
                {"target": known["target"], "reason": self.plan.reason},
                _NEXT.get(self.plan.status, "See where the arm reaches: bathyal reach."),
            )
        low, high = known["moment_low_Nm"], known["moment_high_Nm"]
        most = int(np.argmax(np.maximum(np.abs(low), np.abs(high))[:2]))
        axis = ("roll", "pitch")[most]
        return Brief(
            f"Planned: a sample at {known['target']} in {known['seconds']:.1f} s.",
            {
                "phases": ", ".join(
                    f"{one['name']} {one['end_s'] - one['begin_s']:.1f} s"
                    for one in known["phases"]
                ),
                "clearance": f"{known['clearance_m']:.3f} m at least",
                "press": f"{1e3 * known['depth_m']:.0f} mm deep, {known['contact_force_N']:.0f} N",
                "on the vehicle": f"{axis} moment {low[most]:.1f} to {high[most]:.1f} N m".replace(
                    "-", "−"
                ),
            },
            "Watch the motion: open motion.html.",
        )

    def motion(self) -> Motion:
        """The plan as pictures and pages take it."""
        brief = self.brief
        return motion_of_plan(
            self.scenario.workspace,
            self.plan,
            target=self.scenario.targets[self.row],
            title=f"{self.scenario.name}: {brief.verdict.removeprefix('Planned: ')}",
            facts=brief.numbers,
            warnings=self.scenario.warnings,
        )

    def write(
        self, folder: PathLike, *, frames: int = FRAMES, step: Step | None = None
    ) -> list[Path]:
        """Write motion.csv, motion.html, motion.png, trajectory.yaml and summary.json, and pictures
        of the motion into frames/.

        The folder gets all of them or none, a manifest with their hashes last; so does frames/.
        Where nothing was planned there is summary.json only.

        Parameters
        ----------
        folder : path
            Made where it is missing.
        frames : int
            How many pictures, 0 for none.
        step : callable, optional
            ``with step("Writing …"):`` is put around each stage, for progress.

        Returns
        -------
        list of pathlib.Path
            Without the pictures.

        Raises
        ------
        OSError
            Where a file cannot be written.
        """
        from bathyal.view.motion_frames import write_frames, write_sheet
        from bathyal.view.motion_page import write_motion_page

        step = step or nullcontext
        folder = Path(folder)
        motion = self.motion() if self.planned else None
        with filling(folder, "sample") as aside:
            (aside / "summary.json").write_text(json_text(self.summary), encoding="utf-8")
            if motion is not None:
                with step("Writing the motion"):
                    write_motion_table(self.scenario.workspace, self.plan, aside / "motion.csv")
                    write_joint_trajectory(
                        aside / "trajectory.yaml", self.plan.q, self.plan.time,
                        self.scenario.arm,
                    )  # fmt: skip
                with step("Drawing the page"):
                    write_motion_page(motion, aside / "motion.html")
                with step("Drawing the sheet"):
                    write_sheet(motion, aside / "motion.png")
            names = sorted(file.name for file in aside.iterdir())
        if frames and motion is not None:
            with step("Drawing the frames"), filling(folder / "frames", "sample") as aside:
                write_frames(motion, aside, count=frames)
        return [folder / name for name in names]


def sample(scenario: Scenario, target: str | int | None = None, **options: Any) -> Sampled:
    """Plan to take a sample at a target of a scenario.

    Parameters
    ----------
    scenario : Scenario
    target : str or int, optional
        By its name or row; the scenario's own choice unless given.
    **options
        Of `bathyal.plan_sampling`, in place of those of the file.

    Returns
    -------
    Sampled

    Raises
    ------
    ValueError
        For a scenario without targets, or no such target; as `bathyal.plan_sampling`.
    """
    from bathyal._core import plan_sampling

    row = scenario.row_of(target)
    if row < 0:
        raise argument_error("target", "one in the scenario's targets", "none")
    keywords: dict[str, Any] = {"q_start": scenario.q_start, **scenario.sampling, **options}
    return Sampled(
        scenario, row, plan_sampling(scenario.workspace, scenario.targets[row], **keywords)
    )


def name_rows(plan: SamplingPlan, phase: int) -> slice:
    """The rows of `plan.q` that are a phase's, its first and last among them."""
    one = plan.phases[phase]
    return slice(one.first, one.first + len(one.time))


def phases_of(plan: SamplingPlan) -> list[Phase]:
    """Phases with their times, as `motion_of` takes them."""
    return [
        Phase(one.name, float(one.time[0]), float(one.time[-1]), one.name in _TOUCHING)
        for one in plan.phases
    ]


def clearances(workspace: Workspace, plan: SamplingPlan) -> Floats:
    """(T,) distance to what must not be touched [m]; where the tool is to touch the bottom, of all
    the rest of the arm."""
    q, time = np.asarray(plan.q), np.asarray(plan.time)
    distance = np.empty(len(q))
    touching = np.zeros(len(q), bool)
    for k, phase in enumerate(plan.phases):
        touching[name_rows(plan, k)] |= phase.name in _TOUCHING
    for contact in (False, True):
        rows = np.flatnonzero(touching == contact)
        if len(rows):
            near = workspace.clearance(q[rows], time=time[rows], tip_contact=contact)
            distance[rows] = np.minimum(near.distance, near.self_distance)
    return distance


def motion_of_plan(
    workspace: Workspace, plan: SamplingPlan, *, target: Any = None, **words: Any
) -> Motion:
    """A sampling plan as pictures take it; `words` as `motion_of`.

    Raises
    ------
    ValueError
        For a plan without phases.
    """
    if not plan.phases:
        raise argument_error("plan", "a plan with phases", f"status {plan.status!r}")
    return motion_of(
        workspace, np.asarray(plan.q), plan.time, wrench=plan.wrench, phases=phases_of(plan),
        target=plan.contact if target is None else target, **words,
    )  # fmt: skip


def write_plan(workspace: Workspace, plan: SamplingPlan, path: PathLike) -> None:
    """Write a plan by the suffix of the file; what `SamplingPlan.write` does."""
    from bathyal.view.motion_frames import write_sheet
    from bathyal.view.motion_page import write_motion_page

    suffix = known_suffix(path, (".csv", ".html", ".json", ".png", ".yaml", ".yml"), "plan's")
    motion = motion_of_plan(workspace, plan)  # refuses a plan without phases
    if suffix == ".html":
        write_motion_page(motion, path)
    elif suffix == ".png":
        write_sheet(motion, path)
    elif suffix == ".csv":
        write_motion_table(workspace, plan, path)
    else:
        write_joint_trajectory(path, plan.q, plan.time, workspace.arm)


def write_motion_table(workspace: Workspace, plan: SamplingPlan, path: PathLike) -> None:
    """Write a plan as .csv, one row a time, units in the header: joints, the tip in the vehicle's
    frame, the wrench on the vehicle, clearance."""
    arm = workspace.arm
    units = ["m" if kind == "prismatic" else "rad" for kind in arm.joint_types]
    q = np.asarray(plan.q)
    tip = np.asarray(arm.forward(q))[:, :3, 3]
    names: list[str] = [""] * len(q)
    for k, phase in enumerate(plan.phases):
        rows = name_rows(plan, k)
        names[rows] = [phase.name] * (rows.stop - rows.start)
    titles: Sequence[str] = [
        "time_s", "phase", *(f"{n}_{u}" for n, u in zip(arm.joint_names, units, strict=True)),
        "tip_x_m", "tip_y_m", "tip_z_m", "force_x_N", "force_y_N", "force_z_N", "moment_x_Nm",
        "moment_y_Nm", "moment_z_Nm", "contact_force_N", "clearance_m",
    ]  # fmt: skip
    columns = np.column_stack(
        [q, tip, plan.wrench, plan.contact_force, clearances(workspace, plan)]
    )
    rows_out = (
        [moment, name, *values]
        for moment, name, values in zip(
            np.asarray(plan.time).tolist(), names, columns.tolist(), strict=True
        )
    )
    write_table(path, titles, rows_out)
