# SPDX-License-Identifier: BSD-3-Clause
"""Formats of soundings, one module each."""
