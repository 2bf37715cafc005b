# SPDX-License-Identifier: BSD-3-Clause
"""Vehicles from YAML files."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from bathyal.io.files import PathLike
from bathyal.io.yaml_files import DocumentFiles

if TYPE_CHECKING:
    from bathyal._core import Vehicle
    from bathyal.io.yaml_documents import Place
    from bathyal.vehicle.sections import VehicleSections


def read_vehicle(path: PathLike, *, inside: PathLike | None = None) -> Vehicle:
    """Read a vehicle.

    Parameters
    ----------
    path : path
        ``.yaml``; the keys are those of `bathyal.vehicle.sections.VehicleSections`, at the top or
        under ``vehicle``: ``preset`` or ``hull``, and the keywords of `Vehicle`.
    inside : path, optional
        A folder in which the files that it names may lie, that and all below it; that of the
        vehicle's file unless given. Links are resolved.

    Returns
    -------
    Vehicle

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        By file, line and column: for text that is no YAML, tags, keys that are not known or
        missing, values out of range, files that are missing, broken, or outside of `inside`.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "vehicle.yaml"
    >>> _ = path.write_text('''
    ... preset: bluerov2_heavy
    ... name: with a sampler
    ... mass: 14.5
    ... ''')
    >>> bathyal.read_vehicle(path)
    Vehicle(with a sampler: 14.5 kg)
    """
    from bathyal.io.yaml_documents import read_yaml
    from bathyal.io.yaml_schema import validated
    from bathyal.vehicle import sections as own

    document = read_yaml(path)
    builder = VehicleBuilder(document, inside)
    if own.is_section(document.value):
        section = validated(own.VehicleDocument, document).vehicle
        vehicle = builder.vehicle(section, ("vehicle",))
    else:
        vehicle = builder.vehicle(validated(own.VehicleSections, document), ())
    warn_of_weight(vehicle)
    return vehicle


class HeavyVehicleWarning(UserWarning):
    """A vehicle that sinks."""


def warn_of_weight(vehicle: Vehicle, *, mass: float = 0.0, volume: float = 0.0) -> None:
    """Warns of a weight above buoyancy: by a hundredth, with ballast that it can drop by a fifth.

    Parameters
    ----------
    vehicle : Vehicle
    mass, volume : float
        Of the ballast [kg, m³].
    """
    for more, space, allowed in ((0.0, 0.0, 1.01), (mass, volume, 1.2)):
        weight = (vehicle.mass + more) * vehicle.gravity
        buoyancy = (vehicle.volume + space) * vehicle.water_density * vehicle.gravity
        if weight > allowed * buoyancy:
            warnings.warn(
                f"{vehicle.name}: a weight of {weight:.1f} N above its buoyancy of "
                f"{buoyancy:.1f} N: it sinks",
                HeavyVehicleWarning,
                stacklevel=3,
            )
            return


class VehicleBuilder(DocumentFiles):
    """A vehicle from the sections of a document."""

    def vehicle(self, section: VehicleSections, place: Place) -> Vehicle:
        """The vehicle of the section at `place`."""
        from bathyal import vehicles
        from bathyal._core import Vehicle

        given = _keywords(section)
        if section.preset is not None:
            with self.placed(place):
                vehicle: Vehicle = getattr(vehicles, section.preset)()
                return vehicle.replace(**given)
        if section.hull is None:
            with self.placed(place):
                return Vehicle(**given, z_down=section.z_down)
        return self._from_hull(section, given, place)

    def _from_hull(self, section: VehicleSections, given: dict[str, Any], place: Place) -> Vehicle:
        from bathyal._core import Vehicle
        from bathyal.seabed.meshes import read_mesh

        assert section.hull is not None
        path = self.file(section.hull.mesh, (*place, "hull", "mesh"))
        with self.placed((*place, "hull")):
            mesh = read_mesh(path)
            keys = ("mass", "center_of_mass", "inertia", "gravity", "water_density")
            known = {key: given.pop(key) for key in keys if key in given}
            drag = section.hull.drag_coefficient
            vehicle: Vehicle = Vehicle.from_mesh(mesh, drag_coefficient=drag, **known)[0]
        with self.placed(place):
            return vehicle.replace(**given)


def _keywords(section: VehicleSections) -> dict[str, Any]:
    """Those of `Vehicle` that the section gives."""
    from bathyal.vehicle.sections import VehicleSections

    own = {"preset", "hull", "z_down", "terms", "parts"}
    given = section.model_dump(exclude_none=True, include=set(VehicleSections.model_fields) - own)
    for name in ("inertia", "added_mass", "linear_drag"):
        if name in given and np.ndim(given[name]) == 1:
            given[name] = np.diag(given[name])
    if section.terms is not None:
        given["terms"] = [term.values() for term in section.terms]
    if section.parts is not None:
        given["parts"] = [(*part.center, part.radius, part.volume) for part in section.parts]
    return given
