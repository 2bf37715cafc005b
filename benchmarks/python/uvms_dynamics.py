# SPDX-License-Identifier: BSD-3-Clause
"""A vehicle that its moving arm swings, simulated and measured.

    python -m benchmarks.python.uvms_dynamics

A BlueROV2 with a Reach Alpha 5 arm, thrusters off (shared/data/uvms; see tests/support/uvms_runs).
Quasi-static: one gain per axis on the arm's static moment. Dynamics: `bathyal.ArmOnVehicle` with
four numbers of the hull, two an axis. Both are fitted to the same six runs and assessed on the
other 13; angles about each run's mean, rms over all rows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from tests.support import uvms_runs
from tests.support.uvms_runs import about_mean

Array = NDArray[np.float64]


def rms(errors: list[Array]) -> float:
    """[deg]"""
    return float(np.degrees(np.sqrt(np.mean(np.concatenate(errors) ** 2))))


def measured(name: str) -> tuple[Array, Array]:
    run = uvms_runs.run(name)
    return about_mean(run.pitch), about_mean(run.roll)


def moments(name: str) -> tuple[Array, Array]:
    """Of the arm, that pitch and roll answer [kg m]."""
    moment = uvms_runs.arm_moment(uvms_runs.run(name).q)
    return about_mean(moment[:, 0]), about_mean(moment[:, 1])


def dynamics(name: str, numbers: Array) -> tuple[Array, Array]:
    roll, pitch = uvms_runs.simulated(name, numbers)
    return about_mean(pitch), about_mean(roll)


def misfit(numbers: Array, names: list[str]) -> Array:
    parts = []
    for name in names:
        for model, seen in zip(dynamics(name, numbers), measured(name), strict=True):
            parts.append(model - seen)
    return np.concatenate(parts)


def main() -> None:
    moving = [name for name in uvms_runs.names() if not name.startswith("baseline")]
    others = [name for name in moving if name not in uvms_runs.FITTED]
    fitted = uvms_runs.FITTED
    start = np.array([*uvms_runs.fit_hull([uvms_runs.run(name) for name in fitted]), 1.0])
    found = least_squares(misfit, start, args=(fitted,), x_scale=np.abs(start), diff_step=1e-3)
    print("## A vehicle that its arm swings, simulated and measured\n\n```")
    print(f"hull Σ m r [kg m], quadratic drag of roll and pitch: {np.round(found.x, 3)}")
    print(f"{'rms [deg]':34} pitch   roll")
    for label, names in (("6 runs fitted", fitted), (f"{len(others)} others", others)):
        seen = [measured(name) for name in names]
        still, moved = [moments(name) for name in names], [dynamics(n, found.x) for n in names]
        rows: dict[str, list[float]] = {"measured": [], "quasi-static": [], "dynamics": []}
        for axis in (0, 1):
            moment = np.concatenate([moments(n)[axis] for n in fitted])
            angle = np.concatenate([measured(n)[axis] for n in fitted])
            gain = moment @ angle / (moment @ moment)
            rows["measured"].append(rms([s[axis] for s in seen]))
            pairs = list(zip(seen, still, moved, strict=True))
            rows["quasi-static"].append(rms([s[axis] - gain * q[axis] for s, q, _ in pairs]))
            rows["dynamics"].append(rms([s[axis] - d[axis] for s, _, d in pairs]))
        for name, (pitch, roll) in rows.items():
            print(f"{label + ', ' + name:34} {pitch:5.2f}  {roll:5.2f}")
    print("```")


if __name__ == "__main__":
    main()
