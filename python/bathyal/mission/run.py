# SPDX-License-Identifier: BSD-3-Clause
"""Runs of missions: from a file and a seed to a folder with what happened."""

from __future__ import annotations

import fcntl
import hashlib
import json
import math
import os
import platform
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, MissionPlan, MissionRun
from bathyal.io.files import PathLike, replacing, shown
from bathyal.mission.files import Mission, read_mission
from bathyal.mission.live import LiveRun, recorded_inputs
from bathyal.mission.log import LOG, RunLog
from bathyal.onboard.moments import Moment, Reading

SCENARIO, STATE, RECORD, LINKS = "mission.yaml", "state.bin", "run.json", "links.json"


@dataclass(frozen=True)
class RunEvent:
    """Something that happened.

    Attributes
    ----------
    time : float
        [s]
    kind : str
        start, command, fault, report, guard, mark or end.
    text : str
    """

    time: float
    kind: str
    text: str


@dataclass(frozen=True)
class RunResult:
    """A run that has ended.

    Attributes
    ----------
    name : str
    seed : int
    status : str
        done, failed, aborted, timeout or stopped.
    metrics : dict
        Numbers by name, in SI units but ``energy_wh``; NaN where there is nothing to measure.
    events : list of RunEvent
    log : RunLog
        What was recorded, as arrays by topic.
    versions : dict
        Of what made it.
    scenario_sha256 : str
        Of the mission's file.
    """

    name: str
    seed: int
    status: str
    metrics: dict[str, float]
    events: list[RunEvent] = field(repr=False)
    log: RunLog = field(repr=False)
    versions: dict[str, str] = field(repr=False)
    scenario_sha256: str = field(repr=False)

    @property
    def faults(self) -> list[RunEvent]:
        """The events that are faults."""
        return [event for event in self.events if event.kind == "fault"]

    def plot(
        self, path: PathLike | None = None, *, earlier: Sequence[NDArray[np.float64]] = ()
    ) -> Any:
        """Four views: the way from above, heights, thrusters, supply and errors over time.

        Parameters
        ----------
        path : path, optional
            ``.png``, written as well.
        earlier : sequence of (K, 2) array
            Ways of earlier runs, drawn under this one's: see `RunBase.ways` [m].

        Returns
        -------
        matplotlib.figure.Figure
        """
        from bathyal.mission.picture import run_figure

        figure = run_figure(self, earlier)
        if path is not None:
            figure.savefig(path, dpi=100)
        return figure


class Run:
    """A run that goes by hand, tick by tick.

    Parameters
    ----------
    mission : Mission or path
    seed : int
        Of all noise; keyed by device, channel and sample.
    log : path, optional
        An MCAP file to write.
    state : bytes, optional
        Of `save`, from which it goes on; the log, too.

    Raises
    ------
    Error
        For a state of another mission or seed, or one that was cut.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> from bathyal.mission.example import write_mission_example
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "mission.yaml"
    >>> _ = write_mission_example(path)
    >>> run = bathyal.Run(path, seed=1)
    >>> for _ in range(50):
    ...     _ = run.step()
    >>> run.status, round(run.time, 1)
    ('running', 5.0)
    """

    def __init__(
        self,
        mission: Mission | PathLike,
        *,
        seed: int = 1,
        log: PathLike | None = None,
        state: bytes | None = None,
    ) -> None:
        self.mission = mission if isinstance(mission, Mission) else read_mission(mission)
        self.seed = seed
        path = None if log is None else str(Path(log))
        if state is not None:
            state = self._own_state(state)
        self._run = MissionRun(self.mission.plan, seed, log=path, state=state)

    def step(self, inputs: dict[str, Any] | None = None, *, count: int = 1) -> bool:
        """Some ticks.

        Parameters
        ----------
        inputs : dict, optional
            ``stop`` (True ends the run), ``wrench`` (6,) on the vehicle besides all others
            [N, N m], ``thrusters`` commands of −1 to 1 and ``fins`` angles [rad] in place of the
            pilot's. They are recorded in the log.
        count : int

        Returns
        -------
        bool
            Whether it goes on.

        Raises
        ------
        ValueError
            For inputs that are not known, of another size or not finite.
        """
        given = dict(inputs or {})
        unknown = given.keys() - {"stop", "wrench", "thrusters", "fins"}
        if unknown:
            raise ValueError(
                f"inputs: expected stop, wrench, thrusters, fins, got {sorted(unknown)}"
            )
        return self._run.step(count, **given)

    @property
    def time(self) -> float:
        """[s]"""
        return self._run.time

    @property
    def number(self) -> int:
        """Of the next tick."""
        return self._run.number

    @property
    def plan(self) -> MissionPlan:
        """What is run."""
        return self.mission.plan

    @property
    def arrived(self) -> list[Reading]:
        """What sensors have reported to the next tick."""
        return [Reading(*row[:-1], tuple(row[-1])) for row in self._run.arrived]

    @property
    def pose(self) -> NDArray[np.float64]:
        """(4, 4) world_from_vehicle, the true one."""
        return self._run.pose

    @property
    def velocity(self) -> NDArray[np.float64]:
        """(6,) over ground and of turn, in the vehicle, the true one [m/s, rad/s]."""
        return self._run.velocity

    @property
    def status(self) -> str:
        """running, done, failed, aborted, timeout or stopped."""
        return self._run.status

    @property
    def signals(self) -> dict[str, float]:
        """What conditions see, by name; NaN is not known."""
        return dict(self._run.signals)

    @property
    def metrics(self) -> dict[str, float]:
        """Numbers by name."""
        return dict(self._run.metrics)

    @property
    def events(self) -> list[RunEvent]:
        """What has happened, of a run with a log."""
        return [RunEvent(*event) for event in self._run.events]

    def save(self) -> bytes:
        """The state, from which another `Run` goes on with the same bytes, log included."""
        return self._digest() + self._run.save()

    def _digest(self) -> bytes:
        return hashlib.sha256(self.mission.text.encode()).digest()

    def _own_state(self, state: bytes) -> bytes:
        digest = self._digest()
        if not state.startswith(digest):
            raise Error("state: expected one of this mission, got a saved run of another, or none")
        return state[len(digest) :]

    def close(self) -> None:
        """Ends the log."""
        self._run.close()


