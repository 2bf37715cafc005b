# SPDX-License-Identifier: BSD-3-Clause
"""An identification as one page of HTML that needs no network."""

from __future__ import annotations

import html
import math
from collections.abc import Mapping

import plotly.graph_objects as go  # type: ignore[import-untyped]
from plotly.offline import get_plotlyjs  # type: ignore[import-untyped]

from bathyal._core import ArmFit, Touches, Tracked
from bathyal.identify.report import views as fit_views
from bathyal.identify.report.tables import (
    INTERVAL,
    Line,
    bar_limit,
    distances,
    groups,
    lines,
    point_name,
)
from bathyal.identify.report.text import STATUS, next_touches, surely_text
from bathyal.io.files import PathLike, replacing
from bathyal.view.palette import GAP, INK, STATUSES
from bathyal.view.text import number


def write_page(
    fit: ArmFit,
    data: Touches | Tracked,
    path: PathLike,
    *,
    title: str = "",
    facts: Mapping[str, str] | None = None,
) -> None:
    """Save an identification as one page: warnings first, then text, drawings and tables.

    Parameters
    ----------
    fit : ArmFit
    data : Touches or Tracked
        What it was found from.
    path : path
        ``.html``; the drawing code is inside. The same bytes for the same fit; the whole file or
        none of it.
    title : str
    facts : mapping of str to str, optional
        Lines for the box to the right of the text.
    """
    page = _PAGE.format(
        title=html.escape(title),
        code=get_plotlyjs(),
        ink=INK,
        red=GAP,
        warnings="".join(f"<p>{html.escape(warning)}</p>" for warning in fit.warnings),
        found=html.escape(fit.summary(warnings=False)),
        surely=html.escape(surely_text(fit)),
        wanting="".join(f"<li>{html.escape(text)}</li>" for text in next_touches(fit, data)),
        facts=_facts(facts or {}),
        points=_points(fit, data),
        distances=_distances(fit, data),
        outliers=_outliers(fit, data),
        arm=_drawing(fit_views.show_touches(fit, data), "arm"),
        pairs=_drawing(fit_views.show_before_and_after(fit, data), "pairs"),
        values=_drawing(fit_views.show_singular_values(fit), "values"),
        residuals=_drawing(fit_views.show_residuals(fit, data), "residuals"),
        parameters=_parameters(fit),
        unseen=_unseen(fit),
    )
    with replacing(path) as aside:
        aside.write_text(page, encoding="utf-8")


def _drawing(figure: go.Figure, name: str) -> str:
    return str(
        figure.to_html(
            full_html=False, include_plotlyjs=False, div_id=name,
            config={"displaylogo": False, "responsive": True},
        )
    )  # fmt: skip


def _facts(facts: Mapping[str, str]) -> str:
    return "".join(
        f"<tr><th>{html.escape(name)}</th><td>{html.escape(value)}</td></tr>"
        for name, value in facts.items()
    )


def _points(fit: ArmFit, data: Touches | Tracked) -> str:
    """How well each point's touches, or each station's poses, agree."""
    rows = "".join(
        f"<tr><td>{html.escape(group.name)}</td><td>{len(group.rows)}</td>"
        f"<td>{1e3 * group.before:.3f}</td><td>{1e3 * group.after:.3f}</td></tr>"
        for group in groups(fit, data)
    )
    what = "poses" if isinstance(data, Tracked) else "touches"
    head = f"<tr><th></th><th>{what}</th><th>rms before [mm]</th><th>after [mm]</th></tr>"
    return f"<table class='numbers'>{head}{rows}</table>"


def _distances(fit: ArmFit, data: Touches | Tracked) -> str:
    known = distances(fit, data)
    if not known:
        return ""
    rows = "".join(
        f"<tr><td>{html.escape(d.first)} – {html.escape(d.second)}</td><td>{1e3 * d.given:.3f}</td>"
        f"<td>{1e3 * d.found:.3f}</td><td>{number(1e3 * (d.found - d.given), 3, '+')}</td></tr>"
        for d in known
    )
    head = "<tr><th>distance</th><th>given [mm]</th><th>found [mm]</th><th>off [mm]</th></tr>"
    return f"<table class='numbers'>{head}{rows}</table>"


def _outliers(fit: ArmFit, data: Touches | Tracked) -> str:
    if not fit.outliers:
        return ""
    rows = []
    for outlier in fit.outliers:
        where = fits = ""
        if isinstance(data, Touches):
            where = point_name(data, outlier.point) if outlier.point >= 0 else "a plane"
            fits = "" if outlier.fits is None else point_name(data, outlier.fits)
        cells = (str(outlier.row), where, f"{1e3 * outlier.distance:.3g}", fits)
        rows.append("".join(f"<td>{html.escape(cell)}</td>" for cell in cells))
    head = "<tr><th>row</th><th>of</th><th>off by [mm]</th><th>would fit</th></tr>"
    body = "".join(f"<tr>{cells}</tr>" for cells in rows)
    return (
        "<h2>Touches that disagree</h2><p>Rows are counted from 0.</p>"
        f"<table class='numbers'>{head}{body}</table>"
    )


