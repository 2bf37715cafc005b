# SPDX-License-Identifier: BSD-3-Clause
"""From a file of soundings, or of a mesh, to a bottom that a path can be planned on."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from bathyal._core import (
    Error,
    Plane,
    PointCloud,
    Scene,
    TriangleMesh,
    clean_cloud,
    fit_plane,
)
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, shown
from bathyal.io.formats.crs import check_metric
from bathyal.io.provenance import Step, file_facts
from bathyal.seabed.clouds import read_cloud
from bathyal.seabed.meshes import read_mesh
from bathyal.seabed.triangulate import triangulate

# Files that hold faces, and files that may hold either.
MESH_SUFFIXES = (".3ds", ".dae", ".glb", ".gltf", ".obj", ".stl")
EITHER_SUFFIXES = (".ply", ".vtp")


@dataclass(frozen=True)
class Bottom:
    """What a path is planned on, and how it was made.

    Attributes
    ----------
    surface : Scene or Plane
        What rays and sections meet, in the frame of the survey [m], z up.
    mesh : TriangleMesh or None
        None where the bottom is a plane.
    soundings : int
        How many the bottom rests on; 0 for a mesh that was given.
    crs, vertical_datum : str
        Reference systems of x, y and of z; empty if unknown.
    settings : dict
        Options that were given.
    provenance : dict
        What was read and dropped.
    warnings : list of str
        What a person should know before a path is planned on it.
    """

    surface: Scene | Plane
    mesh: TriangleMesh | None
    soundings: int
    crs: str
    vertical_datum: str
    settings: dict[str, Any] = field(default_factory=dict)
    provenance: dict[str, Any] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


def make_bottom(
    source: PathLike,
    *,
    as_mesh: bool | None = None,
    as_plane: bool = False,
    read: Mapping[str, Any] | None = None,
    clean: Mapping[str, Any] | None = None,
    mesh: Mapping[str, Any] | None = None,
    step: Step | None = None,
) -> Bottom:
    """A file of soundings or a mesh as something that a path can be planned on.

    Parameters
    ----------
    source : path
        Soundings or a mesh.
    as_mesh : bool, optional
        Whether to take the file's own faces. By default they are taken where it has any.
    as_plane : bool
        Fit a plane to the soundings in place of a mesh.
    read, clean, mesh : mapping, optional
        Keywords of `read_cloud` or `read_mesh`, `clean_cloud`, and `triangulate`.
    step : callable, optional
        As in `plan`.
    """
    step = step or nullcontext
    read, clean, mesh = dict(read or {}), dict(clean or {}), dict(mesh or {})
    lines: list[str] = []
    provenance: dict[str, Any] = {"input": file_facts(source)}
    with step("Reading the bottom"), noting(lines):
        what = read_either(source, as_mesh, read)
    lines[:] = [line.replace(str(source), shown(Path(source).name)) for line in lines]
    soundings = 0
    surface: Scene | Plane
    seabed: TriangleMesh | None = None
    if isinstance(what, TriangleMesh) and not as_plane:
        _refuse({**clean, **mesh}, "with soundings only", f"it with the mesh {source}")
        seabed = what
    else:
        with step("Cleaning the soundings"):
            cloud = _cleaned(what, clean, provenance, lines)
        soundings = len(cloud)
        if as_plane:
            _refuse(mesh, "for a mesh only", "it for a plane")
            with step("Fitting the plane"):
                surface = _fitted(cloud, provenance, lines)
        else:
            with step("Triangulating"), noting(lines):
                seabed = triangulate(cloud, **mesh)
    if seabed is not None:
        with step("Building the scene"):
            surface = Scene(seabed)
    return Bottom(
        surface,
        seabed,
        soundings,
        crs=what.crs,
        vertical_datum=what.vertical_datum,
        settings={"read": read, "clean": clean, "triangulate": mesh, "plane": as_plane},
        provenance=provenance,
        warnings=lines,
    )


def _refuse(options: Mapping[str, Any], expected: str, got: str) -> None:
    if options:
        raise argument_error(min(options), expected, got)


def _cleaned(
    what: PointCloud | TriangleMesh,
    options: Mapping[str, Any],
    provenance: dict[str, Any],
    lines: list[str],
) -> PointCloud:
    if isinstance(what, TriangleMesh):
        what = PointCloud(what.vertices, crs=what.crs, vertical_datum=what.vertical_datum)
    cleaned = clean_cloud(what, **options)
    provenance["cleaning"] = cleaned.report.as_dict()
    lines += _dropped_by_cleaning(cleaned.report.as_dict())
    return cleaned.cloud


def _fitted(cloud: PointCloud, provenance: dict[str, Any], lines: list[str]) -> Plane:
    fit = fit_plane(cloud)
    provenance["plane"] = {
        "normal": fit.normal, "offset_m": fit.offset, "rms_m": fit.rms, "flat": fit.flat,
        "relief_m": fit.relief, "inliers": fit.inlier_count, "tilt_std_rad": fit.tilt_std,
    }  # fmt: skip
    if not fit.flat:
        lines.append(
            f"the bottom is not flat: parts of it lie up to {fit.relief:.3g} m off the plane "
            f"(rms {fit.rms:.3g} m); plan on a mesh"
        )
    return fit.plane


def read_either(
    source: PathLike, as_mesh: bool | None, read: Mapping[str, Any]
) -> PointCloud | TriangleMesh:
    """A file as a mesh or as a cloud; where it may be either, as a mesh if it has faces."""
    suffix = Path(source).suffix.lower()
    if as_mesh or (as_mesh is None and suffix in MESH_SUFFIXES):
        return _mesh_with_datum(source, read)
    if as_mesh is None and suffix in EITHER_SUFFIXES:
        try:
            return _mesh_with_datum(source, read)
        except (Error, ValueError):
            return read_cloud(source, **read)  # its error says what is broken
    return read_cloud(source, **read)


def _mesh_with_datum(source: PathLike, read: Mapping[str, Any]) -> TriangleMesh:
    rest = {key: value for key, value in read.items() if key not in ("crs", "vertical_datum")}
    if unknown := sorted(set(rest) - {"scale", "up"}):
        raise argument_error(unknown[0], "with soundings only", f"it with the mesh {source}")
    if read.get("crs"):
        check_metric("crs", read["crs"])
    mesh = read_mesh(source, **rest)
    if len(rest) == len(read):
        return mesh
    return TriangleMesh(
        mesh.vertices,
        mesh.triangles,
        attributes=mesh.attributes,
        crs=read.get("crs", mesh.crs),
        vertical_datum=read.get("vertical_datum", mesh.vertical_datum),
    )


def _dropped_by_cleaning(report: Mapping[str, int]) -> list[str]:
    """Counts of soundings that were dropped, by reason, and of depths that contradict others."""
    lines = [
        f"{report[name]:,} of {report['before']:,} soundings dropped: {why}"
        for name, why in (
            ("not_finite", "not a number"),
            ("duplicates", "exact duplicates"),
            ("same_place_dropped", "another depth at the same place"),
            ("spikes", "spikes"),
            ("outliers", "outliers"),
            ("thinned", "thinned by voxels, as asked"),
        )
        if report[name]
    ]
    if report["same_place"] > report["same_place_dropped"]:
        lines.append(f"{report['same_place']:,} soundings share their place with another depth")
    return lines


@contextmanager
def noting(lines: list[str]) -> Iterator[None]:
    """Python's warnings become lines of the plan's own."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    lines += [str(warning.message) for warning in caught]
