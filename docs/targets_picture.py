# SPDX-License-Identifier: BSD-3-Clause
"""Draws the targets of Maevskiy, Zanin (2020), figures 7, 7′ and 7″: ahead, to port, in the hull.

Run as ``python docs/targets_picture.py docs/images/targets.png``. The paper's arm on the hull of
the example scenario: theirs is not published.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import bathyal
from bathyal.view.motion_frames import write_frames
from bathyal.workspace.example import write_example
from bathyal.workspace.motion import motion_of

TARGETS = {
    "7   ahead": (1.7, 0.0, -51.0),
    "7′  to port": (1.1, 0.9, -50.9),
    "7″  inside the hull": (0.3, 0.0, -50.2),
}


def main(path: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        write_example(folder)
        scenario = bathyal.read_scenario(Path(folder) / "scenario.yaml")
        ws, start = scenario.workspace, np.asarray(scenario.q_start)
        found = ws.check_target(list(TARGETS.values()))
        figure, grid = plt.subplots(1, 3, figsize=(15, 4.2))
        for k, (name, target) in enumerate(TARGETS.items()):
            q = found.q[k] if found.status[k] == "free" else start
            motion = motion_of(ws, q[None], [0.0], target=target)
            (frame,) = write_frames(motion, Path(folder) / str(k), count=1)
            grid[k].imshow(plt.imread(frame))
            grid[k].set_title(f"{name}: {found.status[k]}", loc="left", fontsize=12)
            grid[k].set_axis_off()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1])
