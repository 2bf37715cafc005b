# SPDX-License-Identifier: BSD-3-Clause
"""The sections of a scenario's YAML file, as models: what keys there are, and their units.

Lengths are in metres, angles in radians, or in degrees where the key ends in ``_deg``. Files of
worlds and missions take the same sections.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from bathyal.io.yaml_sections import (
    ORIGIN,
    Array,
    FileName,
    Name,
    NotNegative,
    Number,
    PoseSection,
    Positive,
    Section,
    Spread,
    Vector,
    Whole,
    one_of,
    radians,
)


class BodySection(Section):
    """What a body weighs and displaces; `inertia` about the centre of mass."""

    mass: NotNegative = 0.0
    center_of_mass: Vector = ORIGIN
    inertia: tuple[Vector, Vector, Vector] | None = None
    volume: NotNegative = 0.0
    center_of_buoyancy: Vector = ORIGIN


class LinkSection(BodySection):
    """What one link weighs and displaces, in its own frame: a URDF knows no volumes, and an arm by
    its name no masses. What is not given stays as it is."""

    name: Name


class ArmSection(Section):
    """An arm by its name in `bathyal.arms`, or from a URDF or bathyal's JSON.

    `radius`: thickness, one number or one a link; unless given that of the links' shapes.
    `allowed`: pairs of links that may touch.
    """

    name: Name | None = None
    file: FileName | None = None
    tip: Name | None = None
    root: Name | None = None
    tool: PoseSection | None = None
    radius: NotNegative | list[NotNegative] | None = None
    allowed: list[tuple[Name, Name]] = []
    links: list[LinkSection] = []
    q_start: list[Number] | None = None
    q_start_deg: list[Number] | None = None

    @model_validator(mode="after")
    def _one_source(self) -> ArmSection:
        one_of(self, "name", "file", needed=True)
        one_of(self, "q_start", "q_start_deg")
        if self.file is None and (self.tip or self.root):
            raise ValueError("expected tip and root with a file only")
        return self


class HullSection(Section):
    """The vehicle's outer skin: a mesh, or a box. `pose` is vehicle_from_mesh."""

    mesh: FileName | None = None
    scale: Positive | None = None
    box: tuple[Positive, Positive, Positive] | None = None
    pose: PoseSection | None = None

    @model_validator(mode="after")
    def _one_source(self) -> HullSection:
        one_of(self, "mesh", "box", needed=True)
        return self


class _KeepOutSection(Section):
    name: Name | None = None
    frame: Name = "hull"


class SphereSection(_KeepOutSection):
    """A ball."""

    shape: Literal["sphere"]
    radius: Positive
    center: Vector = ORIGIN


class BoxSection(_KeepOutSection):
    """`size`: full lengths; `pose`: frame_from_box, its middle."""

    shape: Literal["box"]
    size: tuple[Positive, Positive, Positive]
    pose: PoseSection = PoseSection()


class CylinderSection(_KeepOutSection):
    """Along its z, its middle at the pose."""

    shape: Literal["cylinder"]
    radius: Positive
    length: Positive
    pose: PoseSection = PoseSection()


class ConeSection(_KeepOutSection):
    """The beam of a modem: from its apex along z; `angle` is the full opening."""

    shape: Literal["cone"]
    length: Positive
    radius: Positive | None = None
    angle: Positive | None = None
    angle_deg: Positive | None = None
    pose: PoseSection = PoseSection()

    @model_validator(mode="after")
    def _one_width(self) -> ConeSection:
        one_of(self, "radius", "angle", "angle_deg", needed=True)
        return self


class HalfSpaceSection(_KeepOutSection):
    """All that lies behind a plane: `normal` points to the free side."""

    shape: Literal["half_space"]
    normal: Vector
    point: Vector


class MeshSection(_KeepOutSection):
    """A closed mesh; `pose` is frame_from_mesh."""

    shape: Literal["mesh"]
    mesh: FileName
    scale: Positive | None = None
    pose: PoseSection | None = None


KeepOutSection = Annotated[
    SphereSection | BoxSection | CylinderSection | ConeSection | HalfSpaceSection | MeshSection,
    Field(discriminator="shape"),
]


