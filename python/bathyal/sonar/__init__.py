# SPDX-License-Identifier: BSD-3-Clause
"""Surveys, their records and files."""
