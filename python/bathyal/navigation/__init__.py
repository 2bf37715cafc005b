# SPDX-License-Identifier: BSD-3-Clause
"""Navigation: logs of vehicles from files, what of them is to be believed."""
