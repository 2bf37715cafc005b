# SPDX-License-Identifier: BSD-3-Clause
"""Formats of triangle meshes, one module each."""
