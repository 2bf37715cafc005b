# SPDX-License-Identifier: BSD-3-Clause
"""What is not in every installation."""

from __future__ import annotations

import importlib
from typing import Any

from bathyal._core import Error


def pcl(asked: str, instead: str) -> Any:
    """The extension ``bathyal._pcl``; where it is missing, an `Error` that names the remedy."""
    try:
        return importlib.import_module("bathyal._pcl")
    except ImportError as error:
        raise Error(
            f"{asked} needs the extension bathyal._pcl, which the wheel leaves out: install PCL "
            "(on Debian libpcl-dev) and build bathyal from its source with "
            f"-C cmake.define.BATHYAL_PCL=ON, or use {instead} (the import said: {error})"
        ) from error
