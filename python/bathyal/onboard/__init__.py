# SPDX-License-Identifier: BSD-3-Clause
"""Software on board: what it reads and commands, by the simulator, a serial line or a log."""
