# SPDX-License-Identifier: BSD-3-Clause
"""The sections of a vehicle's YAML file, as models: what keys there are, and their units.

All are SI, in the vehicle's frame: x forward, y port, z up, origin at the centre of buoyancy; with
``z_down: true`` in the axes of most printed tables: y starboard, z down.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from bathyal.io.yaml_sections import (
    FileName,
    Name,
    NotNegative,
    Number,
    Positive,
    Section,
    Vector,
    one_of,
)

AXES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
Axis = Literal["surge", "sway", "heave", "roll", "pitch", "yaw"]
Six = tuple[Number, Number, Number, Number, Number, Number]
Matrix3 = tuple[Vector, Vector, Vector]
Matrix6 = tuple[Six, Six, Six, Six, Six, Six]


class TermSection(Section):
    """A part of the force along or about `force`: coefficient · ν_a · ν_b, of abs(ν_b) where
    `absolute`."""

    force: Axis
    a: Axis
    b: Axis
    absolute: bool = True
    coefficient: Number

    def values(self) -> tuple[int, int, int, bool, float]:
        """As `bathyal.Vehicle` takes it."""
        force, a, b = (AXES.index(axis) for axis in (self.force, self.a, self.b))
        return force, a, b, self.absolute, self.coefficient


class PartSection(Section):
    """A ball that represents the vehicle where it leaves the water or meets the bottom."""

    center: Vector
    radius: Positive
    volume: Positive = 1.0


class HullSection(Section):
    """A closed mesh whose equal ellipsoid gives added mass and drag: see
    `bathyal.Vehicle.from_mesh`."""

    mesh: FileName
    drag_coefficient: Vector | None = None


class VehicleSections(Section):
    """One vehicle: of a preset, of a hull, or of its own numbers; what is given besides replaces
    the numbers that the preset or the hull has."""

    preset: Literal["remus100", "bluerov2_heavy"] | None = None
    hull: HullSection | None = None
    name: Name | None = None
    z_down: bool = False
    mass: Positive | None = None
    volume: NotNegative | None = None
    center_of_mass: Vector | None = None
    inertia: Vector | Matrix3 | None = None
    added_mass: Six | Matrix6 | None = None
    linear_drag: Six | Matrix6 | None = None
    quadratic_drag: Six | None = None
    terms: Annotated[list[TermSection], Field(max_length=1000)] | None = None
    parts: Annotated[list[PartSection], Field(max_length=200)] | None = None
    gravity: NotNegative | None = None
    water_density: Positive | None = None

    @model_validator(mode="after")
    def _one_origin(self) -> VehicleSections:
        given = one_of(self, "preset", "hull")
        if given is None:
            for name in ("mass", "volume", "center_of_mass", "inertia"):
                if getattr(self, name) is None:
                    raise ValueError(f"expected {name}, or a preset or a hull, got neither")
        elif self.z_down:
            raise ValueError("expected z_down with numbers alone, got a " + given)
        return self


class VehicleDocument(Section):
    """The same under ``vehicle``."""

    vehicle: VehicleSections


def is_section(value: object) -> bool:
    """Whether a document has its vehicle under ``vehicle``."""
    return isinstance(value, dict) and "vehicle" in value
