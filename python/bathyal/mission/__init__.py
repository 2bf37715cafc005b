# SPDX-License-Identifier: BSD-3-Clause
"""Missions from files, their runs and logs."""
