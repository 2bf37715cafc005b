# SPDX-License-Identifier: BSD-3-Clause
"""A view as one page of HTML that needs no network."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence

import plotly.graph_objects as go  # type: ignore[import-untyped]

from bathyal.io.files import PathLike, replacing
from bathyal.view.palette import GAP, INK


def write_html(
    figure: go.Figure,
    path: PathLike,
    *,
    title: str = "",
    facts: Mapping[str, str] | None = None,
    warnings: Sequence[str] = (),
) -> None:
    """Save a figure as one page that needs no network: the drawing code is inside.

    The same bytes for the same figure; the whole file or none of it.
    """
    drawing = figure.to_html(
        full_html=False, include_plotlyjs=True, div_id="plan", default_height="100%",
        config={"displaylogo": False, "responsive": True},
    )  # fmt: skip
    listed = "".join(
        f"<span><b>{html.escape(name)}</b> {html.escape(value)}</span>"
        for name, value in (facts or {}).items()
    )
    warned = "".join(f"<p>{html.escape(warning)}</p>" for warning in warnings)
    page = _PAGE.format(
        title=html.escape(title), facts=listed, warnings=warned, drawing=drawing, ink=INK, red=GAP
    )
    with replacing(path) as aside:
        aside.write_text(page, encoding="utf-8")


_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
html, body {{ height: 100%; margin: 0; font: 14px/1.4 system-ui, "DejaVu Sans", sans-serif;
  color: {ink}; }}
body {{ display: flex; flex-direction: column; }}
header {{ padding: 10px 18px 6px; border-bottom: 1px solid #ddd; }}
h1 {{ font-size: 18px; margin: 0 0 4px; }}
header span {{ margin-right: 18px; white-space: nowrap; }}
header b {{ font-weight: 500; opacity: 0.65; }}
header p {{ margin: 2px 0; color: {red}; }}
main {{ flex: 1; min-height: 300px; }}
main > div {{ height: 100%; }}
</style>
</head>
<body>
<header><h1>{title}</h1>{facts}{warnings}</header>
<main>{drawing}</main>
</body>
</html>
"""
