# SPDX-License-Identifier: BSD-3-Clause
"""A BlueROV2 that carries a Reach Alpha 5 arm and floats freely: recorded arm and vehicle motions.

Recordings and URDF: shared/data/uvms (Kolano 2023, MIT). The URDF's masses have the water in them
that moves with the links, and it has no volumes. So masses ("actual" in its comments), volumes and
centres of buoyancy here are those of the same authors' simulation, as are the joints' zeros:
github.com/hkolano/UVMS-SysID-with-EAs, src/julia-sim, ConfigFiles/MagicNumAlpha.jl and
MainPitchValidation.jl. So is what they found of the hull, to compare with.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import savgol_filter
from scipy.spatial.transform import Rotation

import bathyal

Array = NDArray[np.float64]
FOLDER = Path(__file__).resolve().parents[3] / "shared" / "data" / "uvms"
FITTED = [f"traj{n}" for n in ("003-0", "005-0", "006-1", "012-1", "019-3", "030-0")]
# `simulated` as benchmarks/python/uvms_dynamics.py fits it to the six runs FITTED.
NUMBERS = np.array([-0.226, 0.070, -0.365, 13.779])
MOUNT = np.array([[1, 0, 0, 0.25], [0, 1, 0, -0.10965], [0, 0, 1, 0.005], [0, 0, 0, 1.0]])  # URDF
WATER = 997.0  # of the authors' simulation [kg/m³]
# Of each link: mass [kg], its centre [m], volume [m³], its centre [m]; the jaw goes with the wrist.
JAW = bathyal.RigidBody(
    0.05, center_of_mass=(0, 0, -0.19), volume=2.0e-5, center_of_buoyancy=(0, 0, -0.19)
)
BODIES = [
    (0.341, (-0.075, -0.006, -0.003), 2.02e-4, (-0.075, -0.006, -0.003)),
    (0.194, (0.005, -0.001, 0.016), 1.8e-5, (-0.001, -0.003, 0.032)),
    (0.429, (0.073, 0, 0), 2.03e-4, (0.073, 0, -0.002)),
    (0.115, (0.017, -0.026, -0.002), 2.5e-5, (0.003, 0.001, -0.017)),
    (0.333, (0, 0.003, -0.098), 1.55e-4, (0, 0, -0.098)),
]
ZEROS = np.array([3.07, 0.0, 0.0, 2.879])  # of axes e, d, c, b: the URDF's joints 5, 4, 3, 2
# Of the authors' hull with its weights and foam (MagicNumBlueROVHardware.jl): Σ m r − ρ Σ V r,
# 13.17 kg at the origin, 13.082 kg of lift at (7.4, 0, 20) mm, and nine parts whose places they
# call guesses.
AUTHORS_HULL = np.array([-0.224, 0.067, -0.390])  # [kg m]


def there() -> bool:
    return FOLDER.exists()


@cache
def arm() -> bathyal.Arm:
    """From the base on the vehicle to the wrist, with masses and volumes as above."""
    if not there():
        pytest.skip("uvms of the shared data is not here")
    urdf = FOLDER / "urdf" / "blue_rov_hardware.urdf"
    plain = bathyal.Arm.from_urdf(urdf, root="r5m_base_link", tip="r5m_wrist_link")
    bodies = [
        bathyal.RigidBody(mass, center_of_mass=at, volume=volume, center_of_buoyancy=lift_at)
        for mass, at, volume, lift_at in BODIES
    ]
    bodies[-1] = bodies[-1].combined(JAW)
    links = [
        bathyal.Link(
            link.name,
            mass=body.mass,
            center_of_mass=body.center_of_mass,
            volume=body.volume,
            center_of_buoyancy=body.center_of_buoyancy,
            frame=link.frame,
        )
        for link, body in zip(plain.links, bodies, strict=True)
    ]
    table = plain.to_dh()
    return bathyal.Arm.from_dh(
        table.a, table.alpha, table.d, table.theta, beta=table.beta, root=table.root,
        flange=table.flange, lower=plain.lower, upper=plain.upper, links=links, name="Alpha 5",
    )  # fmt: skip


@dataclass
class Run:
    """At the times of the IMU that joint states cover."""

    name: str
    time: Array  # (N,) [s]
    q: Array  # (N, 4) of arm() [rad]
    roll: Array  # (N,) of the vehicle, x forward, y port, z up [rad]
    pitch: Array


def _table(name: str) -> dict[str, Array]:
    rows = np.genfromtxt(FOLDER / "runs" / name, delimiter=",", names=True)
    return {key: rows[key] for key in rows.dtype.names}


def names() -> list[str]:
    """Runs, those with the arm at rest first."""
    return sorted(path.name[: -len("_imu.csv")] for path in FOLDER.glob("runs/*_imu.csv"))


@cache
def run(name: str) -> Run:
    imu, joints = _table(f"{name}_imu.csv"), _table(f"{name}_joint_states.csv")
    covered = imu["time_secs"] >= joints["time_secs"][0]
    covered &= imu["time_secs"] <= joints["time_secs"][-1]
    time = imu["time_secs"][covered]
    columns = [np.interp(time, joints["time_secs"], joints[f"axis_{a}_pos"]) for a in "edcb"]
    x, y, z, w = (imu[f"{axis}_ori"][covered] for axis in "xyzw")
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1, 1))
    return Run(name, time, np.stack(columns, axis=1) - ZEROS, roll, pitch)


SETTLING = 2.0  # in trim with the first posture, before a simulated run begins [s]
SPACING = 0.05  # of the rows that simulated joints go through [s]


@cache
def joint_rows(name: str) -> tuple[Array, Array]:
    """(K,) [s] and (K, 4) [rad]: positions smoothed by cubics over 0.55 s (Savitzky and Golay)."""
    rows = _table(f"{name}_joint_states.csv")
    time = np.arange(rows["time_secs"][0], rows["time_secs"][-1], SPACING)
    columns = [np.interp(time, rows["time_secs"], rows[f"axis_{a}_pos"]) for a in "edcb"]
    q = np.stack(columns, axis=1) - ZEROS
    return time, np.asarray(savgol_filter(q, 11, 3, axis=0))


def simulated(name: str, numbers: Array) -> tuple[Array, Array]:
    """Roll and pitch at the times of `run(name)` as the dynamics have them [rad].

    `numbers` are two an axis: Σ m r of the hull about its centre of buoyancy, (3,) [kg m], of which
    z is of both axes, and the drag about x and y, quadratic alone, over that of the BlueROV2 as
    published. All else is published, the arm's masses and volumes as above.
    """
    base = bathyal.vehicles.bluerov2_heavy()
    linear = base.linear_drag.copy()
    linear[3, 3] = linear[4, 4] = 0.0
    terms = [
        (row, a, b, absolute, value * (numbers[3] if a in (3, 4) else 1.0))
        for row, a, b, absolute, value in base.terms
    ]
    vehicle = base.replace(
        center_of_mass=numbers[:3] / base.mass, linear_drag=linear, terms=terms,
        water_density=WATER, volume=base.mass / WATER,
    )  # fmt: skip
    both = bathyal.ArmOnVehicle(vehicle, bathyal.Workspace(arm(), MOUNT, radii=0.02))
    time, q = joint_rows(name)
    since = time - time[0] + SETTLING
    trim = workspace(numbers[:3]).static_trim(q[0], water_density=WATER)
    start = np.eye(4)
    start[:3, :3] = Rotation.from_euler("YX", [trim.pitch, trim.roll]).as_matrix()
    motion = both.simulate(start, q, np.zeros(6), since[-1], 0.02, time=since)
    turns = motion.pose[:, :3, :3]
    at = run(name).time - time[0] + SETTLING
    roll = np.interp(at, motion.time, np.arctan2(turns[:, 2, 1], turns[:, 2, 2]))
    return roll, np.interp(at, motion.time, np.arcsin(-turns[:, 2, 0]))


def about_mean(values: Array) -> Array:
    return np.asarray(values - values.mean())


def down(roll: Array, pitch: Array) -> Array:
    """(N, 3) the world's down in the vehicle's frame."""
    return np.stack(
        [np.sin(pitch), -np.sin(roll) * np.cos(pitch), -np.cos(roll) * np.cos(pitch)], axis=1
    )


def arm_moment(q: Array) -> Array:
    """(N, 3) Σ m r − ρ Σ V r of the arm about the vehicle's origin [kg m], by two wrenches."""
    ws = bathyal.Workspace(arm(), MOUNT, radii=0.02)
    # moment = s × g: with g along −z it shows (−s_y, s_x), with g along −x (−s_z, s_y).
    by_z = ws.wrench(q, gravity=(0, 0, -1), water_density=WATER)[:, 3:]
    by_x = ws.wrench(q, gravity=(-1, 0, 0), water_density=WATER)[:, 3:]
    return np.stack([by_z[:, 1], -by_z[:, 0], -by_x[:, 1]], axis=1)


def fit_hull(runs: list[Run], every: int = 5) -> Array:
    """(3,) Σ m r − ρ Σ V r of the vehicle without arm [kg m], by least squares over all rows.

    What hangs still has no moment: (hull + arm) × down = 0, linear in what is sought.
    """
    matrix, right = [], []
    for one in runs:
        directions = down(one.roll[::every], one.pitch[::every])
        for moment, toward in zip(arm_moment(one.q[::every]), directions, strict=True):
            x, y, z = toward
            cross = np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])  # cross @ a = a × toward
            matrix.append(cross)
            right.append(-np.cross(moment, toward))
    found = np.linalg.lstsq(np.concatenate(matrix), np.concatenate(right), rcond=None)[0]
    return np.asarray(found)


def workspace(hull: Array) -> bathyal.Workspace:
    """With a vehicle body that has this moment: only it counts for the trim."""
    mass, volume = 13.17, 13.082 / WATER
    body = bathyal.RigidBody(mass, center_of_mass=hull / mass, volume=volume)
    return bathyal.Workspace(arm(), MOUNT, radii=0.02, vehicle_body=body)
