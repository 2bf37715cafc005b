# SPDX-License-Identifier: BSD-3-Clause
"""A motion of a workspace's arm as pictures and pages take it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bathyal._core import KeepOut, Scene, Workspace
from bathyal.errors import argument_error
from bathyal.view import solids
from bathyal.view.decimate import crop, decimate
from bathyal.view.motion import AT_REST, Body, Light, Motion, Panel, frames_of
from bathyal.view.palette import GAP
from bathyal.view.relief import meshes_in_world

Floats = NDArray[np.float64]

MOST_FRAMES = 400
BOTTOM_BUDGET = 9_000  # triangles: a browser moves the arm over them in some 30 ms a frame
HULL_BUDGET = 6_000
_LINKS = ("#f4f5f7", "#9aa0a9")
_HULL = "#d9a521"
_KEEPOUT = "#c2189b"
_STEP = 0.1  # [s] between rows that come without times
_THIN = 0.006  # [m], the radius at which a bare segment is drawn
_FAR = 1.6  # of the bottom that is shown, as a share of the size of what moves
_NEAR = 0.05  # [m] of clearance below which the indicator warns


@dataclass(frozen=True)
class Phase:
    """A stretch of a motion.

    Attributes
    ----------
    name : str
    begin, end : float
        [s]
    contact : bool
        Whether the end of the tool may touch the bottom in it.
    """

    name: str
    begin: float
    end: float
    contact: bool = False


def motion_of(
    workspace: Workspace,
    q: ArrayLike,
    time: ArrayLike,
    *,
    target: ArrayLike | None = None,
    wrench: ArrayLike | None = None,
    phases: Sequence[Phase] = (),
    title: str = "",
    facts: Mapping[str, str] | None = None,
    warnings: Sequence[str] = (),
    most_frames: int = MOST_FRAMES,
) -> Motion:
    """What moves, and how near it comes to what must not be touched.

    Parameters
    ----------
    workspace : Workspace
    q : (K, n) array
        Joint values [rad] or [m].
    time : (K,) array
        Of each row [s], rising.
    target : (3,) array, optional
        In the world [m]; the indicator shows whether the arm may be sent there.
    wrench : (K, 6) array, optional
        On the vehicle, in its frame about its origin [N, N m].
    phases : sequence of Phase
    title : str
    facts : mapping of str to str, optional
    warnings : sequence of str
    most_frames : int
        Rows to take, spread evenly in time.

    Returns
    -------
    Motion

    Raises
    ------
    ValueError
        For rows that are not as many as times, or none.
    """
    rows = np.atleast_2d(np.asarray(q, float))
    moments = np.asarray(time, float).ravel()
    if len(rows) != len(moments) or not len(rows):
        raise argument_error("time", f"one for each of {len(rows)} rows", f"{len(moments)}")
    chosen = frames_of(moments, most_frames)
    rows, moments = rows[chosen], moments[chosen]
    vehicle = _vehicle_poses(workspace, moments)
    capsules, capsule_poses = _capsules(workspace, rows)
    poses = np.concatenate([vehicle[:, None], vehicle[:, None] @ capsule_poses], axis=1)
    tips = vehicle @ np.asarray(workspace.arm.forward(rows))
    bodies = [*_vehicle_bodies(workspace, vehicle), *capsules]
    if target is not None:
        point = np.asarray(target, float)
        bodies.append(Body("target", "target", *solids.ball(point, 0.02), colour=GAP))
    clearance = _clearances(workspace, rows, moments, phases)
    panels = [_joint_panel(workspace, rows), Panel("clearance [m]", clearance)]
    if wrench is not None:
        panels += _wrench_panels(np.asarray(wrench, float)[chosen])
    lights = [_clearance_light(clearance, moments, phases)]
    if target is not None:
        lights.insert(0, _target_light(workspace, np.asarray(target, float), len(rows)))
    motion = Motion(
        time=moments, poses=poses, bodies=bodies, panels=panels,
        phases=[(one.name, one.begin, one.end) for one in phases], lights=lights,
        path=tips[:, :3, 3], title=title, facts=dict(facts or {}), warnings=list(warnings),
    )  # fmt: skip
    if workspace.scene is None:
        return motion
    low, high = motion.box()
    return Motion(**{**vars(motion), "bodies": [*_bottom(workspace.scene, low, high), *bodies]})


def evenly_timed(q: ArrayLike, time: ArrayLike | None) -> tuple[Floats, Floats]:
    """Rows (K, n), and their times, `_STEP` apart where none are given."""
    rows: Floats = np.atleast_2d(np.asarray(q, float))
    moments: Floats = np.asarray(_STEP * np.arange(len(rows)) if time is None else time, float)
    return rows, moments


def _vehicle_poses(workspace: Workspace, time: Floats) -> Floats:
    """(F, 4, 4) world_from_vehicle."""
    trajectory = workspace.vehicle_pose
    if len(trajectory.time) <= 1:
        return np.broadcast_to(trajectory.at(0.0), (len(time), 4, 4)).copy()
    return np.stack([trajectory.at(float(moment)) for moment in time])


def _capsules(workspace: Workspace, q: Floats) -> tuple[list[Body], Floats]:
    """A body for each of the arm's capsules along its own z, its end the origin, and (F, C, 4, 4)
    vehicle_from_capsule. One that a sliding joint draws out is drawn at its longest."""
    placed = np.asarray(workspace.place_capsules(q))
    start, end, radius = placed[..., :3], placed[..., 3:6], placed[0, :, 6]
    length = np.linalg.norm(end - start, axis=2)
    along = np.where(length[..., None] > 0, end - start, [0.0, 0.0, 1.0])
    along /= np.linalg.norm(along, axis=2, keepdims=True)
    helper = np.eye(3)[np.argmin(np.abs(along), axis=2)]
    across = np.cross(helper, along)
    across /= np.linalg.norm(across, axis=2, keepdims=True)
    poses = np.zeros((*length.shape, 4, 4))
    poses[..., :3, 0], poses[..., :3, 1] = across, np.cross(along, across)
    poses[..., :3, 2], poses[..., :3, 3], poses[..., 3, 3] = along, end, 1.0
    names = list(workspace.capsule_links)
    numbers = {name: number for number, name in enumerate(dict.fromkeys(names))}
    bodies = []
    for k, name in enumerate(names):
        mesh = solids.capsule(
            np.array([0.0, 0.0, -float(length[:, k].max())]), np.zeros(3),
            max(float(radius[k]), _THIN),
        )  # fmt: skip
        colour = _LINKS[(numbers[name] if len(numbers) > 1 else k) % 2]
        bodies.append(Body(name or f"link {k}", "link", *mesh, colour=colour, carrier=1 + k))
    return bodies, poses


def _vehicle_bodies(workspace: Workspace, vehicle: Floats) -> list[Body]:
    """Hull and keep-outs; those of a vehicle at rest in the world."""
    still = bool(np.all(vehicle == vehicle[0]))
    bodies = []
    if workspace.hull is not None:
        mesh = workspace.hull.mesh
        vertices, triangles = decimate(
            np.asarray(mesh.vertices), np.asarray(mesh.triangles), HULL_BUDGET
        )
        bodies.append(Body("hull", "hull", vertices, triangles, _HULL))
    size = 1.0
    if bodies:
        size = float(np.linalg.norm(np.ptp(bodies[0].vertices, axis=0)))
    moved = []
    for keepout in workspace.keepouts:
        vertices, triangles = keepout_mesh(keepout, size)
        body = Body(
            keepout.name or keepout.kind, "keepout", vertices, triangles, _KEEPOUT, opacity=0.25
        )
        if keepout.frame == "hull":
            bodies.append(body)
        elif keepout.frame == "world":
            moved.append(body)
        # What is fixed to a link is drawn by that link's own capsules.
    for body in bodies:
        if still:
            vertices = body.vertices @ vehicle[0, :3, :3].T + vehicle[0, :3, 3]
            moved.append(Body(**{**vars(body), "vertices": vertices, "carrier": AT_REST}))
        else:
            moved.append(Body(**{**vars(body), "carrier": 0}))
    return moved


def keepout_mesh(keepout: KeepOut, size: float) -> solids.Mesh:
    """The surface of a keep-out in its own frame; of a half-space a square about as large as
    `size` [m]."""
    kind = keepout.kind
    if kind == "mesh":
        mesh = keepout.hull.mesh  # type: ignore[union-attr]
        return decimate(np.asarray(mesh.vertices), np.asarray(mesh.triangles), HULL_BUDGET)
    if kind == "half_space":
        border: Any = keepout.border
        normal = np.asarray(border.normal)
        return solids.patch(normal * border.offset, normal, size)
    pose = np.asarray(keepout.pose)
    radius, length = keepout.radius or 0.0, keepout.length or 0.0
    axis = np.array([0.0, 0.0, 1.0])
    if kind == "sphere":
        vertices, triangles = solids.ball(np.zeros(3), radius)
    elif kind == "box":
        vertices, triangles = solids.box(np.asarray(keepout.size))
    elif kind == "cylinder":
        vertices, triangles = solids.prism(
            -axis * length / 2, axis * length / 2, radius, 2 * solids.SIDES
        )
    else:
        vertices, triangles = solids.cone(np.zeros(3), axis * length, radius)
    return np.asarray(vertices @ pose[:3, :3].T + pose[:3, 3]), triangles


def _bottom(scene: Scene, low: Floats, high: Floats) -> list[Body]:
    """The part of the scene under what moves."""
    middle, half = (low + high) / 2, _FAR * float(np.max((high - low)[:2])) / 2 + 1e-3
    corners = middle[:2] - half, middle[:2] + half
    parts = [crop(mesh, *corners) for mesh in meshes_in_world(scene)]
    parts = [part for part in parts if len(part[1])]
    return [
        Body("bottom", "bottom", *decimate(*part, BOTTOM_BUDGET // len(parts)), colour="depth")
        for part in parts
    ]


def _clearances(
    workspace: Workspace, q: Floats, time: Floats, phases: Sequence[Phase]
) -> dict[str, Floats]:
    """Distances to what must not be touched, and of the arm from itself [m]."""
    contact = _in_contact(time, phases)
    distance = np.empty(len(q))
    own = np.empty(len(q))
    for touching in (False, True):
        rows = np.flatnonzero(contact == touching)
        if len(rows):
            near = workspace.clearance(q[rows], time=time[rows], tip_contact=touching)
            distance[rows] = near.distance
            own[rows] = near.self_distance
    return {"nearest": distance, "own links": own}


def _in_contact(time: Floats, phases: Sequence[Phase]) -> NDArray[np.bool_]:
    contact = np.zeros(len(time), bool)
    for phase in phases:
        if phase.contact:
            contact |= (time >= phase.begin) & (time <= phase.end)
    return contact


def _joint_panel(workspace: Workspace, q: Floats) -> Panel:
    arm = workspace.arm
    turning = [kind != "prismatic" for kind in arm.joint_types]
    shown = np.where(turning, np.degrees(q), 1000 * q)
    curves = {name: shown[:, k] for k, name in enumerate(arm.joint_names)}
    return Panel("joints [deg]" if all(turning) else "joints [deg], [mm]", curves)


def _wrench_panels(wrench: Floats) -> list[Panel]:
    force, moment = wrench[:, :3].T, wrench[:, 3:].T
    return [
        Panel("force on the vehicle [N]", dict(zip(("x", "y", "z"), force, strict=True))),
        Panel(
            "moment on the vehicle [N m]",
            dict(zip(("roll (x)", "pitch (y)", "yaw (z)"), moment, strict=True)),
        ),
    ]


def _clearance_light(
    clearance: Mapping[str, Floats], time: Floats, phases: Sequence[Phase]
) -> Light:
    nearest = np.minimum(clearance["nearest"], clearance["own links"])
    contact = _in_contact(time, phases)
    state = np.where(nearest < 0, "stop", np.where(nearest < _NEAR, "caution", "go"))
    text = [
        "contact" if near < 0 else "clear" if np.isinf(near) else f"clear by {1000 * near:.0f} mm"
        for near in nearest
    ]
    text = [f"{one}, tool may touch" if at else one for one, at in zip(text, contact, strict=True)]
    return Light("clearance", state.tolist(), text)


_TARGETS = {
    "hull": "target inside the hull",
    "keepout": "target in a keep-out",
    "ground": "target in the ground",
    "unreachable": "target out of reach",
    "collision": "target reached only in collision",
    "limit": "target reached only at a limit",
    "free": "target free",
}


def _target_light(workspace: Workspace, target: Floats, frames: int) -> Light:
    status = str(workspace.check_target(target.reshape(1, 3)).status[0])
    state = {"free": "go", "limit": "caution"}.get(status, "stop")
    return Light("target", [state] * frames, [_TARGETS.get(status, status)] * frames)
