# SPDX-License-Identifier: BSD-3-Clause
"""The main job from end to end: soundings and camera axes in, an oriented tool path out."""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import (
    Error,
    Plane,
    PointCloud,
    Scene,
    ToolPath,
    TriangleMesh,
    clean_cloud,
    fit_plane,
    plan_toolpath,
)
from bathyal.aims import read_aims
from bathyal.clouds import read_cloud
from bathyal.meshes import read_mesh
from bathyal.terrain import triangulate

PathLike = str | os.PathLike[str]
Step = Callable[[str], AbstractContextManager[Any]]

# Files that hold faces, and files that may hold either.
MESH_SUFFIXES = (".dae", ".obj", ".stl")
EITHER_SUFFIXES = (".ply", ".vtp")


@dataclass(frozen=True)
class Bottom:
    """What a path is planned on, and how it came about.

    surface : Scene or Plane
    mesh : TriangleMesh or None
        None where the bottom is a plane.
    soundings : int
        How many the bottom rests on; 0 for a mesh that was given.
    settings, provenance : dict
        Options that were given, and what was read and dropped.
    """

    surface: Scene | Plane
    mesh: TriangleMesh | None
    soundings: int
    crs: str
    vertical_datum: str
    settings: dict[str, Any] = field(default_factory=dict)
    provenance: dict[str, Any] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Plan:
    """A tool path with everything it was made from; `write` makes the files of `bathyal plan`."""

    bottom: Bottom
    aims: NDArray[np.float64]
    path: ToolPath
    settings: dict[str, Any]
    provenance: dict[str, Any]
    seconds: dict[str, float]

    @property
    def warnings(self) -> list[str]:
        """What a person should know before the path is followed."""
        return [*self.bottom.warnings, *self.path.warnings]

    @property
    def summary(self) -> dict[str, Any]:
        """Counts and lengths, SI units in the names."""
        path, status = self.path, np.asarray(self.path.targets.status)
        found = np.isfinite(path.targets.point).all(axis=1)
        mesh = self.bottom.mesh
        return {
            "soundings": self.bottom.soundings,
            "triangles": 0 if mesh is None else len(mesh.triangles),
            "aims": len(status),
            "targets": int(found.sum()),
            "status": {str(word): int((status == word).sum()) for word in np.unique(status)},
            "samples": len(path.position),
            "length_m": float(path.arc_length[-1]),
            "duration_s": float(path.time[-1]),
            "gaps": int(np.count_nonzero(path.gap)),
            "crossings": int(np.count_nonzero(path.crossing)),
            "contacts": int(np.count_nonzero(path.contact)),
        }

    @property
    def facts(self) -> dict[str, str]:
        """The summary in words, for pictures and people."""
        count = self.summary
        if self.bottom.mesh is None:
            bottom = {"bottom": "a plane", "soundings": f"{count['soundings']:,}"}
        elif self.bottom.soundings:
            bottom = {
                "soundings": f"{count['soundings']:,}", "triangles": f"{count['triangles']:,}"
            }  # fmt: skip
        else:
            bottom = {"bottom": "mesh as given", "triangles": f"{count['triangles']:,}"}
        return {
            **bottom,
            "targets": f"{count['targets']} of {count['aims']} aims",
            "path length": f"{count['length_m']:.4g} m",
            "duration": _duration_text(count["duration_s"]),
            "samples": f"{count['samples']:,}",
            **({"gaps": str(count["gaps"])} if count["gaps"] else {}),
        }

    def write(self, folder: PathLike, *, title: str = "", step: Step | None = None) -> list[Path]:
        """Write path.csv, path.json, path.vtp, plan.png, plan.html and, where the bottom is a mesh,
        seabed.vtp. All are made aside first: the folder gets either all of them or none.

        Parameters
        ----------
        folder : path
            Made where it is missing; other files in it are left alone.
        title : str
        step : callable, optional
            ``with step("Writing …"):`` is put around each stage, for progress.
        """
        from bathyal.figures import plan_figure, write_png
        from bathyal.meshes import write_mesh
        from bathyal.paths import write_path
        from bathyal.views import show_plan, write_html

        step = step or nullcontext
        datum = {"crs": self.bottom.crs, "vertical_datum": self.bottom.vertical_datum}
        told: dict[str, Any] = {"facts": self.facts, "warnings": self.warnings, "title": title}
        with _all_or_nothing(Path(folder)) as aside:
            with step("Writing the path"):
                for suffix in ("csv", "vtp"):
                    write_path(self.path, aside / f"path.{suffix}", **datum)
                write_path(
                    self.path, aside / "path.json", **datum, provenance=self.provenance,
                    settings=self.settings, summary=self.summary, warnings=self.warnings,
                )  # fmt: skip
            if self.bottom.mesh is not None:
                with step("Writing the seabed"):
                    write_mesh(self.bottom.mesh, aside / "seabed.vtp")
            with step("Drawing the picture"):
                figure = plan_figure(
                    self.bottom.surface, self.aims, self.path, crs=self.bottom.crs, **told
                )
                write_png(figure, aside / "plan.png")
            with step("Drawing the page"):
                view = show_plan(self.bottom.surface, self.aims, self.path)
                write_html(view, aside / "plan.html", **told)
            names = sorted(file.name for file in aside.iterdir())
        return [Path(folder) / name for name in names]


