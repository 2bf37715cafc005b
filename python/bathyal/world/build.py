# SPDX-License-Identifier: BSD-3-Clause
"""A world from the sections of its file."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal import _core
from bathyal._core import (
    Material,
    Sediment,
    Tide,
    Trajectory,
    TriangleMesh,
    Water,
    Waves,
    World,
)
from bathyal.io.yaml_documents import Place
from bathyal.io.yaml_files import DocumentFiles
from bathyal.io.yaml_sections import radians
from bathyal.seabed.clouds import read_cloud
from bathyal.seabed.meshes import read_mesh
from bathyal.seabed.triangulate import triangulate
from bathyal.view.solids import box
from bathyal.water.casts import read_profile
from bathyal.world import sections as own

Array = NDArray[np.float64]

_MAKERS: dict[str, Callable[..., TriangleMesh]] = {
    "boulder": _core.make_boulder,
    "mine": _core.make_mine,
    "wreck": _core.make_wreck,
    "fish": _core.make_fish,
}


class WorldBuilder(DocumentFiles):
    """One document's world."""

    root: Place = ()

    @contextmanager
    def placed(self, place: Place) -> Iterator[None]:
        """Keywords that a function does not take are mistakes of the file, too."""
        with super().placed(place):
            try:
                yield
            except TypeError as error:
                raise ValueError(str(error)) from error

    def world(self, sections: own.WorldSections) -> World:
        """All of it, from top to bottom."""
        world = World()
        for name, material in sections.materials.items():
            with self.placed((*self.root, "materials", name)):
                world.set_material(_material(name, material))
        world.water = self.water(sections.water)
        self.terrain(world, sections.terrain)
        for kind, make in (("pipelines", _core.make_pipeline), ("cables", _core.make_cable)):
            for row, laid in enumerate(getattr(sections, kind)):
                self.lay(world, make, laid, (*self.root, kind, row))
        for row, one in enumerate(sections.objects):
            self.add(world, one, (*self.root, "objects", row))
        for row, some in enumerate(sections.clones):
            place = (*self.root, "clones", row)
            mesh = self.shape(some, place)
            with self.placed(place):
                world.add_clones(
                    mesh, some.count, some.material or "rock", some.name, **_keywords(some.options)
                )
        for row, school in enumerate(sections.fish):
            self.school(world, school, (*self.root, "fish", row))
        for row, region in enumerate(sections.paint):
            with self.placed((*self.root, "paint", row)):
                world.paint(region.object, region.polygon, region.material)
        return world

    def water(self, section: own.WaterSection) -> Water:
        """Its profile read from a file, where it names one."""
        place = (*self.root, "water")
        given = section.model_dump(exclude_none=True, exclude={"profile", "waves", "tide"})
        if section.profile is not None:
            path = self.file(section.profile, (*place, "profile"))
            with self.placed((*place, "profile")):
                given["profile"] = read_profile(path)
        if section.waves is not None:
            with self.placed((*place, "waves")):
                given["waves"] = Waves(**_keywords(section.waves))
        if section.tide is not None:
            with self.placed((*place, "tide")):
                given["tide"] = _tide(section.tide)
        with self.placed(place):
            return Water(**given)

    def terrain(self, world: World, section: own.TerrainSection) -> None:
        place = (*self.root, "terrain")
        if section.seabed is not None:
            with self.placed((*place, "seabed")):
                mesh = _core.make_seabed(**_keywords(section.seabed))
        elif section.mesh is not None:
            path = self.file(section.mesh, (*place, "mesh"))
            with self.placed((*place, "mesh")):
                mesh = read_mesh(path)
        else:
            path = self.file(section.survey or "", (*place, "survey"))
            with self.placed((*place, "survey")):
                mesh = triangulate(read_cloud(path))
        pose = None if section.pose is None else section.pose.matrix()
        with self.placed(place):
            world.add(mesh, pose, section.material or "sand", section.name)

    def shape(self, section: own.ShapeSection, place: Place) -> TriangleMesh:
        """What an object or its clones look like."""
        if section.mesh is not None:
            path = self.file(section.mesh, (*place, "mesh"))
            with self.placed((*place, "mesh")):
                return read_mesh(path)
        if section.box is not None:
            return TriangleMesh(*box(np.array(section.box)))
        for name, make in _MAKERS.items():
            keywords = getattr(section, name)
            if keywords is not None:
                with self.placed((*place, name)):
                    return make(**keywords)
        raise AssertionError("a shape is one of its kinds")

    def add(self, world: World, section: own.ObjectSection, place: Place) -> None:
        mesh = self.shape(section, place)
        with self.placed(place):
            pose: Any = None
            if section.trajectory is not None:
                poses = np.stack([one.matrix() for one in section.trajectory])
                pose = Trajectory([one.time for one in section.trajectory], poses)
            elif section.pose is not None:
                pose = section.pose.matrix()
            if section.on_ground:
                pose = self.grounded(world, np.eye(4) if pose is None else pose)
            world.add(mesh, pose, section.material or "steel", section.name, scale=section.scale)

    def grounded(self, world: World, pose: Array) -> Array:
        """The pose, its z counted from what lies below it."""
        top = 1e5
        hit = world.scene.cast([[*pose[:2, 3], top]], [[0, 0, -1]])
        if not np.isfinite(hit.range[0]):
            raise ValueError("expected ground below the object, got none")
        lifted = pose.copy()
        lifted[2, 3] += top - float(hit.range[0])
        return lifted

    def lay(
        self, world: World, make: Callable[..., Any], section: own.LaidSection, place: Place
    ) -> None:
        with self.placed(place):
            laid = make(section.route, section.diameter, world.scene, **section.options)
            world.add(laid.mesh, None, section.material or "steel", section.name)

    def school(self, world: World, section: own.FishSection, place: Place) -> None:
        with self.placed(place):
            if "seed" in section.options:
                raise ValueError("`options`: expected seed next to them, got it among them")
            mesh = _core.make_fish(section.length)
            paths = _core.fish_paths(
                world.scene,
                section.count,
                section.duration,
                seed=section.seed,
                **_keywords(section.options),
            )
            for number, path in enumerate(paths):
                world.add(mesh, path, "fish", f"{section.name}_{number}")


def _material(name: str, section: own.MaterialSection) -> Material:
    decibels, sediment = section.strength_db, section.sediment
    return Material(
        name,
        (section.strength or 0.0) if decibels is None else 10 ** (0.1 * decibels),
        angle=radians(section, "angle"),
        backscatter=section.backscatter_db,
        sediment=None if sediment is None else Sediment(**sediment.model_dump(exclude_none=True)),
    )


def _tide(section: own.TideSection) -> Tide:
    if section.constituents is None:
        return Tide.from_table(section.time or [], section.height or [])
    return Tide(
        [
            (name, (one.amplitude, one.phase or math.radians(one.phase_deg or 0.0)))
            for name, one in section.constituents.items()
        ]
    )


def _keywords(values: own.Keywords) -> dict[str, Any]:
    """For a function that refuses by name what it does not take."""
    return dict(values)
