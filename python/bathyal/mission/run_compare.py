# SPDX-License-Identifier: BSD-3-Clause
"""Two runs compared: metrics, events, and the first step of their logs that differs."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal.mission.log import RunLog
from bathyal.mission.run import RunEvent


@dataclass(frozen=True)
class LogDifference:
    """Where two logs first differ.

    Attributes
    ----------
    time : float
        Of the message [s]; of the earlier one where the times differ.
    topic : str
    field : str
        "" where only one of the logs has the message.
    """

    time: float
    topic: str
    field: str


@dataclass(frozen=True)
class RunComparison:
    """How two runs differ.

    Attributes
    ----------
    metrics : dict
        Those that differ: name → (of the first, of the second); NaN where there is none.
    only_first, only_second : list of RunEvent
        Events that only one of the runs has.
    first_difference : LogDifference or None
        None where the logs are equal, or could not be compared.
    note : str
        Why the logs could not be compared; "" where they were.
    """

    metrics: dict[str, tuple[float, float]]
    only_first: list[RunEvent] = field(repr=False)
    only_second: list[RunEvent] = field(repr=False)
    first_difference: LogDifference | None = None
    note: str = ""

    @property
    def same(self) -> bool:
        """Whether nothing differs, the logs included."""
        found = (self.metrics, self.only_first, self.only_second, self.first_difference, self.note)
        return not any(found)


def metrics_that_differ(
    first: dict[str, float], second: dict[str, float]
) -> dict[str, tuple[float, float]]:
    """Metrics of one run or of both, where the values are not the same; NaN equals NaN."""
    pairs = {
        name: (first.get(name, np.nan), second.get(name, np.nan))
        for name in sorted(first.keys() | second.keys())
    }
    return {name: pair for name, pair in pairs.items() if not _same(np.array(pair))}


def _same(pair: NDArray[Any]) -> bool:
    return bool(pair[0] == pair[1] or np.isnan(pair).all())


def compare_logs(first: RunLog, second: RunLog) -> LogDifference | None:
    """The first message, by time, in which two logs differ; None where they are equal.

    Parameters
    ----------
    first, second : RunLog

    Returns
    -------
    LogDifference or None

    Raises
    ------
    OSError
        Where a log cannot be read.
    Error
        For what is no log.
    """
    found = []
    for topic in sorted(set(first.topics) | set(second.topics)):
        if topic not in first.topics or topic not in second.topics:
            log = first if topic in first.topics else second
            found.append(LogDifference(float(log.messages(topic)["time"][0]), topic, ""))
        else:
            found += _of_topic(topic, first.messages(topic), second.messages(topic))
    return min(found, key=lambda difference: difference.time, default=None)


def _of_topic(
    topic: str, first: dict[str, NDArray[Any]], second: dict[str, NDArray[Any]]
) -> list[LogDifference]:
    found = []
    times = first["time"], second["time"]
    for name in [*first, *(name for name in second if name not in first)]:
        if name not in first or name not in second:
            found.append(LogDifference(float(min(times[0][0], times[1][0])), topic, name))
            continue
        row = _first_row(first[name], second[name])
        if row is not None:
            at = min(float(time[row]) for time in times if row < len(time))
            found.append(LogDifference(at, topic, name))
    shorter = min(len(times[0]), len(times[1]))
    if len(times[0]) != len(times[1]):
        longer = max(times, key=len)
        found.append(LogDifference(float(longer[shorter]), topic, ""))
    return found


def _first_row(first: NDArray[Any], second: NDArray[Any]) -> int | None:
    """Among the rows that both have."""
    count = min(len(first), len(second))
    if first.shape[1:] != second.shape[1:] or first.dtype.kind != second.dtype.kind:
        return 0
    differs = first[:count] != second[:count]
    if first.dtype.kind == "f":
        differs &= ~(np.isnan(first[:count]) & np.isnan(second[:count]))
    rows = np.flatnonzero(differs.reshape(count, -1).any(axis=1))
    return int(rows[0]) if len(rows) else None
