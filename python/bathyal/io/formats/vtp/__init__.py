# SPDX-License-Identifier: BSD-3-Clause
"""VTK PolyData XML: reading and writing."""
