# SPDX-License-Identifier: BSD-3-Clause
"""From the sections of a scenario to the engine's objects; each mistake by file, line, column."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import (
    Arm,
    Capsule,
    Hull,
    KeepOut,
    RigidBody,
    Scene,
    Trajectory,
    TriangleMesh,
    Workspace,
    arm_from_parts,
    arm_parts,
    survey_height,
)
from bathyal.arm.files import find_arm
from bathyal.io.files import PathLike, shown
from bathyal.io.yaml_documents import Document, Place
from bathyal.io.yaml_files import DocumentFiles
from bathyal.io.yaml_sections import PoseSection
from bathyal.seabed.bottom import make_bottom, noting
from bathyal.seabed.meshes import read_mesh
from bathyal.view.arm_solid import resting_pose
from bathyal.view.relief import meshes_in_world
from bathyal.view.solids import box
from bathyal.workspace import sections as own
from bathyal.workspace.plausible import size_warnings
from bathyal.workspace.scenario import Scenario

Array = NDArray[np.float64]

_MOST_CELLS = 4_000_000  # of a generated bottom
_ABOVE = 1.0  # [m] over the highest point of the bottom, where the rays for `on_bottom` start


def scenario_of(
    sections: own.ScenarioSections,
    document: Document,
    *,
    inside: PathLike | None,
) -> Scenario:
    """Build what the sections describe; as `read_scenario`."""
    build = _Builder(document, inside)
    arm = build.arm(sections.arm)
    hull = build.hull(sections.hull)
    frames = ["hull", "world", *build.link_names(arm)]
    keepouts = [
        build.keepout(one, ("keepouts", k), frames) for k, one in enumerate(sections.keepouts)
    ]
    scene = build.scene(sections.scene)
    q_start = build.posture(arm, sections.arm, "q_start", ("arm",))
    targets = [build.target(one, scene, k) for k, one in enumerate(sections.targets)]
    names = build.target_names(sections.targets)
    sampled, sampling = build.sampling(sections.sampling, arm, names)
    workspace = build.workspace(sections, arm, hull, keepouts, scene)
    if hull is not None and scene is not None:
        build.warnings += build.apart(hull, scene, sections.vehicle)
    return Scenario(
        name=sections.name or shown(Path(document.path).stem),
        workspace=workspace,
        targets=np.array(targets, float).reshape(-1, 3),
        target_names=names,
        q_start=resting_pose(arm) if q_start is None else q_start,
        sampled=sampled,
        sampling=sampling,
        arm=arm,
        hull=hull,
        scene=scene,
        keepouts=keepouts,
        sections=sections,
        warnings=build.warnings,
    )


class _Builder(DocumentFiles):
    """One document's sections, its files found within one folder."""

    def arm(self, section: own.ArmSection) -> Arm:
        options = {"tip": section.tip, "root": section.root}
        given = {key: value for key, value in options.items() if value is not None}
        if section.file is None:
            with self.placed(("arm", "name")):
                if Path(section.name or "").suffix:  # a file's name would be followed anywhere
                    raise ValueError(f"expected the name of an arm, got {section.name!r}")
                arm = find_arm(section.name or "")
        else:
            path = self.file(section.file, ("arm", "file"))
            with self.placed(("arm", "file")):
                arm = find_arm(path, **given)
        if section.links:
            arm = self.weighed(arm, section.links)
        if section.tool is not None:
            arm.tool = section.tool.matrix()
        return arm

    def link_names(self, arm: Arm) -> list[str]:
        """As a workspace has them."""
        return [name or f"link_{k}" for k, name in enumerate(arm.link_names)]

    def target_names(self, sections: Sequence[own.TargetSection]) -> list[str]:
        """Each its own; of one without a name its number, counted from 1."""
        names: list[str] = []
        for row, section in enumerate(sections):
            name = section.name or str(row + 1)
            with self.placed(("targets", row)):
                if name in names:
                    raise ValueError(f"expected a name of its own, got {name!r} twice")
            names.append(name)
        return names

    def weighed(self, arm: Arm, sections: Sequence[own.LinkSection]) -> Arm:
        """The arm with masses and volumes of its links."""
        names = self.link_names(arm)
        parts = arm_parts(arm)
        for row, section in enumerate(sections):
            with self.placed(("arm", "links", row, "name")):
                if section.name not in names:
                    raise ValueError(f"expected one of {', '.join(names)}, got {section.name!r}")
            parts["links"][names.index(section.name)] |= section.model_dump(
                exclude={"name"}, exclude_unset=True, exclude_none=True
            )
        with self.placed(("arm", "links")):
            return arm_from_parts(parts)

    def mesh(
        self, name: str, place: Place, scale: float | None, pose: PoseSection | None
    ) -> TriangleMesh:
        path = self.file(name, (*place, "mesh"))
        with self.placed((*place, "mesh")):
            mesh = read_mesh(path, scale=scale)
            return mesh if pose is None else _moved(mesh, pose.matrix())

    def hull(self, section: own.HullSection | None) -> Hull | None:
        if section is None:
            return None
        if section.box is not None:
            pose = np.eye(4) if section.pose is None else section.pose.matrix()
            return Hull(_moved(TriangleMesh(*box(np.array(section.box))), pose))
        mesh = self.mesh(section.mesh or "", ("hull",), section.scale, section.pose)
        with self.placed(("hull", "mesh")):
            hull = Hull(mesh)
        report = hull.report
        where = self.document.where(("hull", "mesh"))
        lines = size_warnings(np.asarray(report.low), np.asarray(report.high), "the hull")
        self.warnings += [f"{where}: {line}" for line in [*lines, *report.warnings]]
        return hull

    def keepout(self, section: Any, place: Place, frames: Sequence[str]) -> KeepOut:
        label = {"frame": section.frame, "name": section.name}
        with self.placed((*place, "frame")):
            if section.frame not in frames:
                raise ValueError(f"expected one of {', '.join(frames)}, got {section.frame!r}")
        with self.placed(place):
            match section:
                case own.SphereSection():
                    return KeepOut.sphere(section.radius, section.center, **label)
                case own.BoxSection():
                    return KeepOut.box(section.size, section.pose.matrix(), **label)
                case own.CylinderSection():
                    pose = section.pose.matrix()
                    return KeepOut.cylinder(section.radius, section.length, pose, **label)
                case own.ConeSection():
                    angle = section.angle
                    if section.angle_deg is not None:
                        angle = math.radians(section.angle_deg)
                    pose = section.pose.matrix()
                    return KeepOut.cone(
                        section.length, pose, radius=section.radius, angle=angle, **label
                    )
                case own.HalfSpaceSection():
                    return KeepOut.half_space(section.normal, point=section.point, **label)
        mesh = self.mesh(section.mesh, place, section.scale, section.pose)
        with self.placed(place):
            return KeepOut.mesh(mesh, **label)

    def scene(self, section: own.SceneSection | None) -> Scene | None:
        if section is None:
            return None
        if section.seabed is not None:
            with self.placed(("scene", "seabed")):
                return Scene(seabed_mesh(section.seabed))
        key = "mesh" if section.mesh is not None else "survey"
        path = self.file(section.mesh or section.survey or "", ("scene", key))
        read = {} if section.z is None else {"z": section.z}
        with self.placed(("scene", key)):
            bottom = make_bottom(path, as_mesh=key == "mesh", read=read)
        where = self.document.where(("scene", key))
        self.warnings += [f"{where}: {line}" for line in bottom.warnings]
        assert isinstance(bottom.surface, Scene)
        return bottom.surface

    def posture(self, arm: Arm, section: Any, name: str, place: Place) -> Array | None:
        """Joint values of a key, or of that key in degrees, where sliding joints stay in metres."""
        values, degrees = getattr(section, name), getattr(section, f"{name}_deg")
        if values is None and degrees is None:
            return None
        key = name if degrees is None else f"{name}_deg"
        q = np.array(values if degrees is None else degrees, float)
        with self.placed((*place, key)):
            if q.shape != (arm.size,):
                raise ValueError(f"expected {arm.size} joint values, got {q.size}")
            if degrees is not None:
                turning = [kind != "prismatic" for kind in arm.joint_types]
                q = np.where(turning, np.radians(q), q)
        return q

    def target(self, section: own.TargetSection, scene: Scene | None, row: int) -> Sequence[float]:
        if section.point is not None:
            return section.point
        place = ("targets", row, "on_bottom")
        with self.placed(place):
            if scene is None:
                raise ValueError("expected a section scene, in which the point is looked for")
            x, y = section.on_bottom or (0.0, 0.0)
            high = max(float(np.max(np.asarray(m.vertices)[:, 2])) for m in meshes_in_world(scene))
            hits = scene.cast([[x, y, high + _ABOVE]], [[0, 0, -1]])
            if not math.isfinite(hits.range[0]):
                raise ValueError(f"expected a point of the scene, got none at {x:g}, {y:g}")
            return tuple(float(value) for value in hits.point[0])

    def sampling(
        self, section: own.SamplingSection | None, arm: Arm, names: list[str]
    ) -> tuple[int, dict[str, Any]]:
        if section is None:
            return (0 if names else -1), {}
        sampled = 0 if names else -1
        with self.placed(("sampling", "target")):
            if isinstance(section.target, int):
                if section.target >= len(names):
                    raise ValueError(
                        f"expected a row of targets, of which there are {len(names)}, counted from "
                        f"0, got {section.target}"
                    )
                sampled = section.target
            elif section.target is not None:
                if section.target not in names:
                    known = f"one of {', '.join(names)}" if names else "a scenario with targets"
                    raise ValueError(f"expected {known}, got {section.target!r}")
                sampled = names.index(section.target)
        keywords = section.keywords()
        transport = self.posture(arm, section, "transport", ("sampling",))
        if transport is not None:
            keywords["q_transport"] = transport
        for key in ("tool", "sample"):
            held = getattr(section, key)
            if held is not None:
                with self.placed(("sampling", key)):
                    keywords[key] = body_of(held.body)
                    keywords[f"{key}_capsules"] = [
                        Capsule(one.start, one.end, one.radius) for one in held.capsules
                    ]
        return sampled, keywords

    def workspace(
        self,
        sections: own.ScenarioSections,
        arm: Arm,
        hull: Hull | None,
        keepouts: list[KeepOut],
        scene: Scene | None,
    ) -> Workspace:
        vehicle = sections.vehicle
        options: dict[str, Any] = {}
        if hull is not None:
            options["hull"] = hull
        if scene is not None:
            options["scene"] = scene
        if vehicle.trajectory is not None:
            with self.placed(("vehicle", "trajectory")):
                time = [one.time for one in vehicle.trajectory]
                options["vehicle_pose"] = Trajectory(
                    time, np.stack([one.matrix() for one in vehicle.trajectory])
                )
        else:
            options["vehicle_pose"] = vehicle.matrix()
        std = vehicle.pose_std()
        if std is not None:
            options["vehicle_pose_std"] = std
        if vehicle.body is not None:
            with self.placed(("vehicle", "body")):
                options["vehicle_body"] = body_of(vehicle.body)
        if sections.arm.radius is not None:
            options["radii"] = sections.arm.radius
        lines: list[str] = []
        with self.placed(("arm",)), noting(lines):
            workspace = Workspace(
                arm,
                sections.mount.matrix(),
                keepouts=keepouts,
                allowed=sections.arm.allowed,
                **options,
            )
        for line in lines:
            about: Place = ("arm",)
            if line.startswith("the hull"):
                about = ("hull",)
            elif line.startswith("keep-out"):
                about = ("keepouts",)
            self.warnings.append(f"{self.document.where(about)}: {line}")
        return workspace

    def apart(self, hull: Hull, scene: Scene, vehicle: own.VehicleSection) -> list[str]:
        """A vehicle that is nowhere near its bottom is a mistake in one of the two."""
        pose = vehicle.trajectory[0].matrix() if vehicle.trajectory else vehicle.matrix()
        nearest = float(np.asarray(scene.nearest(pose[None, :3, 3]).distance)[0])
        size = float(np.linalg.norm(np.asarray(hull.report.high) - np.asarray(hull.report.low)))
        if math.isfinite(nearest) and nearest > 100 * max(size, 1.0):
            where = self.document.where(("vehicle",))
            return [
                f"{where}: the vehicle is {nearest:,.0f} m from the nearest point of the scene; "
                "are both in the same coordinates?"
            ]
        return []


