# SPDX-License-Identifier: BSD-3-Clause
"""A mission from the sections of its file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal import _core
from bathyal._core import DropWeight, MissionPlan, Sensor, Vehicle, VehicleSystem, World
from bathyal.io.yaml_documents import Place
from bathyal.mission import sections as own
from bathyal.vehicle.files import VehicleBuilder, warn_of_weight
from bathyal.world.build import WorldBuilder
from bathyal.world.files import read_world

Array = NDArray[np.float64]


class MissionBuilder(VehicleBuilder):
    """One document's mission."""

    def __init__(self, document: Any, inside: Any) -> None:
        super().__init__(document, inside)
        self.inside = inside
        self.commands: list[dict[str, Any]] = []

    def plan(self, sections: own.MissionSections) -> tuple[MissionPlan, World]:
        """The whole mission, and the world that it is in."""
        world = self.world(sections)
        system = self.system(sections.vehicle)
        vehicle = self.own_vehicle(sections.vehicle)
        sensors = self.sensors(sections.sensors)
        tree = self.step(sections.mission, ("mission",))
        guards = [self.guard(one, ("always", row)) for row, one in enumerate(sections.always)]
        faults = [one.model_dump(exclude_none=True) for one in sections.faults]
        with self.placed_by_row():
            plan = MissionPlan(
                name=sections.name,
                system=system,
                vehicle=vehicle,
                weights=[DropWeight(**one.model_dump()) for one in sections.vehicle.weights],
                hotel_power=sections.vehicle.hotel_power,
                world=world,
                sensors=sensors,
                navigation=sections.navigation.model_dump(exclude_none=True),
                start=sections.start.matrix(),
                commands=self.commands,
                tree=tree,
                guards=guards,
                faults=faults,
                step=sections.step,
                steps_per_tick=sections.steps_per_tick,
                longest=sections.longest,
            )
        weights = sum(one.mass for one in sections.vehicle.weights)
        volumes = sum(one.volume for one in sections.vehicle.weights)
        warn_of_weight(vehicle or system.vehicle, mass=weights, volume=volumes)
        return plan, world

    @contextmanager
    def placed_by_row(self) -> Iterator[None]:
        """Puts an error where its row is: "faults[2]: …" at the third fault."""
        try:
            yield
        except ValueError as error:
            row = re.match(r"`?(faults|always)\[(\d+)\]", str(error))
            with self.placed((row[1], int(row[2])) if row else ()):
                raise

    def world(self, sections: own.MissionSections) -> World:
        """In the document, or from a file of its own."""
        if isinstance(sections.world, str):
            path = self.file(sections.world, ("world",))
            with self.placed(("world",)):
                return read_world(path, inside=self.within)
        builder = WorldBuilder(self.document, self.inside)
        builder.root = ("world",)
        return builder.world(sections.world)

    def system(self, section: own.MissionVehicle) -> VehicleSystem:
        """The devices: those of `devices`, or of the preset."""
        name = section.devices or section.preset
        with self.placed(("vehicle",)):
            if name is None:
                raise ValueError("expected a preset, or devices of one, got neither")
            if name == "remus100":
                return VehicleSystem.remus100(equal_cross_flow=True)
            return VehicleSystem.bluerov2_heavy()

    def own_vehicle(self, section: own.MissionVehicle) -> Vehicle | None:
        """The vehicle, where its section says more than a preset's name."""
        keys = {"preset", "devices", "hotel_power", "weights"}
        if section.preset is not None and not section.model_fields_set - keys:
            return None
        return self.vehicle(section, ("vehicle",))

    def sensors(self, sections: list[own.SensorSection] | None) -> list[Sensor]:
        """As given, or what is typical."""
        if sections is None:
            return _core.typical_sensors()
        sensors = []
        names: set[str] = set()
        for row, one in enumerate(sections):
            with self.placed(("sensors", row)):
                if (name := one.name or one.kind) in names:
                    raise ValueError(f"name: expected names that differ, got {name!r} again")
                names.add(name)
            given = one.model_dump(exclude_none=True, exclude={"pose"})
            if one.pose is not None:
                given["vehicle_from_sensor"] = one.pose.matrix()
            with self.placed(("sensors", row)):
                sensors.append(Sensor(given.pop("kind"), **given))
        return sensors

    def guard(self, section: own.GuardSection, place: Place) -> dict[str, Any]:
        response = self.step(section.do, (*place, "do"))
        return {
            "name": section.name,
            "when": section.when,
            "persist": section.persist,
            "response": response,
        }

    def step(self, step: own.StepSection, place: Place) -> dict[str, Any]:
        """A node of the tree, its commands numbered."""
        kind = step.kind()
        inner = (*place, kind) if (*place, kind) in self.document.marks else place
        given = getattr(step, kind)
        if kind in ("sequence", "fallback", "parallel"):
            steps = [self.step(one, (*inner, row)) for row, one in enumerate(given)]
            return {"kind": kind, "children": steps}
        if kind == "retry":
            child = self.step(given.do, (*inner, "do"))
            return {"kind": kind, "count": given.times, "children": [child]}
        if kind == "timeout":
            child = self.step(given.do, (*inner, "do"))
            return {"kind": kind, "time": given.after, "children": [child]}
        if kind == "invert":
            return {"kind": kind, "children": [self.step(given, inner)]}
        self.commands.append(self.command(kind, given, inner))
        return {"kind": "leaf", "name": kind, "command": len(self.commands) - 1}

    def command(self, kind: str, given: Any, place: Place) -> dict[str, Any]:
        """What the engine takes."""
        if kind == "check":
            return {"kind": "check", "name": f"check {given}", "condition": given}
        values: dict[str, Any] = given.model_dump(exclude_none=True)
        if kind in ("ping", "photo"):
            return {"kind": "mark", "name": " ".join(filter(None, (kind, given.name)))}
        if kind == "leg":
            values["points"] = [values.pop("to")]
            kind, name = "follow", "leg"
        elif kind == "survey":
            with self.placed(place):
                points = survey_points(given)
            values = {
                "points": points,
                **{
                    key: values[key]
                    for key in ("depth", "altitude", "speed", "tolerance")
                    if key in values
                },
            }
            kind, name = "follow", "survey"
        elif kind == "sample":
            values, name = self.sample(given, place), "sample"
        else:
            name = kind
        if "at" in values:
            values["points"] = [values.pop("at")]
        return {"kind": kind, "name": name, **values}

    def sample(self, given: own.SampleSection, place: Place) -> dict[str, Any]:
        """The wrench of the sample that the scenario's arm takes, beyond that at its start, with
        which the vehicle is in trim."""
        from bathyal._core import plan_sampling
        from bathyal.workspace.scenario import read_scenario

        path = self.file(given.scenario, (*place, "scenario"))
        with self.placed((*place, "scenario")):
            scenario = read_scenario(path, inside=self.within)
            row = scenario.sampled if given.target is None else given.target
            if not 0 <= row < len(scenario.targets):
                raise ValueError(f"expected the row of a target below {len(scenario.targets)}")
            plan = plan_sampling(scenario.workspace, scenario.targets[row], **scenario.sampling)
            if not plan:
                raise ValueError(f"the sample cannot be taken: {plan.status}")
            # The same motion: what the sample weighs changes no plan.
            weightless = scenario.sampling | {"sample": None}
            empty = plan_sampling(scenario.workspace, scenario.targets[row], **weightless)
        return {
            "wrench_time": plan.time,
            "wrench": plan.wrench - plan.wrench[0],
            "empty_wrench": empty.wrench - plan.wrench[0],
            "tolerance": given.tolerance,
        }


def survey_points(section: own.SurveySection) -> list[tuple[float, float]]:
    """Corners of parallel lines, there and back.

    Examples
    --------
    >>> from bathyal.mission.sections import SurveySection
    >>> survey_points(SurveySection(size=(10.0, 4.0), spacing=4.0))
    [(0.0, 0.0), (10.0, 0.0), (10.0, 4.0), (0.0, 4.0)]
    """
    length, width = section.size
    count = int(np.floor(width / section.spacing + 1e-9)) + 1
    if count > 50_000:
        raise ValueError(f"expected at most 50000 lines, got {count}")
    along, across = np.zeros((count, 2)), np.arange(count) * section.spacing
    along[:, 1] = length
    along[1::2] = along[1::2, ::-1]
    local = np.stack([along.ravel(), np.repeat(across, 2)], axis=1)
    cos, sin = np.cos(section.heading), np.sin(section.heading)
    points = local @ np.array([[cos, sin], [-sin, cos]]) + np.asarray(section.corner)
    return [(float(x), float(y)) for x, y in points]
