# SPDX-License-Identifier: BSD-3-Clause
"""What a diagnosis shows: text, figures, page."""