def body_of(section: own.BodySection) -> RigidBody:
    """A body of the engine."""
    return RigidBody(
        section.mass,
        center_of_mass=section.center_of_mass,
        inertia=section.inertia,
        volume=section.volume,
        center_of_buoyancy=section.center_of_buoyancy,
    )


def seabed_mesh(section: own.SeabedSection) -> TriangleMesh:
    """A generated bottom as a grid of triangles."""
    length, width = section.size
    columns, rows = (math.ceil(extent / section.spacing) + 1 for extent in (length, width))
    if columns * rows > _MOST_CELLS:
        raise ValueError(
            f"expected at most {_MOST_CELLS:,} points, got {columns:,} x {rows:,}: a wider spacing"
        )
    low = np.array(section.center) - [length / 2, width / 2, 0]
    x, y = np.meshgrid(
        np.linspace(low[0], low[0] + length, columns), np.linspace(low[1], low[1] + width, rows)
    )
    shape = section.model_dump(exclude={"size", "spacing", "center"}, exclude_none=True)
    height = survey_height(x.ravel(), y.ravel(), origin=low, length=length, width=width, **shape)
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).reshape(-1, 1)
    halves = np.array([[0, 1, columns], [1, columns + 1, columns]])
    triangles = np.vstack([first + half for half in halves])
    return TriangleMesh(np.column_stack([x.ravel(), y.ravel(), height]), triangles)


def _moved(mesh: TriangleMesh, pose: Array) -> TriangleMesh:
    vertices = np.asarray(mesh.vertices) @ pose[:3, :3].T + pose[:3, 3]
    return TriangleMesh(vertices, mesh.triangles)