def run(
    mission: Mission | PathLike,
    *,
    seed: int = 1,
    out: PathLike | None = None,
    resume: bool = False,
    save_every: float = 60.0,
    speed: float | None = None,
    inputs: Callable[[Moment], dict[str, Any] | None] | None = None,
    replay: PathLike | None = None,
    progress: Callable[[float], None] | None = None,
) -> RunResult:
    """Run a mission to its end.

    A pure function of mission, seed and inputs: the same bytes on every machine of one kind,
    whatever the clock, the locale, the environment or the number of threads, and wherever it was
    interrupted. The links of the mission's file are opened, and programs waited for; what they
    command is recorded, and with `replay` comes from the record.

    Parameters
    ----------
    mission : Mission or path
    seed : int
    out : path, optional
        A folder for ``mission.yaml``, ``log.mcap`` and ``run.json``; made if missing. Without one
        the log is in a temporary folder.
    resume : bool
        Goes on where a run of the same mission and seed in `out` was interrupted.
    save_every : float
        Of the run's time, between two saved states in `out` [s].
    speed : float, optional
        Times real time; as fast as it goes unless given. Late ticks are counted in ``links.json``.
    inputs : function, optional
        Asked each tick for inputs as `Run.step` takes them; in place of the links.
    replay : path, optional
        Folder of a run whose inputs are taken, in place of the links.
    progress : function, optional
        Called with the run's time [s] now and then.

    Returns
    -------
    RunResult

    Raises
    ------
    OSError
        Where the folder cannot be written.
    Error
        For a mission that cannot be read, a motion that runs away, a saved state of another run, a
        port that is taken, a program that does not answer, a folder in which another program runs
        a mission, or a full disk: with `resume` and more room it ends with the same bytes.
    ValueError
        For a speed that is not above 0, or `inputs` with `replay`.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "mission.yaml"
    >>> _ = path.write_text('''
    ... world: {water: {surface: 0}, terrain: {seabed: {size: [40, 40], spacing: 1, depth: 10}}}
    ... vehicle: {preset: bluerov2_heavy}
    ... mission: [dive: {depth: 3 m}, surface]
    ... ''')
    >>> bathyal.run(path, seed=1).status
    'done'
    """
    given = mission if isinstance(mission, Mission) else read_mission(mission)
    folder = Path(tempfile.mkdtemp(prefix="bathyal-run-") if out is None else out)
    folder.mkdir(parents=True, exist_ok=True)
    if inputs is not None and replay is not None:
        raise ValueError("inputs: expected none with replay, got a function")
    with _alone_in(folder):
        state = _saved(folder) if resume else None
        recorded = recorded_inputs(Path(replay) / LOG) if replay is not None else {}
        if state is not None:
            recorded |= recorded_inputs(folder / LOG)
        live = LiveRun(
            given, folder, seed=seed, speed=speed, inputs=inputs, replay=replay is not None
        )
        (folder / RECORD).unlink(missing_ok=True)
        _write(folder / SCENARIO, given.text.encode())
        going = Run(given, seed=seed, log=folder / LOG, state=state)
        saved = going.time

        def look() -> None:
            nonlocal saved
            if out is not None and going.time >= saved + save_every:
                _write(folder / STATE, going.save())
                saved = going.time
            if progress is not None:
                progress(going.time)

        try:
            live.finish(going, recorded, look)
        except BaseException:
            if live.asking and out is not None:
                _write(folder / STATE, going.save())
            raise
        going.close()
        result = _result(going, folder)
        _write(folder / RECORD, _record(result))
        if live.is_live:
            _write(folder / LINKS, json.dumps(live.report(), indent=1).encode() + b"\n")
        (folder / STATE).unlink(missing_ok=True)
        return result


