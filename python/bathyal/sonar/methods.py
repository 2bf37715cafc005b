# SPDX-License-Identifier: BSD-3-Clause
"""What a sonar does in Python: surveys. Attached when the package is imported."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bathyal._core import Sonar, Trajectory, World
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import bathyal.sonar.record
    import bathyal.sonar.survey


@methods_of(Sonar)
class _Sonar(Sonar):
    def survey(
        self,
        world: World,
        trajectory: Trajectory,
        *,
        seed: int = 0,
        truth: bool = False,
        progress: bathyal.sonar.survey.Progress | None = None,
        num_threads: int = 0,
    ) -> bathyal.sonar.record.SonarRecord:
        """Hears a world along a trajectory.

        Parameters
        ----------
        world : World
        trajectory : Trajectory
            world_from_vehicle; a ping every 1 / `ping_rate`, from its first time to its last.
        seed : int
            Of all random numbers; the same seed gives the same bytes.
        truth : bool
            Whether what each sample came from is kept: seven times the memory.
        progress : function, optional
            Called with the pings done and all of them; the survey ends where it returns False.
        num_threads : int
            0 means all; any number gives the same bytes.

        Returns
        -------
        SonarRecord

        Raises
        ------
        ValueError
            As `Sonar.ping`, with the ping's number.
        """
        from bathyal.sonar.survey import survey

        return survey(
            self, world, trajectory,
            seed=seed, truth=truth, progress=progress, num_threads=num_threads,
        )  # fmt: skip
