# SPDX-License-Identifier: BSD-3-Clause
"""The sections of a world's YAML file, as models: what keys there are, and their units.

Lengths are in metres, angles in radians, or in degrees where the key ends in ``_deg``. A key that
makes something (``seabed``, ``boulder``, ``wreck`` …) takes the keywords of the function of that
name: `bathyal.make_seabed`, `bathyal.make_boulder` and so on.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from bathyal.io.yaml_sections import (
    FileName,
    Name,
    NotNegative,
    Number,
    PoseSection,
    Positive,
    Section,
    Vector,
    Whole,
    one_of,
)

Value = bool | int | Number | Name | list[Number] | list[list[Number]]
Keywords = dict[Name, Value]
Point = tuple[Number, Number]
Length = Annotated[Positive, Field(le=1e6)]
Count = Annotated[int, Field(strict=True, ge=1, le=1_000_000)]

SHAPES = ("mesh", "boulder", "mine", "wreck", "fish", "box")


class ShapeSection(Section):
    """A mesh from a file, or one that is made."""

    mesh: FileName | None = None
    boulder: Keywords | None = None
    mine: Keywords | None = None
    wreck: Keywords | None = None
    fish: Keywords | None = None
    box: tuple[Length, Length, Length] | None = None

    @model_validator(mode="after")
    def _one_shape(self) -> ShapeSection:
        one_of(self, *SHAPES, needed=True)
        return self


class ConstituentSection(Section):
    """A harmonic of the tide: its amplitude [m] and its phase at time 0."""

    amplitude: NotNegative
    phase: Number | None = None
    phase_deg: Number | None = None

    @model_validator(mode="after")
    def _one_unit(self) -> ConstituentSection:
        one_of(self, "phase", "phase_deg")
        return self


class TideSection(Section):
    """Constituents by their names (M2, S2 …), or a table of times [s] and heights [m]."""

    constituents: dict[Name, ConstituentSection] | None = None
    time: list[Number] | None = None
    height: list[Number] | None = None

    @model_validator(mode="after")
    def _one_kind(self) -> TideSection:
        one_of(self, "constituents", "time", needed=True)
        if (self.time is None) != (self.height is None):
            raise ValueError("expected time and height together, got one of them")
        return self


class WaterSection(Section):
    """The water; without `surface` it is out of reach, and the water is the same everywhere."""

    surface: Number | None = None
    temperature: Number | None = None
    salinity: NotNegative | None = None
    sound_speed: Positive | None = None
    profile: FileName | None = None
    current: Vector | None = None
    waves: Keywords | None = None
    tide: TideSection | None = None


class SedimentSection(Section):
    """Of `bathyal.Sediment`."""

    density_ratio: Positive | None = None
    speed_ratio: Positive | None = None
    loss: NotNegative | None = None
    volume: NotNegative | None = None
    spectral_exponent: Number | None = None
    spectral_strength: NotNegative | None = None


class MaterialSection(Section):
    """Of its own: Lambert's strength, linear or in dB, and for the other models a sediment, or a
    table of backscatter [dB] by the angle of incidence."""

    strength: NotNegative | None = None
    strength_db: Annotated[Number, Field(ge=-200, le=100)] | None = None
    angle: list[Number] | None = None
    angle_deg: list[Number] | None = None
    backscatter_db: list[Number] | None = None
    sediment: SedimentSection | None = None

    @model_validator(mode="after")
    def _one_law(self) -> MaterialSection:
        one_of(self, "strength", "strength_db", needed=True)
        angle = one_of(self, "angle", "angle_deg")
        if (angle is None) != (self.backscatter_db is None):
            raise ValueError("expected angles and backscatter_db together, got one of them")
        return self


class TerrainSection(Section):
    """The bottom: a mesh, soundings that are triangulated, or a generated one."""

    mesh: FileName | None = None
    survey: FileName | None = None
    seabed: Keywords | None = None
    name: Name = "bottom"
    material: Name | None = None
    pose: PoseSection | None = None

    @model_validator(mode="after")
    def _one_source(self) -> TerrainSection:
        one_of(self, "mesh", "survey", "seabed", needed=True)
        return self


class PoseAtSection(PoseSection):
    """A pose at a time [s]."""

    time: Number


class ObjectSection(ShapeSection):
    """A thing that rests at a pose or moves along poses over time; `on_ground`: its z counts from
    what lies below it."""

    name: Name
    material: Name | None = None
    pose: PoseSection | None = None
    trajectory: Annotated[list[PoseAtSection], Field(min_length=1)] | None = None
    scale: Annotated[Positive, Field(le=1e6)] = 1.0
    on_ground: bool = False

    @model_validator(mode="after")
    def _one_motion(self) -> ObjectSection:
        one_of(self, "pose", "trajectory")
        if self.on_ground and self.trajectory is not None:
            raise ValueError("expected on_ground with a pose only")
        return self


class LaidSection(Section):
    """A pipeline or cable along a route; further keys of `bathyal.make_pipeline`, or of
    `bathyal.make_cable`, under `options`."""

    name: Name
    route: Annotated[list[Point], Field(min_length=2)]
    diameter: Positive
    material: Name | None = None
    options: Keywords = {}


class ClonesSection(ShapeSection):
    """Copies scattered over what comes before them; `options` as of `World.add_clones`."""

    name: Name
    count: Count
    material: Name | None = None
    options: Keywords = {}


class PaintSection(Section):
    """Another material within a polygon seen from above."""

    object: Name = "bottom"
    polygon: Annotated[list[Point], Field(min_length=3)]
    material: Name


class FishSection(Section):
    """Fish on random paths: `length` of each, `options` as of `bathyal.fish_paths`."""

    name: Name = "fish"
    count: Count
    length: Positive = 0.5
    duration: Positive = 600.0
    seed: Whole = 0
    options: Keywords = {}


class WorldSections(Section):
    """All of a world; built from top to bottom."""

    name: Name | None = None
    water: WaterSection = WaterSection()
    materials: dict[Name, MaterialSection] = {}
    terrain: TerrainSection
    pipelines: list[LaidSection] = []
    cables: list[LaidSection] = []
    objects: list[ObjectSection] = []
    clones: list[ClonesSection] = []
    fish: list[FishSection] = []
    paint: list[PaintSection] = []


class WorldDocument(Section):
    """A world as one section of a larger file."""

    world: WorldSections


def is_section(value: object) -> bool:
    """Whether a document has its world under the key `world`."""
    return isinstance(value, dict) and "world" in value
