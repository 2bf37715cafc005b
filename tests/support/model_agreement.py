# SPDX-License-Identifier: BSD-3-Clause
"""Holds the model of a diagnosis against the residuals of its report."""

from __future__ import annotations

from typing import Any

import numpy as np

import bathyal


def difference(report: Any, data: bathyal.Tracked | bathyal.Touches) -> float:
    """How far the model's tips at the recorded joints lie from those that the residuals tell, at
    most [m]. A load that is not known in every row was not used in the fit, and is not given. Rows
    that lack a covariate are not asked: the model leaves out what looks at it there.
    Of a tool that slipped at a row and not at a time, the rows before the slip are not
    asked: by itself each of them is a pose after it."""
    model = report.model
    used = {
        name: values
        for name, values in data.covariates.items()
        if name != "payload" or np.isfinite(values).all()
    }
    tips = model.forward(data.q, covariates=used)[:, :3, 3]
    residuals = np.asarray(report.residuals_after)
    known = np.ones(len(data.q), bool)
    for values in data.covariates.values():
        known &= np.isfinite(values).reshape(len(known), -1).all(axis=1)
    rows = np.flatnonzero(known)
    for effect in model.effects:
        if effect.name == "tool_slip" and "time" not in effect.settings:
            rows = rows[rows >= effect.settings["moment"]]
    places = tips - residuals
    if isinstance(data, bathyal.Tracked):
        return float(np.abs(places - data.position)[rows].max(initial=0.0))
    out = 0.0
    for label in np.unique(data.point):
        own = places[rows[data.point[rows] == label]]
        if len(own):
            out = max(out, float(np.ptp(own, axis=0).max()))
    return out
