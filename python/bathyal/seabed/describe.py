# SPDX-License-Identifier: BSD-3-Clause
"""What a file holds, in numbers for programs and in text for people."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from bathyal._core import (
    Error,
    PointCloud,
    TriangleMesh,
    clean_cloud,
    find_sheets,
    fit_plane,
    mesh_report,
)

Described = tuple[dict[str, Any], dict[str, str]]

# Fewer soundings than this have no spacing and no slope worth saying.
_FEW = 10


def describe(what: PointCloud | TriangleMesh) -> Described:
    """Counts, bounds, density and soundness: as data with SI units in the names, and as rows."""
    return _describe_mesh(what) if isinstance(what, TriangleMesh) else _describe_cloud(what)


def _describe_cloud(cloud: PointCloud) -> Described:
    cleaned = clean_cloud(cloud)
    clean, report = cleaned.cloud, cleaned.report
    data: dict[str, Any] = {
        "kind": "cloud", "soundings": len(cloud), "cleaning": report.as_dict(),
        **_datum(cloud), "attributes": _ranges(cloud),
    }  # fmt: skip
    rows = {"kind": "soundings", "count": f"{len(cloud):,}"}
    if len(clean) < len(cloud):
        rows["usable"] = f"{len(clean):,} ({report.not_finite:,} not a number, " \
            f"{report.duplicates:,} duplicates)"  # fmt: skip
    if len(clean):
        _add_bounds(data, rows, clean.points.min(axis=0), clean.points.max(axis=0))
    if len(clean) >= _FEW:
        _add_lie(data, rows, clean)
    return data, {**rows, **_datum_rows(cloud)}


def _add_lie(data: dict[str, Any], rows: dict[str, str], cloud: PointCloud) -> None:
    """How dense the soundings lie, on how many sheets, and whether a plane would do."""
    sheets = find_sheets(cloud)
    data |= {"spacing_m": sheets.spacing, "covered_area_m2": sheets.covered_area,
             "noise_m": sheets.noise, "several_sheets": not sheets.single_valued,
             "sheet_share": sheets.share}  # fmt: skip
    rows["spacing"] = f"{sheets.spacing:.3g} m over {sheets.covered_area:,.4g} m²"
    rows["noise"] = f"{sheets.noise:.2g} m rms about local planes"
    if not sheets.single_valued:
        rows["sheets"] = str(sheets)
    try:
        fit = fit_plane(cloud)
    except (Error, ValueError):  # all on one line: no plane, which is no fault of the file
        return
    data["plane"] = {"normal": fit.normal, "offset_m": fit.offset, "rms_m": fit.rms,
                     "relief_m": fit.relief, "flat": fit.flat}  # fmt: skip
    tilt = np.degrees(np.arccos(np.clip(fit.normal[2], -1, 1)))
    verdict = "flat enough for --plane" if fit.flat else "not flat: plan on a mesh"
    rows["plane"] = f"tilt {tilt:.2f}°, relief {fit.relief:.3g} m about it: {verdict}"


def _describe_mesh(mesh: TriangleMesh) -> Described:
    report = mesh_report(mesh)
    data: dict[str, Any] = {
        "kind": "mesh", **report.as_dict(), **_datum(mesh), "attributes": _ranges(mesh),
    }  # fmt: skip
    rows = {"kind": "mesh"}
    if report.triangle_count:
        _add_bounds(data, rows, report.low, report.high)
    corners = mesh.vertices[mesh.triangles]
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    data["median_edge_m"] = float(np.median(edges)) if edges.size else None
    for line in str(report).splitlines():
        name, value = re.split(r"\s{2,}", line.strip(), maxsplit=1)
        rows[name] = value
    if edges.size:
        rows["median edge"] = f"{np.median(edges):.3g} m"
    return data, {**rows, **_datum_rows(mesh)}


def _add_bounds(data: dict[str, Any], rows: dict[str, str], low: Any, high: Any) -> None:
    data["bounds_m"] = {"low": low, "high": high}
    for axis, name in enumerate("xyz"):
        size = high[axis] - low[axis]
        rows[name] = f"{low[axis]:,.3f} … {high[axis]:,.3f} m ({size:,.4g} m)"


def _datum(what: PointCloud | TriangleMesh) -> dict[str, str]:
    return {"crs": what.crs, "vertical_datum": what.vertical_datum}


def _datum_rows(what: PointCloud | TriangleMesh) -> dict[str, str]:
    attributes = what.attributes
    return {
        "CRS": _short(what.crs) or "not stated",
        "vertical datum": _short(what.vertical_datum) or "not stated",
        **({"attributes": ", ".join(sorted(attributes))} if attributes else {}),
    }


def _short(text: str) -> str:
    """WKT by its name only."""
    text = " ".join(text.split())
    if len(text) <= 60:
        return text
    quoted = text.split('"')
    return f"{quoted[1]} (WKT)" if len(quoted) > 2 else text[:57] + "…"


def _ranges(what: PointCloud | TriangleMesh) -> dict[str, list[float]]:
    return {
        name: [float(np.nanmin(values)), float(np.nanmax(values))]
        for name, values in what.attributes.items()
        if np.isfinite(values).any()
    }