def _parameters(fit: ArmFit) -> str:
    table = lines(fit)
    limit = bar_limit(table)
    return "".join(_parameter(line, limit) for line in table)


def _parameter(line: Line, limit: float) -> str:
    colour = STATUSES[line.status]
    held = line.status in ("gauge", "fixed")
    found = "" if held else f"{number(line.value, 4)} {line.unit}"
    trades = f"with {line.trades}" if line.trades else ""
    return (
        f"<tr><td title='{html.escape(line.description)}'>{html.escape(line.name)}</td>"
        f"<td>{number(line.nominal, 4)} {line.unit}</td><td>{found}</td>"
        f"<td>{line.changed}</td><td class='bar'>{_bar(line, limit, colour)}</td>"
        f"<td style='color:{colour}'>{STATUS[line.status]}</td>"
        f"<td class='small'>{html.escape(trades)}</td></tr>"
    )


def _bar(line: Line, limit: float, colour: str) -> str:
    """A bar from the middle, in shares of the cell, and a whisker over its interval."""
    share = 50 * line.change / limit
    bar = (
        f"<i style='left:{50 + min(share, 0):.2f}%;width:{abs(share):.2f}%;background:{colour}'>"
        "</i>"
    )
    if not math.isfinite(line.std) or line.std == 0:
        return bar
    half = 50 * INTERVAL * line.std / limit
    low, high = max(50 + share - half, 0), min(50 + share + half, 100)
    return f"{bar}<b style='left:{low:.2f}%;width:{high - low:.2f}%'></b>"


def _unseen(fit: ArmFit) -> str:
    if not fit.unseen:
        return "<p>The data determine every direction.</p>"
    rows = "".join(f"<li>{html.escape(text.replace('-', '−'))}</li>" for text in fit.unseen)
    return (
        "<p>Moving along any of these, the touches stay as they are. Each number is in the "
        f"parameter's own unit, per unit of the first.</p><ul>{rows}</ul>"
    )


_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<script>{code}</script>
<style>
body {{ margin: 0 auto; max-width: 1180px; padding: 18px 24px 48px; color: {ink};
  font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }}
h1 {{ font-size: 22px; margin: 0 0 10px; }}
h2 {{ font-size: 16px; margin: 30px 0 6px; border-bottom: 1px solid #ddd; }}
.warnings p {{ margin: 4px 0; padding: 6px 12px; border-left: 4px solid {red}; color: {red};
  background: #fdf0ef; }}
.summary {{ display: flex; gap: 32px; align-items: flex-start; flex-wrap: wrap; }}
.summary > div {{ flex: 1 1 480px; }}
.summary h2 {{ margin-top: 12px; }}
p, ul {{ margin: 6px 0; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13px; }}
th {{ text-align: left; font-weight: 500; opacity: 0.7; padding: 2px 14px 2px 0; }}
td {{ padding: 2px 14px 2px 0; }}
.numbers td:nth-child(n+2), .numbers th:nth-child(n+2) {{ text-align: right; }}
.numbers {{ margin: 10px 0; }}
#parameters {{ width: 100%; }}
#parameters td:nth-child(2), #parameters td:nth-child(3), #parameters td:nth-child(4),
#parameters th:nth-child(2), #parameters th:nth-child(3), #parameters th:nth-child(4)
  {{ text-align: right; white-space: nowrap; }}
#parameters tr:nth-child(even) {{ background: #f7f7f5; }}
.bar {{ position: relative; width: 200px; min-width: 120px;
  background: linear-gradient({ink}, {ink}) center / 1px 100% no-repeat; }}
.bar i {{ position: absolute; top: 22%; height: 56%; }}
.bar b {{ position: absolute; top: 48%; height: 1.5px; background: {ink}; }}
#parameters td:nth-child(6) {{ white-space: nowrap; padding-left: 14px; }}
.small {{ font-size: 12px; color: #555; }}
.two {{ display: grid; grid-template-columns: 3fr 2fr; gap: 12px; }}
@media (max-width: 900px) {{ .two {{ grid-template-columns: 1fr; }} }}
</style>
</head>
<body>
<h1>{title}</h1>
<div class="warnings">{warnings}</div>
<div class="summary">
<div>
<h2>What was found</h2><p>{found}</p>
<h2>How surely</h2><p>{surely}</p>
<h2>What to touch next</h2><ul>{wanting}</ul>
</div>
<div style="flex: 0 1 360px"><table>{facts}</table></div>
</div>
<h2>Before and after</h2>
<div class="two"><div>{pairs}</div><div>{points}{distances}</div></div>
{outliers}
<h2>Parameters</h2>
<p class="small">Bars: change from nominal, in mm and mrad alike; whiskers: 95 % interval.</p>
<table id="parameters"><thead><tr><th>parameter</th><th>nominal</th><th>found</th>
<th>change ± std</th><th></th><th>the data</th><th>null space</th></tr></thead>
<tbody>{parameters}</tbody></table>
<h2>Residuals against each joint</h2>
{residuals}
<h2>What the data determine</h2>
<div class="two"><div>{values}</div><div>{unseen}</div></div>
<h2>The arm that was found</h2>
{arm}
</body>
</html>
"""
