# SPDX-License-Identifier: BSD-3-Clause
"""Formulas as MathML, written by docutils' own converter: the pages need no network and no script,
where Sphinx's default (MathJax) loads one from a server each time a page is opened."""

from __future__ import annotations

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.util import logging

_log = logging.getLogger(__name__)


def formula(tex: str, *, block: bool) -> str:
    """The MathML of a formula in LaTeX.

    Raises
    ------
    MathError
        For a macro that the converter does not know.
    """
    return str(tex2mathml(tex, as_block=block))


def _written(node: nodes.Element, *, block: bool) -> str:
    try:
        return formula(node.astext(), block=block)
    except MathError as error:
        _log.warning("formula %s: %s", node.astext(), error, location=node)
        return ""


def _visit_inline(translator, node) -> None:  # type: ignore[no-untyped-def]
    translator.body.append(_written(node, block=False))
    raise nodes.SkipNode


def _visit_block(translator, node) -> None:  # type: ignore[no-untyped-def]
    translator.body.append(f'<div class="math">{_written(node, block=True)}</div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Offer the renderer `mathml`."""
    app.add_html_math_renderer("mathml", (_visit_inline, None), (_visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
