# SPDX-License-Identifier: BSD-3-Clause
"""What a sonar does in Python: surveys. Attached when the package is imported."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from bathyal._core import NavigationErrors, Sonar, Trajectory, World
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
        navigation: NavigationErrors | None = None,
        out: str | os.PathLike[str] | None = None,
        first: int = 0,
        count: int = -1,
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
            Whether what each sample came from is kept, and where the vehicle really was: twelve
            times the memory.
        navigation : NavigationErrors, optional
            Of what the vehicle reports; unless given it reports the truth.
        out : path, optional
            A folder (``survey.zarr``) in which the record is kept as it grows, so that memory does
            not grow with it. A folder that an interrupted survey left is continued; several
            processes may fill one, each its part.
        first, count : int
            Which of the pings; −1 is to the end. Parts join to the bytes of the whole.
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
            As `Sonar.ping`, with the ping's number; for a folder of another survey, or of anything
            else.
        OSError
            Where the folder cannot be written. What is there stays readable.
        """
        from bathyal.sonar.survey import survey

        return survey(
            self, world, trajectory,
            seed=seed, truth=truth, navigation=navigation, out=out, first=first, count=count,
            progress=progress, num_threads=num_threads,
        )  # fmt: skip
