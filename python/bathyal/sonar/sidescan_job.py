# SPDX-License-Identifier: BSD-3-Clause
"""What is made of a side-scan's file: pictures, first returns, a mosaic; in a folder."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bathyal.io.files import PathLike, replacing
from bathyal.sonar.record import SonarRecord
from bathyal.sonar.sidescan import BottomTrack


@dataclass(frozen=True)
class SidescanProducts:
    """What was written, and what is to be said of it."""

    files: list[Path]
    warnings: list[str]


def write_products(
    record: SonarRecord, bottom: BottomTrack, out: PathLike, *, spacing: float
) -> SidescanProducts:
    """Writes waterfall.png, ground.png, bottom.csv and, where there are positions, mosaic.png and
    mosaic.tif.

    Parameters
    ----------
    record : SonarRecord
        Of a side-scan.
    bottom : BottomTrack
        Of that record.
    out : path
        A folder, made where it is missing.
    spacing : float
        Of the mosaic's cells [m].

    Raises
    ------
    ValueError
        For a record that is no side-scan's, or an empty one.
    """
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    files, warnings = [], []
    nav = record.navigation
    figures = {
        "waterfall.png": record.plot(bottom=bottom),
        "ground.png": record.to_ground(bottom=bottom).plot(),
    }
    placed = nav.longitude is not None or np.isfinite(nav.position[:, :2]).any()
    if placed and np.isfinite(nav.heading).any():
        mosaic = record.mosaic(bottom=bottom, spacing=spacing)
        figures["mosaic.png"] = mosaic.plot()
        files.append(folder / "mosaic.tif")
        mosaic.write(files[-1])
        if mosaic.left_out:
            warnings.append(
                f"{mosaic.left_out} of {len(record)} pings have no position or heading and are "
                "not in the mosaic"
            )
    else:
        warnings.append("no mosaic: the file has no positions or no headings")
    for name, figure in figures.items():
        files.append(folder / name)
        with replacing(files[-1]) as path:
            figure.savefig(path, format="png")
    files.append(folder / "bottom.csv")
    columns = [record.time, *bottom.range.T, np.asarray(nav.altitude)]
    header = ",".join(["time", *(f"first_return_{name}" for name in record.beam_names), "altitude"])
    with replacing(files[-1]) as path:
        np.savetxt(
            path, np.column_stack(columns), fmt="%.4f", delimiter=",", header=header, comments=""
        )
    return SidescanProducts(files, warnings)
