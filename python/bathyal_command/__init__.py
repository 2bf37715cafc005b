# SPDX-License-Identifier: BSD-3-Clause
"""The program `bathyal`.

It is no part of the package, whose import takes a good part of a second: Ctrl-C and SIGTERM are
answered during that time, too.
"""

from __future__ import annotations

import os
import signal


def main() -> None:
    """Run the command line; what the console script calls."""
    for number in (signal.SIGINT, signal.SIGTERM):
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, _leave)
    from bathyal.cli import app

    app()


def _leave(number: int, _frame: object) -> None:
    """Before a command begins, and after it ended, nothing is written that must be removed."""
    os._exit(128 + number)
