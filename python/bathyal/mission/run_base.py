# SPDX-License-Identifier: BSD-3-Clause
"""The run base: what runs were made of and how they ended, in one SQLite file."""

from __future__ import annotations

import json
import math
import sqlite3
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, shown
from bathyal.mission.log import LOG, RunLog
from bathyal.mission.run import SCENARIO, RunEvent, RunResult, read_run
from bathyal.mission.run_compare import (
    LogDifference,
    RunComparison,
    compare_logs,
    metrics_that_differ,
)
from bathyal.mission.run_query import compile_query

_MARK = 0x62746879  # the file's application_id
_LARGEST = 2**63 - 1  # SQLite's integers
_PATIENCE = 60.0  # for another writer [s]
_COLUMNS = "id, name, seed, status, duration, scenario_sha256, folder"
_TABLES = f"""
CREATE TABLE runs (id INTEGER PRIMARY KEY AUTOINCREMENT, name TEXT, seed INTEGER, status TEXT,
                   duration REAL, scenario_sha256 TEXT, folder TEXT);
CREATE TABLE details (run INTEGER PRIMARY KEY, scenario TEXT, versions TEXT, metrics TEXT,
                      events TEXT);
CREATE TABLE metrics (name TEXT, value REAL, run INTEGER, PRIMARY KEY (name, value, run))
  WITHOUT ROWID;
CREATE TABLE marks (what TEXT, value TEXT, run INTEGER, PRIMARY KEY (what, value, run))
  WITHOUT ROWID;
PRAGMA application_id = {_MARK};
"""


@dataclass(frozen=True)
class RunRow:
    """A run in a list.

    Attributes
    ----------
    id : int
        Its number in the base, from 1.
    name : str
    seed : int
    status : str
    duration : float
        [s]
    scenario_sha256 : str
    folder : str
        Where its files were when it was added.
    """

    id: int
    name: str
    seed: int
    status: str
    duration: float
    scenario_sha256: str
    folder: str


Rows = list[RunRow]  # within the class, `list` is its method
Ways = list[NDArray[np.float64]]


