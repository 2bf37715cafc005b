# SPDX-License-Identifier: BSD-3-Clause
"""One step of a vehicle with eight thrusters, against MuJoCo's `mj_step`.

    python -m benchmarks.python.vehicle_step

MuJoCo (Apache-2.0, PyPI `mujoco`) steps a free ellipsoid by its RK4 with and without its drag of an
ellipsoid in a fluid and eight site actuators; it has no buoyancy and no added inertia in the mass
matrix. Ours steps BlueROV2 with added mass, drag, weight and buoyancy, eight T200 with lag, and a
battery solved at each step. First both move the same bare body under the same force and spin: the
motions must agree before any time is printed. Processor time, medians of nine interleaved rounds.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

import bathyal

MASS, INERTIA = 13.5, (0.26, 0.23, 0.37)
FORCE, SPIN = (3.0, -1.0, 2.0), (0.4, 0.9, -0.3)
STEP, COUNT, ROUNDS = 0.01, 20_000, 9


def model(fluid: bool, actuators: bool) -> str:
    """A free body; `fluid` with the drag of an ellipsoid in water."""
    density, viscosity = (1025, 1e-3) if fluid else (0, 0)
    shape = ' fluidshape="ellipsoid"' if fluid else ""
    sites = "".join(f'<site name="s{k}" pos="{0.1 * k - 0.4} 0.1 0"/>' for k in range(8))
    acts = "".join(f'<general site="s{k}" gear="0.7 0.7 0 0 0 0"/>' for k in range(8))
    return f"""<mujoco><option integrator="RK4" timestep="{STEP}" density="{density}"
      viscosity="{viscosity}" gravity="0 0 0"/><worldbody><body><freejoint/>
      <inertial pos="0 0 0" mass="{MASS}" diaginertia="{" ".join(map(str, INERTIA))}"/>
      <geom type="ellipsoid" size="0.23 0.29 0.13" mass="0" contype="0" conaffinity="0"{shape}/>
      {sites if actuators else ""}</body></worldbody>
      <actuator>{acts if actuators else ""}</actuator></mujoco>"""


def check_same_motion(mujoco) -> float:
    """How far apart [m, and of the rotation's entries] a bare body is after 5 s under a force."""
    peer = mujoco.MjModel.from_xml_string(model(fluid=False, actuators=False))
    data = mujoco.MjData(peer)
    data.qvel[3:] = SPIN  # in the body's frame
    ours = bathyal.Vehicle(
        mass=MASS, inertia=np.diag(INERTIA), center_of_mass=[0, 0, 0], volume=0.0, gravity=0.0
    )
    motion = ours.simulate(
        (np.eye(4), [0, 0, 0, *SPIN]),
        lambda _time, pose, _velocity: [
            *(pose[:3, :3].T @ FORCE),
            0,
            0,
            0,
        ],  # constant in the world
        5.0,
        step=STEP,
    )
    data.xfrc_applied[1, :3] = FORCE
    mujoco.mj_step(peer, data, nstep=500)
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, data.qpos[3:])
    off = np.abs(motion.pose[-1, :3, :3] - turned.reshape(3, 3)).max()
    return float(max(np.linalg.norm(motion.pose[-1, :3, 3] - data.qpos[:3]), off))


def nanoseconds(run: Callable[[], None]) -> float:
    """Of one step, over a call that makes COUNT of them."""
    start = time.process_time()
    run()
    return (time.process_time() - start) / COUNT * 1e9


def ours(benchmark: bool) -> Callable[[], None]:
    """BlueROV2 under steady commands, its thrusters by the law, or by a table."""
    rov = bathyal.VehicleSystem.bluerov2_heavy(benchmark_thrusters=benchmark)
    state = rov.rest()
    commands = [0.5, 0.4, -0.3, -0.5, 0.3, 0.35, 0.3, 0.4]
    return lambda: rov.step(state, thrusters=commands, step=STEP, steps=COUNT)


def theirs(mujoco, fluid: bool, actuators: bool) -> Callable[[], None]:
    """The peer's body."""
    peer = mujoco.MjModel.from_xml_string(model(fluid, actuators))
    data = mujoco.MjData(peer)
    data.ctrl[:] = 0.1
    return lambda: mujoco.mj_step(peer, data, nstep=COUNT)


def main() -> None:
    import mujoco

    off = check_same_motion(mujoco)
    if off > 1e-6:
        raise SystemExit(f"the peer's motion is {off:.3g} away: nothing is compared")
    runs = {
        "bathyal, thrusters by the law": ours(False),
        "bathyal, thrusters by a table": ours(True),
        "MuJoCo, free body": theirs(mujoco, False, False),
        "MuJoCo, ellipsoid in water": theirs(mujoco, True, False),
        "MuJoCo, ellipsoid in water, eight actuators": theirs(mujoco, True, True),
    }
    times = np.array([[nanoseconds(run) for run in runs.values()] for _ in range(ROUNDS)])
    ratios = np.median(times / times[:, :1], axis=0)
    print(f"## One vehicle's step against MuJoCo {mujoco.__version__}\n")
    print(
        "`python -m benchmarks.python.vehicle_step`: Runge–Kutta steps of 10 ms, processor time, "
        f"medians of {ROUNDS} interleaved rounds of {COUNT} steps. Ours is BlueROV2 with its whole "
        "added mass in the mass matrix, drag, weight and buoyancy, eight T200 with lag, and a "
        "battery solved with them at each step; MuJoCo's `mj_step` has neither buoyancy nor added "
        "inertia in the mass matrix. A bare body under a force and spinning, by both, is "
        f"{off:.0e} m apart after 5 s.\n"
    )
    print("| | time / ours by the law | ns a step |\n|---|---|---|")
    for name, ratio, each in zip(runs, ratios, np.median(times, axis=0), strict=True):
        peer = name.startswith("MuJoCo")
        shown = f"**{ratio:.1f} ×**" if peer else f"{ratio:.1f}"
        print(f"| {name} | {shown} | {each:.0f} |")


if __name__ == "__main__":
    main()
