# SPDX-License-Identifier: BSD-3-Clause
"""The sections of a mission's YAML file, as models: what keys there are, and their units.

Numbers are SI, or carry a unit: ``5 m``, ``0.5 m/s``, ``7 min``, ``20 deg``. In the world z
is up; headings count from x towards y.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, model_validator

from bathyal.io.yaml_sections import (
    FileName,
    Name,
    NotNegative,
    Number,
    PoseSection,
    Positive,
    Section,
    Vector,
    one_of,
)
from bathyal.mission.quantities import (
    Angle,
    Metres,
    NotNegativeMetres,
    PositiveMetres,
    PositiveSeconds,
    Rate,
    Seconds,
    Speed,
)
from bathyal.onboard.sections import OnboardSections
from bathyal.vehicle.sections import VehicleSections
from bathyal.world.sections import WorldSections

Point = tuple[Metres, Metres]
ConditionText = Annotated[str, Field(min_length=1, max_length=1000)]

COMMANDS = (
    "wait",
    "dive",
    "leg",
    "follow",
    "survey",
    "hold",
    "sample",
    "ping",
    "photo",
    "surface",
    "drop_weight",
    "check",
    "stop",
)
FLOWS = ("sequence", "fallback", "parallel", "retry", "timeout", "invert")


class HeightSection(Section):
    """A depth below the surface, or an altitude above the bottom."""

    depth: NotNegativeMetres | None = None
    altitude: PositiveMetres | None = None

    @model_validator(mode="after")
    def _one_height(self) -> HeightSection:
        one_of(self, "depth", "altitude")
        return self


class WaitSection(Section):
    """Stays where it is."""

    time: Seconds


class DiveSection(HeightSection):
    """Goes down or up where it is."""

    tolerance: PositiveMetres = 0.3

    @model_validator(mode="after")
    def _a_height(self) -> DiveSection:
        one_of(self, "depth", "altitude", needed=True)
        return self


class LegSection(HeightSection):
    """A straight line from where it is."""

    to: Point
    speed: Speed = 0.5
    heading: Angle | None = None
    tolerance: PositiveMetres = 1.0


class FollowSection(HeightSection):
    """Straight lines through points."""

    points: Annotated[list[Point], Field(min_length=1, max_length=100_000)]
    speed: Speed = 0.5
    heading: Angle | None = None
    tolerance: PositiveMetres = 1.0


class SurveySection(HeightSection):
    """Parallel lines over a rectangle, from a corner; its length along `heading`."""

    corner: Point = (0.0, 0.0)
    size: tuple[PositiveMetres, PositiveMetres]
    spacing: PositiveMetres
    heading: Angle = 0.0
    speed: Speed = 0.5
    tolerance: PositiveMetres = 1.0


class HoldSection(HeightSection):
    """Keeps a place, or the one where it is, for a time."""

    time: Seconds
    at: Point | None = None
    heading: Angle | None = None


class SampleSection(Section):
    """Takes a soil sample as a scenario says, its arm's wrench acting on the vehicle meanwhile."""

    scenario: FileName
    target: Annotated[int, Field(strict=True, ge=0)] | None = None
    tolerance: PositiveMetres = 0.5


class MarkSection(Section):
    """A moment that is recorded: a ping, a photo."""

    name: Name | None = None


class SurfaceSection(Section):
    """Comes up."""

    tolerance: PositiveMetres = 0.4


class EmptySection(Section):
    """No options."""


def _named(value: Any) -> Any:
    """``surface`` is ``surface: {}``, and a list a sequence."""
    if isinstance(value, str):
        return {value: {}}
    return {"sequence": value} if isinstance(value, list) else value


class StepSection(Section):
    """One command, or some of them in an order."""

    wait: WaitSection | None = None
    dive: DiveSection | None = None
    leg: LegSection | None = None
    follow: FollowSection | None = None
    survey: SurveySection | None = None
    hold: HoldSection | None = None
    sample: SampleSection | None = None
    ping: MarkSection | None = None
    photo: MarkSection | None = None
    surface: SurfaceSection | None = None
    drop_weight: EmptySection | None = None
    check: ConditionText | None = None
    stop: EmptySection | None = None
    sequence: list[Step] | None = None
    fallback: list[Step] | None = None
    parallel: list[Step] | None = None
    retry: RetrySection | None = None
    timeout: TimeoutSection | None = None
    invert: Step | None = None

    @model_validator(mode="after")
    def _one_step(self) -> StepSection:
        one_of(self, *COMMANDS, *FLOWS, needed=True)
        return self

    def kind(self) -> str:
        """Which one is given."""
        found = one_of(self, *COMMANDS, *FLOWS, needed=True)
        assert found is not None
        return found


