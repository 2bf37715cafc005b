# SPDX-License-Identifier: BSD-3-Clause
"""Runs one case of bad input in a process of its own, so that a crash is seen and not suffered.

The child is forked from the test process, with the package already imported, works in a folder of
its own, and may take no more than a minute and 2 GB above what it starts with.
"""

import os
import pickle
import re
import resource
import signal
import traceback
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

SECONDS = 60
MEMORY = 2 << 30
ARGUMENT = re.compile(r"`[^`]+`: expected .+, got .+", re.DOTALL)  # how a mistake is reported


@dataclass(frozen=True)
class Case:
    """`body` must raise one of `errors` with a text that matches `says`, or, where `errors` is
    empty, return without a word: it then checks its own answer."""

    name: str
    body: Callable[[], object]
    errors: tuple[type[BaseException], ...] = ()
    says: str = ""


def works(name: str, body: Callable[[], object]) -> Case:
    return Case(name, body)


def refused(
    name: str,
    says: str,
    body: Callable[[], object],
    errors: tuple[type[BaseException], ...] = (ValueError,),
) -> Case:
    return Case(name, body, errors, says)


def outcome_of(case: Case) -> str:
    """Empty when the case went as it should, else what went wrong."""
    try:
        answer = case.body()
    except BaseException as error:
        if not isinstance(error, case.errors or ()):
            return "".join(traceback.format_exception(error))
        if not re.search(case.says, str(error)):
            return f"the error does not say {case.says!r}: {error}"
        if isinstance(error, ValueError) and not ARGUMENT.match(str(error)):
            return f"the error does not name its argument, what it expected and got: {error}"
        return ""
    return f"no error, but {answer!r}" if case.errors else ""


def run_alone(case: Case, folder: Path) -> str:
    """What went wrong with the case, empty when nothing did."""
    read_end, write_end = os.pipe()
    pid = os.fork()
    if pid == 0:
        status = 1
        try:
            os.close(read_end)
            os.chdir(folder)
            signal.alarm(SECONDS)
            used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
            resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))
            os.write(write_end, pickle.dumps(outcome_of(case)[:60_000]))
            status = 0
        finally:
            os._exit(status)
    os.close(write_end)
    with os.fdopen(read_end, "rb") as pipe:
        answer = pipe.read()
    _, status = os.waitpid(pid, 0)
    if os.WIFSIGNALED(status):
        return f"ended by signal {signal.Signals(os.WTERMSIG(status)).name}"
    if not answer:
        return "ended without an answer"
    return str(pickle.loads(answer))


def check(case: Case, folder: Path) -> None:
    """Fail unless the case goes as it should and leaves no half-written file behind."""
    with warnings.catch_warnings():
        warnings.simplefilter(
            "ignore"
        )  # of fork next to the pool's threads, which the child leaves
        wrong = run_alone(case, folder)
    assert not wrong, wrong
    left_aside = [path.name for path in folder.rglob("*") if path.name.startswith(".")]
    assert left_aside == []
