# SPDX-License-Identifier: BSD-3-Clause
"""The seabed from files: soundings, meshes, triangulation."""