def plan(
    source: PathLike,
    aims: PathLike,
    *,
    bottom: Mapping[str, Any] | None = None,
    world_from_vehicle: NDArray[np.float64] | None = None,
    path: Mapping[str, Any] | None = None,
    step: Step | None = None,
) -> Plan:
    """Read, clean, triangulate, find the targets and plan: what `bathyal plan` does.

    Parameters
    ----------
    source : path
        Soundings or a mesh.
    aims : path
        Camera axes; see `read_aims`.
    bottom : mapping, optional
        Keywords of `make_bottom`.
    world_from_vehicle : (4, 4) array, optional
        Pose of the vehicle; the aims stand in its frame when it is given [m].
    path : mapping, optional
        Keywords of `plan_toolpath`.
    step : callable, optional
        ``with step("Reading …"):`` is put around each stage, for progress.

    Returns
    -------
    Plan
    """
    timed = _Timed(step)
    with timed("Reading the aims"):
        axes = read_aims(aims, world_from_vehicle=world_from_vehicle)
    ground = make_bottom(source, step=timed, **(bottom or {}))
    pose = {} if world_from_vehicle is None else {"world_from_vehicle": world_from_vehicle}
    settings = {**(path or {}), **pose}
    with timed("Planning the path"):
        toolpath = plan_toolpath(ground.surface, axes, frame="world", **settings)
    return Plan(
        bottom=ground,
        aims=axes,
        path=toolpath,
        settings={"bottom": ground.settings, "path": settings},
        provenance={"bathyal": version("bathyal"), **ground.provenance, "aims": _file_facts(aims)},
        seconds=timed.seconds,
    )


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
    told: list[str] = []
    with step("Reading the bottom"), noting(told):
        what = read_either(source, as_mesh, read)
    told[:] = [line.replace(str(source), Path(source).name) for line in told]
    settings = {"read": read, "clean": clean, "triangulate": mesh, "plane": as_plane}
    provenance: dict[str, Any] = {"input": _file_facts(source)}
    datum: dict[str, Any] = {"crs": what.crs, "vertical_datum": what.vertical_datum}
    if isinstance(what, TriangleMesh) and not as_plane:
        if clean or mesh:
            given = sorted({**clean, **mesh})[0]
            raise ValueError(f"`{given}`: expected with soundings only, {source} is a mesh")
        with step("Building the scene"):
            scene = Scene(what)
        return Bottom(
            scene, what, 0, settings=settings, provenance=provenance, warnings=told, **datum
        )
    cloud = PointCloud(what.vertices, **datum) if isinstance(what, TriangleMesh) else what
    with step("Cleaning the soundings"):
        cleaned = clean_cloud(cloud, **clean)
    provenance["cleaning"] = cleaned.report.as_dict()
    cloud = cleaned.cloud
    told += _told_by_cleaning(cleaned.report.as_dict())
    common: dict[str, Any] = {
        "settings": settings,
        "provenance": provenance,
        "warnings": told,
        **datum,
    }
    if as_plane:
        with step("Fitting the plane"):
            fit = fit_plane(cloud)
        provenance["plane"] = {
            "normal": fit.normal, "offset_m": fit.offset, "rms_m": fit.rms, "flat": fit.flat,
            "relief_m": fit.relief, "inliers": fit.inlier_count, "tilt_std_rad": fit.tilt_std,
        }  # fmt: skip
        if not fit.flat:
            told.append(
                f"the bottom is not flat: parts of it lie up to {fit.relief:.3g} m off the plane "
                f"(rms {fit.rms:.3g} m); plan on a mesh"
            )
        return Bottom(fit.plane, None, len(cloud), **common)
    with step("Triangulating"), noting(told):
        seabed = triangulate(cloud, **mesh)
    with step("Building the scene"):
        scene = Scene(seabed)
    return Bottom(scene, seabed, len(cloud), **common)


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
            return read_cloud(source, **read)  # tells in its turn what is broken
    return read_cloud(source, **read)


