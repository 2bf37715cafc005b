# SPDX-License-Identifier: BSD-3-Clause
"""A measured side-scan and a simulated one of the same track: picture and table.

Run as ``python docs/real_and_simulated.py ../shared/data/sidescan/scotsman-iver2.xtf docs/images``.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from small_png import save_png

import bathyal
from bathyal.sonar.describe import fit_altitude
from bathyal.sonar.statistics import SidescanStatistics

ORIGIN = np.array([512710.0, 5365850.0, 0.0])  # UTM 19 N
BOTTOM = -27.0  # reported depth and first return come to 26.2 to 27.7 m


def sea() -> bathyal.World:
    """A flat bottom of sand, and a wreck-like block where the measured one lies."""
    world = bathyal.World()
    corners = np.array([[-150, -150, BOTTOM], [150, -150, BOTTOM], [150, 150, BOTTOM],
                        [-150, 150, BOTTOM]])  # fmt: skip
    world.add(bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]]), material="sand")
    wreck = bathyal.make_wreck(24.0, seed=1, beam=7.0, depth=1.5, broken=False)
    along, place = np.radians(122.0), np.eye(4)
    place[:2, :2] = [[np.cos(along), -np.sin(along)], [np.sin(along), np.cos(along)]]
    place[:3, 3] = 5.5, 5.5, BOTTOM
    world.add(wreck, pose=place, material="steel", name="wreck")
    return world


def track(measured: bathyal.SonarRecord) -> bathyal.Trajectory:
    """The reported one, in the world of `sea`."""
    reported = measured.trajectory()
    pose = np.array(reported.pose)
    pose[:, :3, 3] -= ORIGIN
    return bathyal.Trajectory(reported.time, pose)


def sonar(measured: bathyal.SonarRecord) -> bathyal.Sonar:
    """The preset, with the file's range and rate; nothing is fitted."""
    return bathyal.sonars.side_scan(physics="real").replace(
        range=2.0 * measured.range[0] * len(measured.range), samples=len(measured.range),
        ping_rate=1.0 / float(np.median(np.diff(measured.time))),
    )  # fmt: skip


def against_median(level: np.ndarray) -> np.ndarray:
    """Levels less their median: a file says nothing of absolute power."""
    return level - np.nanmedian(level)


def difference(measured: SidescanStatistics, simulated: SidescanStatistics, name: str) -> str:
    """Measured less simulated, by bins [dB]."""
    one, other = (against_median(getattr(found, name)) for found in (measured, simulated))
    rms = np.sqrt(np.nanmean((one - other) ** 2))
    return f"{name}: rms {rms:.1f} dB\n{np.round(one - other, 1)}"


def draw(records: dict[str, bathyal.SonarRecord], found: dict[str, SidescanStatistics]) -> Figure:
    """Waterfalls above, levels below."""
    figure = Figure(figsize=(11, 9.5), dpi=75, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    top, below = figure.subfigures(2, 1, height_ratios=[1.7, 1.0])
    shown = ["measured", "simulated"]
    for axes, name in zip(top.subplots(1, 2), shown, strict=True):
        record = records[name]
        amplitude = np.sqrt(np.asarray(record.intensity, float))
        image = np.concatenate([amplitude[:, 0, ::-1], amplitude[:, 1]], axis=1)
        reach, length = record.range[-1], record.distance()[-1]
        axes.imshow(
            image, cmap="copper", vmin=0, vmax=np.percentile(image, 98), aspect="auto",
            extent=(-reach, reach, length, 0),
        )  # fmt: skip
        axes.set(title=name, xlabel="port    slant range [m]    starboard", ylabel="along [m]")
        axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    colours = {"measured": "black", "simulated": "tab:blue"}
    angle_axes, range_axes = below.subplots(1, 2, sharey=True)
    for name, one in found.items():
        for side, width in ((0, 1.0), (1, 2.0)):
            label = f"{name}, {one.beam_names[side]}"
            angle_axes.plot(
                np.degrees(one.angle), against_median(one.level_by_angle)[side],
                color=colours[name], lw=width, label=label,
            )  # fmt: skip
            range_axes.plot(
                one.range, against_median(one.level_by_range)[side], color=colours[name], lw=width
            )
    angle_axes.set(xlabel="incidence [°]", ylabel="level less its median [dB]")
    range_axes.set(xlabel="slant range [m]")
    angle_axes.legend(fontsize=7)
    return figure


def main(file: str, folder: str) -> None:
    measured = bathyal.read_sonar(file)
    records = {"measured": measured, "simulated": sonar(measured).survey(sea(), track(measured))}
    found = {name: record.statistics() for name, record in records.items()}
    for name, one in found.items():
        print(
            f"{name}: contrast {one.contrast.round(2)}, correlation in range "
            f"{one.correlation_range.round(2)}, over pings {one.correlation_ping.round(2)}, "
            f"at the highest value {one.saturated.round(3)}, water "
            f"{(one.water_level - np.nanmedian(one.level_by_angle)).round(1)} dB"
        )
        first = records[name].track_bottom().altitude
        print(f"  first return: {fit_altitude(first, records[name].navigation.altitude)}")
    for name in ("level_by_angle", "level_by_range"):
        print(difference(found["measured"], found["simulated"], name))
    save_png(draw(records, found), Path(folder) / "real_and_simulated.png", dpi=75)


if __name__ == "__main__":
    main(*sys.argv[1:])
