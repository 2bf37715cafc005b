# SPDX-License-Identifier: BSD-3-Clause
"""What an identification shows first: its verdict, its numbers, one next step."""

from __future__ import annotations

from bathyal._core import ArmFit, Touches, Tracked
from bathyal.identify.report.tables import groups
from bathyal.identify.report.text import next_touches, predicted_tip
from bathyal.view.brief import Brief
from bathyal.view.text import counted

_MOST_NAMES = 4  # of points, one by one


def brief_of(fit: ArmFit, data: Touches | Tracked | None = None) -> Brief:
    """The identification at first sight.

    Parameters
    ----------
    fit : ArmFit
    data : Touches or Tracked, optional
        What it was found from: names the points, and chooses the next step.

    Returns
    -------
    Brief
    """
    numbers = {_kind(fit, data): _counted(fit, data), "determined": _determined(fit)}
    numbers["scale"] = f"± {100 * fit.scale_std:.2g} %, by {fit.scale_source}"
    numbers["noise"] = f"{1e3 * fit.noise:.3g} mm per axis"
    numbers["tip predicted to"] = predicted_tip(fit)
    return Brief(_verdict(fit), numbers, _next_step(fit, data))


def _verdict(fit: ArmFit) -> str:
    change = f"the error falls from {1e3 * fit.rms_before:.3g} to {1e3 * fit.rms_after:.3g} mm"
    if not fit.converged:
        return f"Not converged: {change} (3-D rms)."
    if fit.warnings:
        return f"Identified, with {counted(len(fit.warnings), 'warning')}: {change} (3-D rms)."
    return f"Identified: {change} (3-D rms)."


def _kind(fit: ArmFit, data: Touches | Tracked | None) -> str:
    touched = bool(fit.point_labels) if data is None else isinstance(data, Touches)
    return "touches" if touched else "poses"


def _counted(fit: ArmFit, data: Touches | Tracked | None) -> str:
    count = f"{len(fit.residuals):,}"
    if isinstance(data, Touches):
        names = [group.name for group in groups(fit, data)]
        few = len(names) <= _MOST_NAMES
        return f"{count} of {', '.join(names) if few else counted(len(names), 'point')}"
    return f"{count} of {counted(len(fit.point_labels), 'point')}" if fit.point_labels else count


def _determined(fit: ArmFit) -> str:
    redundant = sum(p.status == "gauge" for p in fit.parameters)
    return f"{fit.rank} of {len(fit.parameters)} parameters" + (
        f"; {redundant} redundant with base and tool" if redundant else ""
    )


def _next_step(fit: ArmFit, data: Touches | Tracked | None) -> str:
    if data is not None:
        return next_touches(fit, data)[0]
    if fit.warnings:
        return "Read the warnings (fit.warnings)."
    return "Check the arm on a dozen poses that were not used."
