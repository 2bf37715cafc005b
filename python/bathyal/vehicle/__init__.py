# SPDX-License-Identifier: BSD-3-Clause
"""Vehicles from files."""
