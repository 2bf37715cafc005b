# SPDX-License-Identifier: BSD-3-Clause
"""Worlds from files."""
