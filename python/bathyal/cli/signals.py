# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C and SIGTERM while a command runs: both unwind it, so that half-written files go."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


class Terminated(KeyboardInterrupt):
    """SIGTERM; engine and libraries let it through as they do Ctrl-C."""


@contextmanager
def signals_raise() -> Iterator[None]:
    """Within, SIGINT raises KeyboardInterrupt and SIGTERM `Terminated`; a signal that the process
    was started to ignore, as with nohup, is ignored."""
    before: dict[signal.Signals, Any] = {}
    if threading.current_thread() is threading.main_thread():
        for number, handler in (
            (signal.SIGINT, signal.default_int_handler),
            (signal.SIGTERM, _terminate),
        ):
            if signal.getsignal(number) != signal.SIG_IGN:
                before[number] = signal.signal(number, handler)
    try:
        yield
    finally:
        for number in before:
            signal.signal(number, before[number])


def _terminate(_number: int, _frame: object) -> None:
    raise Terminated