Step = Annotated[StepSection, BeforeValidator(_named)]


class RetrySection(Section):
    """Again, until it has failed so many times."""

    times: Annotated[int, Field(strict=True, ge=1, le=1_000_000)]
    do: Step


class TimeoutSection(Section):
    """Fails when it takes longer."""

    after: PositiveSeconds
    do: Step


class GuardSection(Section):
    """What is watched all the time: once it has held for `persist`, the mission stops and this runs
    instead."""

    name: Name
    when: ConditionText
    persist: Seconds = 0.0
    do: Step


class SensorSection(Section):
    """A sensor, as `bathyal.Sensor` takes it."""

    kind: Name
    name: Name | None = None
    rate: Positive | None = None
    latency: Seconds | None = None
    dropout: Annotated[Number, Field(ge=0, le=1)] | None = None
    range: PositiveMetres | None = None
    sound_speed: Positive | None = None
    pose: PoseSection | None = None
    beacons: list[Vector] | None = None
    noise: NotNegative | list[NotNegative] | None = None
    bias: NotNegative | list[NotNegative] | None = None
    scale: NotNegative | list[NotNegative] | None = None
    walk: NotNegative | list[NotNegative] | None = None
    markov: NotNegative | list[NotNegative] | None = None
    markov_time: NotNegative | list[NotNegative] | None = None
    outlier_rate: NotNegative | list[NotNegative] | None = None
    outlier_size: NotNegative | list[NotNegative] | None = None
    quantum: NotNegative | list[NotNegative] | None = None


class FaultSection(Section):
    """What breaks: at a time, once a condition holds, or at a mean rate."""

    device: Name
    kind: Literal[
        "off",
        "stuck",
        "garbage",
        "wrong",
        "slow",
        "delayed",
        "intermittent",
        "bias",
        "drift",
        "noise",
        "dead",
        "weak",
        "reversed",
        "sag",
        "leak",
        "lost",
    ]
    size: Number = 0.0
    at: Seconds | None = None
    when: ConditionText | None = None
    rate: Rate | None = None
    lasts: PositiveSeconds | None = None

    @model_validator(mode="after")
    def _one_start(self) -> FaultSection:
        one_of(self, "at", "when", "rate", needed=True)
        return self


class WeightSection(Section):
    """Ballast that `drop_weight` lets go."""

    name: Name = "drop weight"
    mass: Positive
    volume: NotNegative = 0.0
    position: Vector = (0.0, 0.0, 0.0)


class MissionVehicle(VehicleSections):
    """The vehicle, and its devices, which are those of the preset `devices`."""

    devices: Literal["bluerov2_heavy", "remus100"] | None = None
    hotel_power: NotNegative = 20.0
    weights: list[WeightSection] = []


class NavigationSection(Section):
    """What the navigation filter takes for granted: see `bathyal.NavigationFilter`."""

    gyro_noise: NotNegative | None = None
    log_noise: NotNegative | None = None
    log_walk: NotNegative | None = None
    log_scale: NotNegative | None = None
    gate: Annotated[Number, Field(ge=0.5, le=1.0)] | None = None
    lag: Seconds | None = None


class MissionSections(OnboardSections):
    """A mission."""

    name: Name = "mission"
    world: WorldSections | FileName
    vehicle: MissionVehicle
    start: PoseSection = PoseSection()
    sensors: Annotated[list[SensorSection], Field(max_length=100)] | None = None
    navigation: NavigationSection = NavigationSection()
    faults: Annotated[list[FaultSection], Field(max_length=1000)] = []
    always: Annotated[list[GuardSection], Field(max_length=100)] = []
    mission: Step
    step: Annotated[Number, Field(gt=0, le=0.1)] = 0.02
    steps_per_tick: Annotated[int, Field(strict=True, ge=1, le=1000)] = 5
    longest: PositiveSeconds = 4 * 3600.0


StepSection.model_rebuild()
RetrySection.model_rebuild()
TimeoutSection.model_rebuild()
