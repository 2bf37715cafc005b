# SPDX-License-Identifier: BSD-3-Clause
import bathyal

project = "bathyal"
author = "the bathyal authors"
copyright = "2026, the bathyal authors"
release = bathyal.__version__

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "myst_parser",
]
myst_enable_extensions = ["colon_fence", "dollarmath"]
autodoc_member_order = "bysource"
napoleon_google_docstring = False
html_theme = "furo"
html_title = "bathyal"
exclude_patterns = ["_build"]
