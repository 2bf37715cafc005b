# SPDX-License-Identifier: BSD-3-Clause
"""One module a file format; `bathyal.seabed` chooses among them by suffix."""
