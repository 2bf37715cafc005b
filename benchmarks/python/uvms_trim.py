# SPDX-License-Identifier: BSD-3-Clause
"""The trim that an arm gives a freely floating vehicle, predicted and measured.

    python -m benchmarks.python.uvms_trim

A BlueROV2 with a Reach Alpha 5 arm, thrusters off (shared/data/uvms; see tests/support/uvms_runs).
Predicted is `Workspace.static_trim` at each measured posture: weights and buoyancies alone, no
inertia, added mass, drag or tether. Roll and pitch are the IMU's; x forward, y port, z up, so
positive pitch is nose down. Of the hull one vector enters, Σ m r − ρ Σ V r: estimated from all
other runs by least squares ("others"), or as the authors of the recordings found it ("authors'",
nothing estimated here). Swings are largest less smallest value within a run.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tests.support import uvms_runs

Array = NDArray[np.float64]
LEAST_SWING = 2.0  # of which a correlation is given [deg]


def swings(measured: Array, others: Array, authors: Array) -> str:
    """Swings in degrees, and how the prediction from the other runs fits."""
    swing, predicted, by_authors = (float(np.ptp(values)) for values in (measured, others, authors))
    rms = float(np.sqrt(np.mean((measured - others) ** 2)))
    still = swing < LEAST_SWING or predicted == 0
    fit = "    -" if still else f"{np.corrcoef(measured, others)[0, 1]:5.2f}"
    return f"{swing:6.1f} {predicted:6.1f} {by_authors:6.1f} {fit} {rms:5.2f}"


def main() -> None:
    runs = [uvms_runs.run(name) for name in uvms_runs.names()]
    moving = [run for run in runs if not run.name.startswith("baseline")]
    by_authors = uvms_runs.workspace(uvms_runs.AUTHORS_HULL)
    print("## Trim of a vehicle by its arm, predicted and measured\n\n```")
    head = "swing: measured, others', authors' [deg]; r; rms [deg]"
    print(f"{'run':10}  pitch {head}\n{'':10}  roll likewise")
    hulls, errors = [], []
    for run in runs:
        hulls.append(uvms_runs.fit_hull([other for other in moving if other is not run]))
        found = uvms_runs.workspace(hulls[-1]).static_trim(run.q, water_density=uvms_runs.WATER)
        known = by_authors.static_trim(run.q, water_density=uvms_runs.WATER)
        angles = [(run.pitch, found.pitch, known.pitch), (run.roll, found.roll, known.roll)]
        in_degrees = [tuple(np.degrees(values) for values in axis) for axis in angles]
        print(f"{run.name:10} {swings(*in_degrees[0])} | {swings(*in_degrees[1])}")
        if run in moving:
            errors.append([float(np.mean((m - o) ** 2)) for m, o, _ in in_degrees])
    low, high = np.min(hulls, axis=0), np.max(hulls, axis=0)
    print(f"\nhull Σ m r − ρ Σ V r [kg m], least and greatest of the {len(hulls)} estimates:")
    print(f"  {np.round(low, 3)} to {np.round(high, 3)}; the authors' {uvms_runs.AUTHORS_HULL}")
    print(f"rms over the {len(moving)} moving runs, pitch and roll [deg]:", end=" ")
    print(np.round(np.sqrt(np.mean(errors, axis=0)), 2))
    print("```")


if __name__ == "__main__":
    main()
