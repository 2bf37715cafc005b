# SPDX-License-Identifier: BSD-3-Clause
"""A diagnosis to files: a page and a sheet for people, JSON and tables for machines."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bathyal.diagnosis.report.advice import next_steps
from bathyal.diagnosis.report.text import summary
from bathyal.io.files import PathLike, known_suffix, replacing
from bathyal.io.json import json_text
from bathyal.io.tables import write_table

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

SCHEMA = 1
"""Of the JSON; it grows by one when a name changes its meaning or goes."""


def write_diagnosis(
    report: Diagnosis,
    path: PathLike,
    *,
    title: str = "",
    facts: Mapping[str, str] | None = None,
    step: Callable[[float, str], None] | None = None,
    **provenance: Any,
) -> None:
    """Write a diagnosis; what `Diagnosis.write` does.

    Parameters
    ----------
    report : Diagnosis
    path : path
        ``.html``: a page that opens on the verdict and needs no network. ``.json``: everything,
        for machines. ``.png``: one sheet. The file appears whole or not at all.
    title : str
        What was diagnosed; of the page and the sheet.
    facts : mapping of str to str, optional
        Lines for the box on the page.
    step : callable, optional
        Called with the share that is done, 0 to 1, and what is being drawn.
    **provenance
        What rides along in ``.json``: anything that JSON can hold.

    Raises
    ------
    ValueError
        For another ending.
    OSError
        Where the file cannot be written.
    """
    suffix = known_suffix(path, (".html", ".json", ".png"), "report")
    if suffix == ".html":
        from bathyal.diagnosis.report.page import write_page

        write_page(report, path, title=title, facts=facts, step=step)
    elif suffix == ".png":
        from bathyal.diagnosis.report.figure import diagnosis_figure
        from bathyal.view.figure import write_png

        write_png(diagnosis_figure(report, title=title), path)
    else:
        text = json_text(contents(report) | provenance)
        with replacing(path) as aside:
            aside.write_text(text, encoding="utf-8")


def contents(report: Diagnosis) -> dict[str, Any]:
    """Everything that report.json holds: SI units in the names, numbers with units of their own
    next to them; what is not finite becomes null."""
    held = report.held_out
    kinds = report.fit.arm.joint_types
    return {
        "format": "bathyal diagnosis",
        "schema": SCHEMA,
        "bathyal": version("bathyal"),
        "verdict": report.verdict,
        "summary": summary(report),
        "next": next_steps(report),
        "warnings": list(report.warnings),
        "poses": len(report.data),
        "gain": report.gain,
        "noise_m": report.noise,
        "noise_source": report.noise_source,
        "detectable_m": report.detectable,
        "effects": [_effect(effect) for effect in report.effects],
        "ambiguous": [_cause(cause) for cause in report.ambiguous],
        "next_poses": _poses(report),
        "joint_units": ["m" if kind == "prismatic" else "rad" for kind in kinds],
        "shown": [_structure(shown) for shown in report.shown],
        "leftover": None if report.leftover is None else _structure(report.leftover),
        "held_out": {
            "how": held.how,
            "blocks": held.blocks,
            "rms_before_m": held.rms_before,
            "rms_after_m": held.rms_after,
            "noise_m": held.noise,
            "p_value": held.p_value,
            "parts": [
                {
                    "name": part.name,
                    "rows": part.rows,
                    "rms_before_m": part.rms_before,
                    "rms_after_m": part.rms_after,
                }
                for part in held.parts
            ],
            "before_m": _by_row(held.before, len(report.data)),
            "after_m": _by_row(held.after, len(report.data)),
            "nested": _nested(report),
        },
        "residuals_before_m": np.asarray(report.residuals_before),
        "residuals_after_m": np.asarray(report.residuals_after),
    }


def _nested(report: Diagnosis) -> dict[str, Any] | None:
    nested = report.held_out.nested
    if nested is None:
        return None
    return {
        "folds": nested.folds,
        "rms_after_m": nested.rms_after,
        "verdicts": nested.verdicts,
        "after_m": _by_row(nested.after, len(report.data)),
    }


def write_residuals(report: Diagnosis, path: PathLike) -> None:
    """Write how far each row is off as .csv: counted from 0; with geometry alone and with the
    causes, fitted and held out, and residuals by axis [m]; empty where nothing was held out."""
    held = report.held_out
    before, after = (
        np.asarray(residuals, float)
        for residuals in (report.residuals_before, report.residuals_after)
    )
    columns = [
        np.linalg.norm(before, axis=1), np.linalg.norm(after, axis=1),
        _by_row(held.before, len(after)), _by_row(held.after, len(after)), *after.T,
    ]  # fmt: skip
    titles = ("row", "before_m", "after_m", "held_out_before_m", "held_out_after_m", "x_m", "y_m",
              "z_m")  # fmt: skip
    rows = (
        [row, *(x if math.isfinite(x) else "" for x in numbers)]
        for row, numbers in enumerate(zip(*(c.tolist() for c in columns), strict=True))
    )
    write_table(path, titles, rows)


def _by_row(values: Any, rows: int) -> NDArray[np.float64]:
    """(N,), also where nothing was held out."""
    errors = np.asarray(values, float)
    return errors if errors.size else np.full(rows, np.nan)


def _effect(effect: Any) -> dict[str, Any]:
    return {
        "name": effect.name,
        "joint": effect.joint,
        "words": effect.words,
        "parameters": {name: _estimate(number) for name, number in effect.parameters.items()},
        "gain": effect.gain,
        "held_out_before_m": effect.held_out_before,
        "held_out_after_m": effect.held_out_after,
        "nested_folds": effect.nested_folds,
        "p_value": effect.p_value,
        "size_m": effect.size,
        "rivals": [_cause(cause) for cause in effect.rivals],
        "rows": list(effect.rows),
    }


def _estimate(estimate: Any) -> dict[str, Any]:
    low, high = estimate.interval
    return {
        "value": estimate.value, "unit": estimate.unit, "std": estimate.std, "low": low,
        "high": high,
    }  # fmt: skip


def _cause(cause: Any) -> dict[str, Any]:
    return {"name": cause.name, "joint": cause.joint, "words": cause.words, "odds": cause.odds}


def _structure(shown: Any) -> dict[str, Any]:
    return {
        "against": shown.against, "words": shown.words, "size_m": shown.size,
        "share": shown.share, "p_value": shown.p_value,
    }  # fmt: skip


def _poses(report: Diagnosis) -> list[list[float]]:
    poses = report.next_poses
    if poses is None or np.size(poses) == 0:
        return []
    return [[float(q) for q in pose] for pose in np.atleast_2d(poses)]
