# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/images/mission.png: the example of a mission, in four views."""

from __future__ import annotations

import tempfile
from pathlib import Path

from small_png import save_png

import bathyal
from bathyal.mission.example import write_mission_example

HERE = Path(__file__).parent


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mission.yaml"
        write_mission_example(path)
        run = bathyal.run(path, seed=1, out=Path(folder) / "run")
        save_png(run.plot(), HERE / "images" / "mission.png", dpi=90)


if __name__ == "__main__":
    main()
