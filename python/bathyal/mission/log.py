# SPDX-License-Identifier: BSD-3-Clause
"""Logs of runs: MCAP files with JSON messages, read as arrays."""

from __future__ import annotations

import json
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal import _core
from bathyal.io.files import PathLike, need, replacing

Array = NDArray[np.float64]

LOG = "log.mcap"
MOST_BYTES = 4 << 30


class RunLog:
    """A run's log by topic.

    Parameters
    ----------
    path : path
        An MCAP file without compression, whole or cut, its messages JSON.

    Attributes
    ----------
    path : Path
    """

    def __init__(self, path: PathLike) -> None:
        self.path = Path(path)

    @cached_property
    def _read(self) -> dict[str, Any]:
        size = self.path.stat().st_size
        if size > MOST_BYTES:
            raise _core.Error(
                f"{self.path}: expected a log below {MOST_BYTES:,} bytes, got {size:,}"
            )
        found: dict[str, Any] = _core.read_mcap(self.path.read_bytes())
        return found

    @property
    def topics(self) -> list[str]:
        """Names of all topics that have messages."""
        return sorted(self._read["topics"])

    @property
    def broken_off(self) -> str:
        """Why the file breaks off; "" for a whole one."""
        return str(self._read["reason"])

    def messages(self, topic: str) -> dict[str, NDArray[Any]]:
        """The messages of a topic, field by field.

        Parameters
        ----------
        topic : str

        Returns
        -------
        dict of arrays
            ``time`` (K,) [s]; other fields by their names, joined by dots: (K,), or (K, n) where
            they are lists of one length; NaN for null.

        Raises
        ------
        KeyError
            For a topic that there is not.
        """
        if topic not in self._read["topics"]:
            raise KeyError(f"topic: expected one of {', '.join(self.topics)}, got {topic!r}")
        rows = json.loads(self._read["topics"][topic])
        fields: dict[str, list[Any]] = {}
        for row in rows:
            stamp = row.pop("timestamp")
            fields.setdefault("time", []).append(stamp["sec"] + 1e-9 * stamp["nsec"])
            for name, value in _flat(row, ""):
                fields.setdefault(name, []).append(value)
        return {name: _column(values) for name, values in fields.items()}

    def poses(self, topic: str) -> Array:
        """The poses of a topic, ``/truth`` or ``/estimate``.

        Parameters
        ----------
        topic : str

        Returns
        -------
        (K, 4, 4) array
            world_from_vehicle.
        """
        rows = self.messages(topic)
        x, y, z, w = (rows[f"pose.orientation.{axis}"] for axis in "xyzw")
        poses = np.zeros((len(x), 4, 4))
        poses[:, 0, :3] = np.stack(
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], axis=1
        )
        poses[:, 1, :3] = np.stack(
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], axis=1
        )
        poses[:, 2, :3] = np.stack(
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], axis=1
        )
        for row, axis in enumerate("xyz"):
            poses[:, row, 3] = rows[f"pose.position.{axis}"]
        poses[:, 3, 3] = 1.0
        return poses

    def to_parquet(self, folder: PathLike) -> list[Path]:
        """Write each topic as a Parquet file: ``/sensors/dvl`` as ``sensors_dvl.parquet``.

        Parameters
        ----------
        folder : path
            Made if missing.

        Returns
        -------
        list of Path
            One a topic; columns as the fields of `messages`, rows of numbers as lists.

        Raises
        ------
        Error
            Without the package pyarrow.
        OSError
            Where the folder cannot be written.
        """
        arrow = need("pyarrow", "pyarrow", "Parquet", extra="parquet")
        parquet = need("pyarrow.parquet", "pyarrow", "Parquet", extra="parquet")
        Path(folder).mkdir(parents=True, exist_ok=True)
        written = []
        for topic in self.topics:
            columns = {
                name: list(values) if values.ndim > 1 else values
                for name, values in self.messages(topic).items()
            }
            path = Path(folder) / f"{topic.strip('/').replace('/', '_')}.parquet"
            with replacing(path) as temporary:
                parquet.write_table(arrow.table(columns), temporary)
            written.append(path)
        return written


def _flat(row: dict[str, Any], before: str) -> list[tuple[str, Any]]:
    found: list[tuple[str, Any]] = []
    for name, value in row.items():
        if isinstance(value, dict):
            found += _flat(value, f"{before}{name}.")
        else:
            found.append((before + name, value))
    return found


def _column(values: list[Any]) -> NDArray[Any]:
    first = values[0]
    if isinstance(first, (str, bool)):
        return np.array(values)
    return np.array(values, dtype=np.float64)
