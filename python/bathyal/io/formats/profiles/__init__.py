# SPDX-License-Identifier: BSD-3-Clause
"""Casts of conductivity, temperature, depth and sound speed, as their instruments write them."""
