# SPDX-License-Identifier: BSD-3-Clause
"""XML without entities; the XML of robots."""
