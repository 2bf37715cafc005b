# SPDX-License-Identifier: BSD-3-Clause
"""The main job from end to end: soundings and camera axes in, an oriented tool path out."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import ToolPath, plan_toolpath
from bathyal.errors import argument_error
from bathyal.io.files import PathLike
from bathyal.io.provenance import Step, file_facts
from bathyal.io.result_sets import filling
from bathyal.seabed.bottom import Bottom, make_bottom
from bathyal.toolpath.aims import read_axes


@dataclass(frozen=True)
class Plan:
    """A tool path with everything it was made from; `write` makes the files of `bathyal plan`.

    Attributes
    ----------
    bottom : Bottom
        What the path was planned on.
    aims : (N, 6) array
        Camera axes: position [m] and direction of each, in the frame of the survey.
    path : ToolPath
    settings : dict
        Options that were given.
    provenance : dict
        What was read.
    seconds : dict of str to float
        Time that each stage took [s].
    """

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
            "status": {str(name): int((status == name).sum()) for name in np.unique(status)},
            "samples": len(path.position),
            "length_m": float(path.arc_length[-1]),
            "duration_s": float(path.time[-1]),
            "gaps": int(np.count_nonzero(path.gap)),
            "crossings": int(np.count_nonzero(path.crossing)),
            "contacts": int(np.count_nonzero(path.contact)),
        }

    @property
    def facts(self) -> dict[str, str]:
        """The summary as text, for pictures and people."""
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

        A manifest with their hashes is written last.

        Parameters
        ----------
        folder : path
            Made where it is missing; other files in it are left alone, but for those that an
            earlier run of the same job wrote and this one does not.
        title : str
        step : callable, optional
            ``with step("Writing …"):`` is put around each stage, for progress.
        """
        from bathyal.seabed.meshes import write_mesh
        from bathyal.toolpath.paths import write_path
        from bathyal.view.figure import plan_figure, write_png
        from bathyal.view.html import write_html
        from bathyal.view.scene3d import show_plan

        step = step or nullcontext
        datum = {"crs": self.bottom.crs, "vertical_datum": self.bottom.vertical_datum}
        texts: dict[str, Any] = {"facts": self.facts, "warnings": self.warnings, "title": title}
        with filling(folder, "plan") as aside:
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
                    self.bottom.surface, self.aims, self.path, crs=self.bottom.crs, **texts
                )
                write_png(figure, aside / "plan.png")
            with step("Drawing the page"):
                view = show_plan(self.bottom.surface, self.aims, self.path)
                write_html(view, aside / "plan.html", **texts)
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
        Pose of the vehicle [m], for aims in its frame and for ``vertical="vehicle"``; it takes the
        place of one in the file of the aims.
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
        read = read_axes(aims, world_from_vehicle=world_from_vehicle)
    settings = dict(path or {})
    if read.world_from_vehicle is not None:
        settings["world_from_vehicle"] = read.world_from_vehicle
    elif settings.get("vertical") == "vehicle":
        expected = "the vehicle's pose where vertical is the vehicle's, here or in the aims' .json"
        raise argument_error("world_from_vehicle", f"{expected} (--world-from-vehicle)", None)
    ground = make_bottom(source, step=timed, **(bottom or {}))
    with timed("Planning the path"):
        toolpath = plan_toolpath(ground.surface, read.axes, frame="world", **settings)
    return Plan(
        bottom=ground,
        aims=read.axes,
        path=toolpath,
        settings={"bottom": ground.settings, "path": settings},
        provenance={"bathyal": version("bathyal"), **ground.provenance, "aims": file_facts(aims)},
        seconds=timed.seconds,
    )


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