class SeabedSection(Section):
    """A generated bottom (`bathyal.survey_height`) about `center`, its mean height the third
    number; `size` along x and y."""

    size: tuple[Positive, Positive]
    spacing: Positive
    center: Vector = ORIGIN
    seed: Whole = 0
    wave_height: NotNegative | None = None
    wave_length: Positive | None = None
    ripple_height: NotNegative | None = None
    roughness: NotNegative | None = None
    boulders: Whole | None = None
    boulder_radius: Positive | None = None
    trench_depth: NotNegative | None = None
    trench_width: Positive | None = None


class SceneSection(Section):
    """The bottom, in the world: a mesh, soundings that are triangulated, or a generated one."""

    mesh: FileName | None = None
    survey: FileName | None = None
    z: Literal["up", "down"] | None = None
    seabed: SeabedSection | None = None

    @model_validator(mode="after")
    def _one_source(self) -> SceneSection:
        one_of(self, "mesh", "survey", "seabed", needed=True)
        if self.z is not None and self.survey is None:
            raise ValueError("expected z with a survey only")
        return self


class PoseAtSection(PoseSection):
    """A pose at a time [s]."""

    time: Number


class VehicleSection(PoseSection):
    """world_from_vehicle, how surely it is known (standard deviations along the vehicle's axes),
    and what the vehicle weighs without its arm. `trajectory` in place of one pose."""

    position_std: Spread | None = None
    rpy_std: Spread | None = None
    rpy_std_deg: Spread | None = None
    trajectory: Annotated[list[PoseAtSection], Field(min_length=1)] | None = None
    body: BodySection | None = None

    @model_validator(mode="after")
    def _one_pose(self) -> VehicleSection:
        one_of(self, "rpy_std", "rpy_std_deg")
        placed = {"position", "rpy", "rpy_deg"} & self.model_fields_set
        if self.trajectory is not None and placed:
            raise ValueError(f"expected a pose or a trajectory, got {sorted(placed)[0]} too")
        return self

    def pose_std(self) -> Array | None:
        """(6,) along and about the vehicle's axes [m, rad]; None where it is surely known."""
        turns = radians(self, "rpy_std")
        if self.position_std is None and turns is None:
            return None
        return np.array([*(self.position_std or ORIGIN), *(turns or ORIGIN)])


def _as_target(given: Any) -> Any:
    return {"point": given} if isinstance(given, (list, tuple)) else given


class TargetSection(Section):
    """A point in the world, or the point of the scene at x and y."""

    name: Name | None = None
    point: Vector | None = None
    on_bottom: tuple[Number, Number] | None = None

    @model_validator(mode="after")
    def _one_place(self) -> TargetSection:
        one_of(self, "point", "on_bottom", needed=True)
        return self


class CapsuleSection(Section):
    """All within `radius` of a segment, in the tool's frame."""

    start: Vector
    end: Vector
    radius: NotNegative


class HeldSection(Section):
    """What the arm holds: its outline and its body, in the tool's frame."""

    capsules: list[CapsuleSection] = []
    body: BodySection = BodySection()


class SamplingSection(Section):
    """How a sample is taken at `target`, a name or a row: keywords of `bathyal.plan_sampling`."""

    target: Name | Whole | None = None
    transport: list[Number] | None = None
    transport_deg: list[Number] | None = None
    tool: HeldSection | None = None
    sample: HeldSection | None = None
    direction: Vector | None = None
    align: Annotated[bool, Field(strict=True)] | None = None
    tool_axis: Vector | None = None
    standoff: Positive | None = None
    depth: NotNegative | None = None
    stiffness: NotNegative | None = None
    force_limit: Positive | None = None
    grab_time: Positive | None = None
    press_speed: Positive | None = None
    max_checks: Annotated[Whole, Field(ge=1)] | None = None
    seed: Whole | None = None

    @model_validator(mode="after")
    def _one_unit(self) -> SamplingSection:
        one_of(self, "transport", "transport_deg")
        return self

    def keywords(self) -> dict[str, Any]:
        """What is given, but for the target, postures and what is held."""
        left_out = {"target", "transport", "transport_deg", "tool", "sample"}
        return self.model_dump(exclude=left_out, exclude_none=True)


class ScenarioSections(Section):
    """A whole scenario."""

    name: str = ""
    arm: ArmSection
    mount: PoseSection = PoseSection()
    hull: HullSection | None = None
    keepouts: list[KeepOutSection] = []
    scene: SceneSection | None = None
    vehicle: VehicleSection = VehicleSection()
    targets: list[Annotated[TargetSection, BeforeValidator(_as_target)]] = []
    sampling: SamplingSection | None = None