@contextmanager
def _alone_in(folder: Path) -> Iterator[None]:
    """While no other program runs a mission in the folder."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Error(f"{shown(folder)}: another program runs a mission in it") from None
        yield
    finally:
        os.close(descriptor)


def read_run(folder: PathLike) -> RunResult:
    """Read a run that has ended.

    Parameters
    ----------
    folder : path
        The `out` of `run`.

    Returns
    -------
    RunResult

    Raises
    ------
    OSError
        Where there is no such folder, or it may not be read.
    Error
        For a folder without a whole ``run.json``, as of a run that was interrupted.
    """
    path = Path(folder) / RECORD
    if not path.is_file():
        if (Path(folder) / LOG).is_file():
            raise Error(f"{shown(path)}: there is none, the run was interrupted: resume it")
        raise FileNotFoundError(2, "no such run", str(folder))
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        metrics = {name: _number(value) for name, value in found["metrics"].items()}
        return RunResult(
            name=str(found["name"]),
            seed=int(found["seed"]),
            status=str(found["status"]),
            metrics=metrics,
            events=[RunEvent(**event) for event in found["events"]],
            log=RunLog(Path(folder) / LOG),
            versions={str(key): str(value) for key, value in found["versions"].items()},
            scenario_sha256=str(found["scenario_sha256"]),
        )
    except (KeyError, TypeError, AttributeError, ValueError) as error:
        raise Error(
            f"{shown(path)}: expected a run's record, got another: {error!r:.200}"
        ) from error


def _number(value: object) -> float:
    if value is None:
        return math.nan
    if not isinstance(value, (int, float)):
        raise TypeError(f"expected a number, got {value!r:.60}")
    return float(value)


def _result(going: Run, folder: Path) -> RunResult:
    return RunResult(
        name=going.mission.name,
        seed=going.seed,
        status=going.status,
        metrics=going.metrics,
        events=going.events,
        log=RunLog(folder / LOG),
        versions={
            "bathyal": version("bathyal"),
            "python": platform.python_version(),
            "machine": platform.machine(),
        },
        scenario_sha256=hashlib.sha256(going.mission.text.encode()).hexdigest(),
    )


def _record(result: RunResult) -> bytes:
    metrics = {
        name: value if math.isfinite(value) else None for name, value in result.metrics.items()
    }
    record = {
        "name": result.name,
        "seed": result.seed,
        "status": result.status,
        "duration": result.metrics["duration"],
        "metrics": metrics,
        "events": [asdict(event) for event in result.events],
        "faults": [asdict(event) for event in result.faults],
        "versions": result.versions,
        "scenario_sha256": result.scenario_sha256,
    }
    return (json.dumps(record, indent=1, ensure_ascii=False) + "\n").encode()


def _saved(folder: Path) -> bytes | None:
    path = folder / STATE
    return path.read_bytes() if path.is_file() else None


def _write(path: Path, content: bytes) -> None:
    try:
        with replacing(path) as temporary:
            Path(temporary).write_bytes(content)
    except OSError as error:
        if error.filename is not None:
            raise
        raise Error(f"{shown(path)}: {error.strerror}") from error  # a full disk names no file
