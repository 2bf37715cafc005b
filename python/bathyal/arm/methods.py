# SPDX-License-Identifier: BSD-3-Clause
"""What arms do in Python: files and figures. Attached when the package is imported."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from bathyal._core import Arm, CorrectedArm, Link
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import matplotlib.figure
    import numpy
    import numpy.typing
    import plotly.graph_objects  # type: ignore[import-untyped]


@methods_of(Arm)
class _Arm(Arm):
    @staticmethod
    def from_urdf(
        path: str | os.PathLike[str],
        *,
        tip: str | None = None,
        root: str | None = None,
        name: str | None = None,
    ) -> Arm:
        """An arm from one path of a URDF's tree.

        Parameters
        ----------
        path : path
            A URDF; xacro must be expanded first. Meshes are never opened.
        tip : str, optional
            The link, or the joint whose child link, becomes the flange. Needed where the tree has
            several ends.
        root : str, optional
            The link that becomes the base; the root of the tree unless given.
        name : str, optional
            The robot's own unless given.

        All of it: bathyal.arm.urdf_reader.arm_from_urdf.
        """
        from bathyal.arm.urdf_reader import arm_from_urdf

        return arm_from_urdf(path, tip=tip, root=root, name=name)

    def to_urdf(self, path: str | os.PathLike[str] | None = None) -> str:
        """The arm as the text of a URDF.

        Parameters
        ----------
        path : path, optional
            Where to write it, too: see bathyal.arm.urdf_writer.urdf_of_arm.
        """
        from bathyal.arm.urdf_writer import urdf_of_arm

        return urdf_of_arm(self, path)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all of it to a file for bathyal.read_arm.

        Parameters
        ----------
        path : path
            ``.json``: see bathyal.arm.files.save_arm.
        """
        from bathyal.arm.files import save_arm

        save_arm(self, path)

    def write(self, path: str | os.PathLike[str], *, nominal: Arm | None = None) -> None:
        """Write a file of the format its suffix names.

        Parameters
        ----------
        path : path
            ``.json``, ``.urdf``, ``.yaml``, ``.yml`` or ``.conf``: see bathyal.arm.files.write_arm.
        nominal : Arm, optional
            For ``.conf``: the maker's arm, from which the file gives the differences.
        """
        from bathyal.arm.files import write_arm

        write_arm(self, path, nominal=nominal)

    def show(self, q: numpy.typing.ArrayLike | None = None) -> plotly.graph_objects.Figure:
        """An interactive figure of the arm.

        Parameters
        ----------
        q : (n,) or (N, n) array, optional
            [rad] or [m]; at rest unless given: see bathyal.view.arm_views.show_arm.
        """
        from bathyal.view.arm_views import show_arm

        return show_arm(self, q)

    def plot(
        self,
        q: numpy.typing.ArrayLike | None = None,
        path: str | os.PathLike[str] | None = None,
    ) -> matplotlib.figure.Figure:
        """A picture of the arm.

        Parameters
        ----------
        q : (n,) or (N, n) array, optional
            [rad] or [m]; at rest unless given.
        path : path, optional
            ``.png``, ``.pdf`` or ``.svg`` to write it to, too: see bathyal.view.arm_views.plot_arm.
        """
        from bathyal.view.arm_views import plot_arm

        return plot_arm(self, q, path)


@methods_of(CorrectedArm)
class _CorrectedArm(CorrectedArm):
    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all of it to a file for bathyal.read_arm.

        Parameters
        ----------
        path : path
            ``.json``: see bathyal.arm.corrected_files.save_corrected_arm.
        """
        from bathyal.arm.corrected_files import save_corrected_arm

        save_corrected_arm(self, path)

    def write(self, path: str | os.PathLike[str]) -> None:
        """As `save`."""
        self.save(path)

    @property
    def joint_names(self) -> list[str]:
        """As of `Arm`."""
        return self.arm.joint_names

    @property
    def joint_types(self) -> list[str]:
        """As of `Arm`."""
        return self.arm.joint_types

    @property
    def link_names(self) -> list[str]:
        """As of `Arm`."""
        return self.arm.link_names

    @property
    def links(self) -> list[Link]:
        """As of `Arm`."""
        return self.arm.links

    @property
    def lower(self) -> numpy.ndarray:
        """As of `Arm`."""
        return self.arm.lower

    @property
    def upper(self) -> numpy.ndarray:
        """As of `Arm`."""
        return self.arm.upper

    @property
    def velocity(self) -> numpy.ndarray:
        """As of `Arm`."""
        return self.arm.velocity

    @property
    def effort(self) -> numpy.ndarray:
        """As of `Arm`."""
        return self.arm.effort

    def within_limits(self, q: numpy.typing.ArrayLike) -> bool | numpy.ndarray:
        """As of `Arm`."""
        return self.arm.within_limits(q)

    def to_urdf(self, path: str | os.PathLike[str] | None = None) -> str:
        """As of `Arm`: the rigid part alone."""
        return self.arm.to_urdf(path)

    def show(self, q: numpy.typing.ArrayLike | None = None) -> plotly.graph_objects.Figure:
        """As of `Arm`: the rigid part alone."""
        return self.arm.show(q)

    def plot(
        self,
        q: numpy.typing.ArrayLike | None = None,
        path: str | os.PathLike[str] | None = None,
    ) -> matplotlib.figure.Figure:
        """As of `Arm`: the rigid part alone."""
        return self.arm.plot(q, path)
