# SPDX-License-Identifier: BSD-3-Clause
"""The bottom as a mesh: `triangulate` and the warning that it may raise."""

from __future__ import annotations

import warnings
from typing import Any

from numpy.typing import ArrayLike

from bathyal import _core, optional
from bathyal._core import PointCloud, SheetReport, TriangleMesh
from bathyal.errors import argument_error


class SheetWarning(UserWarning):
    """The cloud has several sheets over one (x, y): a height field cannot hold it.

    Attributes
    ----------
    report : SheetReport
        Where and how much.
    """

    def __init__(self, report: SheetReport) -> None:
        super().__init__(
            f"{report} A height field cannot hold that, its surface jumps from sheet to sheet: "
            'use method="greedy" or a mesh of the place itself; where passes over the same ground '
            "disagree in height, correct them first."
        )
        self.report = report


def triangulate(
    cloud: PointCloud | ArrayLike, *, method: str = "delaunay", **options: Any
) -> TriangleMesh:
    """Make a seabed from soundings.

    The mesh keeps the cloud's points row for row, in the same memory, with their attributes,
    coordinate reference system and vertical datum; triangles run counter-clockwise seen from above.

    Parameters
    ----------
    cloud : PointCloud or (N, 3) array
        [m], z up. Finite: `clean_cloud` drops what is not.
    method : {"delaunay", "greedy"}
        "delaunay" is our own exact 2.5-D triangulation: the bottom as a height field. "greedy" is
        PCL's greedy projection triangulation (Marton, Rusu, Beetz 2009), as in Filaretov, Konoplin,
        Konoplin (2018): slower, but it takes overhangs; it needs the optional extension ``_pcl``.
    **options
        Of "delaunay": ``max_edge`` [m], the longest horizontal edge, so that gaps in the coverage
        stay gaps (None: 5 times the median longest edge of a triangle; ``math.inf``: no limit), and
        ``num_threads``. Of "greedy": PCL's parameters, see ``help(bathyal._pcl)``.

    Returns
    -------
    TriangleMesh

    Warns
    -----
    SheetWarning
        With "delaunay", where the cloud has several sheets over one (x, y); see `find_sheets`.

    Raises
    ------
    ValueError
        For an unknown method, points that are not finite, and fewer than three points that are not
        on one line.
    Error
        For "greedy" without the extension.

    Examples
    --------
    >>> import bathyal
    >>> bathyal.triangulate([[0, 0, -5], [1, 0, -5], [0, 1, -5.2], [1, 1, -5.1]])
    TriangleMesh(4 vertices, 2 triangles)
    """
    if method == "delaunay":
        mesh, sheets = _core.triangulate(cloud, **options)
        if sheets:
            warnings.warn(SheetWarning(sheets), stacklevel=2)
        return mesh
    if method == "greedy":
        return _triangulate_greedy(cloud, **options)
    raise argument_error("method", '"delaunay" or "greedy"', repr(method))


def _triangulate_greedy(cloud: PointCloud | ArrayLike, **options: Any) -> TriangleMesh:
    pcl = optional.pcl('method="greedy"', 'method="delaunay"')
    if not isinstance(cloud, PointCloud):
        cloud = PointCloud(cloud)
    return TriangleMesh(
        cloud.points,
        pcl.triangulate_greedy(cloud.points, **options),
        attributes=cloud.attributes,
        crs=cloud.crs,
        vertical_datum=cloud.vertical_datum,
    )
