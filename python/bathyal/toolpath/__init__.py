# SPDX-License-Identifier: BSD-3-Clause
"""Camera axes in, oriented tool paths out."""