def _mesh_with_datum(source: PathLike, read: Mapping[str, Any]) -> TriangleMesh:
    rest = {key: value for key, value in read.items() if key not in ("crs", "vertical_datum")}
    if unknown := sorted(set(rest) - {"scale", "up"}):
        raise ValueError(f"`{unknown[0]}`: expected with soundings only, {source} is a mesh")
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


def _told_by_cleaning(report: Mapping[str, int]) -> list[str]:
    """Every sounding that was dropped is said; so are depths that contradict each other."""
    told = [
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
        told.append(f"{report['same_place']:,} soundings share their place with another depth")
    return told


def _file_facts(path: PathLike) -> dict[str, Any]:
    digest = hashlib.sha256()
    with open(path, "rb") as stream:
        while block := stream.read(1 << 20):
            digest.update(block)
        size = stream.tell()
    return {"file": Path(path).name, "bytes": size, "sha256": digest.hexdigest()}


def _duration_text(seconds: float) -> str:
    if seconds < 120:
        return f"{seconds:.3g} s"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02d} min" if hours else f"{minutes} min {rest:02d} s"


class _Timed:
    """Hands each stage on to `step` and notes how long it took."""

    def __init__(self, step: Step | None) -> None:
        self.seconds: dict[str, float] = {}
        self._step = step or nullcontext

    @contextmanager
    def __call__(self, name: str) -> Iterator[None]:
        begin = time.perf_counter()
        with self._step(name):
            yield
        self.seconds[name] = time.perf_counter() - begin


@contextmanager
def noting(told: list[str]) -> Iterator[None]:
    """Python's warnings become lines of the plan's own."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    told += [str(warning.message) for warning in caught]


@contextmanager
def _all_or_nothing(folder: Path) -> Iterator[Path]:
    """A hidden folder inside `folder` to write to; its files move up when all went well."""
    made = not folder.exists()
    folder.mkdir(parents=True, exist_ok=True)
    aside = Path(tempfile.mkdtemp(prefix=".plan-", dir=folder))
    try:
        yield aside
        for file in sorted(aside.iterdir()):
            os.replace(file, folder / file.name)
    except BaseException:
        shutil.rmtree(aside, ignore_errors=True)
        if made and not any(folder.iterdir()):
            folder.rmdir()
        raise
    shutil.rmtree(aside)
