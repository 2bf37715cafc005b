# SPDX-License-Identifier: BSD-3-Clause
"""Simulated cases with effects inside, whose answer is known, and the score card over them."""
