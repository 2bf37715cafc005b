# SPDX-License-Identifier: BSD-3-Clause
"""The water: casts from files, what the engine asks of gsw, figures."""
