# SPDX-License-Identifier: BSD-3-Clause
"""An arm on a vehicle among what it must not touch."""