class RunBase:
    """Runs in an SQLite file, which several programs may write at once.

    Parameters
    ----------
    path : path
        Made if missing.

    Raises
    ------
    Error
        For a file that is no run base, or cannot be opened.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> base = bathyal.RunBase(pathlib.Path(tempfile.mkdtemp()) / "runs.db")
    >>> base.query("metric position_rms < 1 and status = 'done'")
    []
    """

    def __init__(self, path: PathLike) -> None:
        self.path = Path(path)
        with self._errors():
            self._connection = sqlite3.connect(self.path, timeout=_PATIENCE, isolation_level=None)
        try:
            with self._errors():
                self._prepare()
        except BaseException:
            self._connection.close()
            raise

    def add_folder(self, folder: PathLike) -> int:
        """Add a run that has ended.

        Parameters
        ----------
        folder : path
            The `out` of `bathyal.run`.

        Returns
        -------
        int
            Its number.

        Raises
        ------
        OSError
            Where there is no such folder.
        Error
            For a folder without a whole record, or a base that cannot be written.
        """
        run = read_run(folder)
        scenario = (Path(folder) / SCENARIO).read_text(encoding="utf-8")
        return self.add(run, scenario=scenario, folder=folder)

    def add(self, run: RunResult, *, scenario: str = "", folder: PathLike | None = None) -> int:
        """Add a run.

        Parameters
        ----------
        run : RunResult
        scenario : str
            The text of its mission.
        folder : path, optional
            Where its files are; the folder of its log if left out.

        Returns
        -------
        int
            Its number.

        Raises
        ------
        ValueError
            For a seed that is beyond 63 bits.
        Error
            For a base that cannot be written.
        """
        if not 0 <= run.seed <= _LARGEST:
            raise argument_error("seed", f"a whole number from 0 to {_LARGEST}", run.seed)
        where = Path(run.log.path.parent if folder is None else folder).resolve()
        finite = {name: value for name, value in run.metrics.items() if math.isfinite(value)}
        marks = {("event", event.kind) for event in run.events}
        marks |= {("fault", fault.text.partition(" ")[0]) for fault in run.faults}
        row = (run.name, run.seed, run.status, finite.get("duration"))
        details = [run.versions, run.metrics, [asdict(event) for event in run.events]]
        with self._errors(), self._writing() as base:
            number = base.execute(
                "INSERT INTO runs (name, seed, status, duration, scenario_sha256, folder) "
                "VALUES (?, ?, ?, ?, ?, ?)",
                (*row, run.scenario_sha256, str(where)),
            ).lastrowid
            assert number is not None
            base.execute(
                "INSERT INTO details VALUES (?, ?, ?, ?, ?)",
                (number, scenario, *(json.dumps(part) for part in details)),
            )
            base.executemany(
                "INSERT INTO metrics VALUES (?, ?, ?)",
                [(name, value, number) for name, value in finite.items()],
            )
            base.executemany("INSERT INTO marks VALUES (?, ?, ?)", [(*m, number) for m in marks])
        return number

    def list(self) -> Rows:
        """All runs, in the order in which they were added.

        Returns
        -------
        list of RunRow
        """
        return self._rows("1", [])

    def query(self, text: str) -> Rows:
        """Runs for which a condition holds, in the order in which they were added.

        Parameters
        ----------
        text : str
            Comparisons (``<`` ``<=`` ``>`` ``>=`` ``=`` ``!=``) of ``metric NAME``, ``id``,
            ``seed`` and ``duration`` with numbers, of ``name``, ``status``, ``folder`` and
            ``scenario_sha256`` with quoted texts; ``event = 'guard'`` (a kind of event that
            occurred), ``fault = 'thruster_2'`` (a device); joined by ``and``, ``or``, ``not`` and
            parentheses. A comparison with a metric that a run has not is false.

        Returns
        -------
        list of RunRow

        Raises
        ------
        ValueError
            What was expected and what came, with the column.
        """
        return self._rows(*compile_query(text))

    def show(self, id: int) -> RunResult:
        """A run with its metrics and events.

        Parameters
        ----------
        id : int

        Returns
        -------
        RunResult
            Its log is read from the folder when it is asked for.

        Raises
        ------
        ValueError
            For a number that there is not.
        """
        row, (_, versions, metrics, events) = self._found(id)
        return RunResult(
            name=row.name,
            seed=row.seed,
            status=row.status,
            metrics=json.loads(metrics),
            events=[RunEvent(**event) for event in json.loads(events)],
            log=RunLog(Path(row.folder) / LOG),
            versions=json.loads(versions),
            scenario_sha256=row.scenario_sha256,
        )

    def ways(self, *, most: int = 20) -> Ways:
        """The ways of the latest runs from above, to lie under the next map.

        Parameters
        ----------
        most : int
            So many runs.

        Returns
        -------
        list of (K, 2) array
            x, y of the true way, the latest run first; runs whose logs are gone are left out [m].
        """
        found: Ways = []
        for row in reversed(self.list()):
            log = Path(row.folder) / LOG
            if len(found) < most and log.is_file():
                found.append(RunLog(log).poses("/truth")[:, :2, 3])
        return found

    def scenario(self, id: int) -> str:
        """The text of a run's mission.

        Parameters
        ----------
        id : int

        Returns
        -------
        str
        """
        return str(self._found(id)[1][0])

    def compare(self, first: int, second: int) -> RunComparison:
        """How two runs differ: metrics, events, and where their logs first do.

        Parameters
        ----------
        first, second : int

        Returns
        -------
        RunComparison

        Raises
        ------
        ValueError
            For a number that there is not.
        """
        one, two = self.show(first), self.show(second)
        difference, note = _logs_of(one, two)
        return RunComparison(
            metrics=metrics_that_differ(one.metrics, two.metrics),
            only_first=[event for event in one.events if event not in two.events],
            only_second=[event for event in two.events if event not in one.events],
            first_difference=difference,
            note=note,
        )

    def close(self) -> None:
        """Closes the file."""
        self._connection.close()

    def _rows(self, condition: str, values: Sequence[float | str]) -> Rows:
        with self._errors():
            found = self._connection.execute(
                f"SELECT {_COLUMNS} FROM runs WHERE {condition} ORDER BY id", values
            ).fetchall()
        return [_row(row) for row in found]

    def _found(self, id: int) -> tuple[RunRow, tuple[Any, ...]]:
        with self._errors():
            rows = self._rows("id = ?", [id]) if 0 < id <= _LARGEST else []
            if not rows:
                raise argument_error("id", f"the number of a run in {shown(self.path)}", id)
            details = self._connection.execute(
                "SELECT scenario, versions, metrics, events FROM details WHERE run = ?", [id]
            ).fetchone()
        return rows[0], details

    def _prepare(self) -> None:
        if self._is_ready():
            return
        self._write_ahead()
        with self._writing() as base:
            if not self._is_ready():  # another program may have been first
                for statement in _TABLES.split(";"):
                    base.execute(statement)

    def _is_ready(self) -> bool:
        """False for an empty file; nothing is changed in another program's database."""
        mark = self._connection.execute("PRAGMA application_id").fetchone()[0]
        tables = self._connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
        if mark != _MARK and (mark or tables):
            raise Error(f"{shown(self.path)}: expected a run base, got another database")
        return bool(tables)

    def _write_ahead(self) -> None:
        """Readers and a writer at once. The change of mode does not wait for others by itself."""
        for _ in range(int(_PATIENCE / 0.05)):
            try:
                self._connection.execute("PRAGMA journal_mode = WAL")
                return
            except sqlite3.OperationalError as error:
                if "locked" not in str(error):
                    raise
                time.sleep(0.05)
        raise Error(f"{shown(self.path)}: another program holds it")

    @contextmanager
    def _writing(self) -> Iterator[sqlite3.Connection]:
        self._connection.execute("BEGIN IMMEDIATE")
        try:
            yield self._connection
            self._connection.execute("COMMIT")
        except BaseException:
            if self._connection.in_transaction:
                self._connection.execute("ROLLBACK")
            raise

    @contextmanager
    def _errors(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.Error as error:
            raise Error(f"{shown(self.path)}: {error}") from error


def _row(row: tuple[Any, ...]) -> RunRow:
    number, name, seed, status, duration, scenario, folder = row
    return RunRow(
        number, name, seed, status, math.nan if duration is None else duration, scenario, folder
    )


def _logs_of(first: RunResult, second: RunResult) -> tuple[LogDifference | None, str]:
    """A folder may have been used again since the run was added."""
    try:
        for run in (first, second):
            now = read_run(run.log.path.parent)
            if (now.seed, now.scenario_sha256) != (run.seed, run.scenario_sha256) or (
                metrics_that_differ(now.metrics, run.metrics)
            ):
                return None, f"{shown(run.log.path.parent)}: holds another run now"
        return compare_logs(first.log, second.log), ""
    except (OSError, Error) as error:
        return None, str(error)
