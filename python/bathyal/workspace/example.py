# SPDX-License-Identifier: BSD-3-Clause
"""A scenario to try things on: an arm on a vehicle over a generated bottom, written as files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bathyal._core import TriangleMesh
from bathyal.io.files import PathLike, replacing
from bathyal.seabed.meshes import write_mesh
from bathyal.view import solids
from bathyal.workspace.build_scenario import seabed_mesh
from bathyal.workspace.sections import SeabedSection

Floats = NDArray[np.float64]

FILES = ("scenario.yaml", "hull.stl", "seabed.ply")

_LENGTH, _WIDTH, _HEIGHT = 1.6, 0.62, 0.44  # [m] of the vehicle
_ROUND = 2.6  # exponent of the hull's outline along its length: 2 is an ellipse
_STATIONS = 25
_BOTTOM = {
    "size": (6.0, 5.0), "spacing": 0.04, "center": (0.6, 0.0, -51.2), "wave_height": 0.12,
    "wave_length": 2.6, "ripple_height": 0.012, "roughness": 0.03, "boulders": 9,
    "boulder_radius": 0.32, "trench_depth": 0.0,
}  # fmt: skip

TEXT = """\
# A soil sample: does the arm reach it, by which motion, and what does that do to the vehicle?
# Lengths in metres; angles in radians, in degrees where a key ends in _deg.
# Vehicle: x forward, y port, z up. World: z up.
name: soil sample
arm:
  name: maevskiy_zanin               # or file: arm.urdf, with tip: and root:
  q_start_deg: [0, -45, 50]
  links:                             # in the links' own frames
    - {name: link_1, mass: 4.0, volume: 0.0016, center_of_mass: [-0.1, 0, 0]}
    - {name: link_2, mass: 5.5, volume: 0.0028, center_of_mass: [-0.28, 0, 0]}
    - {name: link_3, mass: 3.5, volume: 0.0018, center_of_mass: [-0.3, 0, 0]}
mount: {position: [0.72, 0, -0.12]}  # vehicle_from_base
hull: {mesh: hull.stl}               # scale: 0.001 where the file is in millimetres
keepouts:
  - {name: modem beam, shape: cone, length: 1.2, angle_deg: 40, pose: {position: [0.1, 0, 0.2]}}
scene: {mesh: seabed.ply}            # or survey: soundings.xyz
vehicle:
  position: [0, 0, -50.2]            # world_from_vehicle
  rpy_deg: [0, 0, 0]
  body: {mass: 258, volume: 0.2585, center_of_mass: [-0.02, 0, -0.05]}
targets:
  - {name: ahead, on_bottom: [1.55, 0]}
  - {name: port, on_bottom: [1.25, 0.6]}
sampling:
  target: ahead
  depth: 0.03                        # pressed into a bottom of this stiffness [N/m]
  stiffness: 4000
  force_limit: 150
  sample: {body: {mass: 1.2, volume: 0.0007}}
"""


def write_example(folder: PathLike, *, seed: int = 0) -> list[Path]:
    """Write scenario.yaml and the meshes that it names.

    Parameters
    ----------
    folder : path
        Made where it is missing.
    seed : int
        Of the bottom.

    Returns
    -------
    list of pathlib.Path

    Raises
    ------
    OSError
        Where a file cannot be written.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    write_mesh(example_hull(), folder / "hull.stl")
    bottom = SeabedSection.model_validate({**_BOTTOM, "seed": seed})
    write_mesh(seabed_mesh(bottom), folder / "seabed.ply")
    with replacing(folder / FILES[0]) as aside:
        aside.write_text(TEXT, encoding="utf-8")
    return [folder / name for name in FILES]


def example_hull() -> TriangleMesh:
    """A closed hull with round ends, wider than high, about the origin."""
    along = np.cos(np.linspace(np.pi, 0, _STATIONS))
    radius = (1 - np.abs(along) ** _ROUND) ** (1 / _ROUND)
    radius[[0, -1]] = 0.0
    profile = np.column_stack([along, radius])
    vertices, triangles = solids.turned(profile, np.zeros(3), np.array([1.0, 0, 0]), 40)
    vertices = vertices * [_LENGTH / 2, _WIDTH / 2, _HEIGHT / 2]
    return TriangleMesh(*_welded(vertices, triangles))


def _welded(vertices: Floats, triangles: NDArray[np.int32]) -> solids.Mesh:
    """Corners at one place made one, triangles without area dropped."""
    places, index = np.unique(vertices.round(9), axis=0, return_inverse=True)
    joined = index.reshape(-1)[triangles]
    whole = (
        (joined[:, 0] != joined[:, 1])
        & (joined[:, 1] != joined[:, 2])
        & (joined[:, 2] != joined[:, 0])
    )
    return places, joined[whole].astype(np.int32)
