# SPDX-License-Identifier: BSD-3-Clause
"""Arms from and to files."""
