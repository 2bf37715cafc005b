# SPDX-License-Identifier: BSD-3-Clause
import sys
from pathlib import Path

import bathyal

sys.path.insert(0, str(Path(__file__).parent / "extensions"))

project = "bathyal"
author = "the bathyal authors"
copyright = "2026, the bathyal authors"
release = bathyal.__version__

extensions = [
    "command_line",
    "mathml",
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
]
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
myst_update_mathjax = False  # formulas are MathML
autodoc_member_order = "bysource"
napoleon_google_docstring = False
html_math_renderer = "mathml"
html_theme = "furo"
html_title = "bathyal"
exclude_patterns = ["_build"]
# `path`, an argument of many functions, is a property of several classes, too: which of them a name
# in backticks is linked to does not matter.
suppress_warnings = ["ref.python"]
