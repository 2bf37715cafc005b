# SPDX-License-Identifier: BSD-3-Clause
"""Tests, and what they share with the benchmarks."""
