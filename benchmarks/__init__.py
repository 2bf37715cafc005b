# SPDX-License-Identifier: BSD-3-Clause
"""Benchmarks, each run as a module: ``python -m benchmarks.python.rays``."""
