# SPDX-License-Identifier: BSD-3-Clause
"""What an identification shows: text, tables, figures, page."""
