# SPDX-License-Identifier: BSD-3-Clause
"""A motion as ROS' trajectory_msgs/JointTrajectory, in text that `ros2 topic pub` takes."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bathyal._core import Arm
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, known_suffix, replacing

_NANO = 1_000_000_000
_LONGEST = 2**31 - 1  # [s], of a duration's int32


def joint_trajectory(
    q: ArrayLike, time: ArrayLike, names: Sequence[str], *, frame: str = ""
) -> dict[str, Any]:
    """The message as plain data.

    Parameters
    ----------
    q : (K, n) array
        [rad], [m] of sliding joints.
    time : (K,) array
        [s], rising; `time_from_start` counts from the first.
    names : sequence of str
        Of the n joints.
    frame : str
        Of the header.

    Returns
    -------
    dict
        With ``header``, ``joint_names`` and ``points``; velocities by central differences, 0 at
        both ends.

    Raises
    ------
    ValueError
        For other counts, times that do not rise, values that are not finite, names that repeat.

    Examples
    --------
    >>> message = joint_trajectory([[0.0], [0.5], [1.0]], [0, 0.25, 0.5], ["axis"])
    >>> message["points"][1]
    {'positions': [0.5], 'velocities': [2.0], 'time_from_start': {'sec': 0, 'nanosec': 250000000}}
    """
    rows, moments = np.asarray(q, float), np.asarray(time, float)
    if rows.ndim != 2 or rows.shape[0] == 0 or rows.shape[1] != len(names):
        raise argument_error("q", f"shape (K, {len(names)}), K at least 1", f"shape {rows.shape}")
    if moments.shape != (len(rows),):
        raise argument_error("time", f"shape ({len(rows)},)", f"shape {moments.shape}")
    if not (np.isfinite(rows).all() and np.isfinite(moments).all()):
        raise argument_error("q", "finite numbers, as of time", "nan or inf")
    nanos = np.rint((moments - moments[0]) * _NANO)
    if np.any(np.diff(nanos) <= 0) or nanos[-1] > _LONGEST * _NANO:
        raise argument_error("time", "values that rise by a nanosecond or more", "others")
    if len(set(names)) != len(names) or not all(names):
        raise argument_error("names", "a name for each joint, none twice", repr(list(names)))
    velocity = _velocities(rows, moments)
    points = [
        {
            "positions": positions,
            "velocities": velocities,
            "time_from_start": {"sec": int(nano) // _NANO, "nanosec": int(nano) % _NANO},
        }
        for positions, velocities, nano in zip(
            rows.tolist(), velocity.tolist(), nanos.astype(np.int64).tolist(), strict=True
        )
    ]
    return {
        "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": frame},
        "joint_names": list(names),
        "points": points,
    }


def write_joint_trajectory(
    path: PathLike, q: ArrayLike, time: ArrayLike, arm: Arm | Sequence[str], *, frame: str = ""
) -> None:
    """Write a motion as trajectory_msgs/JointTrajectory.

    Parameters
    ----------
    path : path
        ``.yaml``, ``.yml`` or ``.json``; the file appears whole or not at all.
    q, time, frame
        As `joint_trajectory`.
    arm : Arm, or sequence of str
        Whose joints move, or their names.

    Raises
    ------
    ValueError
        As `joint_trajectory`; for another suffix.
    OSError
        Where the file cannot be written.
    """
    suffix = known_suffix(path, (".yaml", ".yml", ".json"), "trajectory")
    names = arm.joint_names if isinstance(arm, Arm) else list(arm)
    message = joint_trajectory(q, time, names, frame=frame)
    text = _json(message) if suffix == ".json" else _yaml(message)
    with replacing(path) as aside:
        aside.write_text(text, encoding="utf-8")


def _velocities(q: NDArray[np.float64], time: NDArray[np.float64]) -> NDArray[np.float64]:
    velocity = np.zeros_like(q)
    if len(q) > 2:
        velocity[1:-1] = np.gradient(q, time, axis=0, edge_order=1)[1:-1]
    return velocity


def _json(message: dict[str, Any]) -> str:
    points = ",\n".join(f"    {json.dumps(point)}" for point in message["points"])
    head = ",\n".join(
        f"  {json.dumps(key)}: {json.dumps(message[key])}" for key in ("header", "joint_names")
    )
    return f'{{\n{head},\n  "points": [\n{points}\n  ]\n}}\n'


def _yaml(message: dict[str, Any]) -> str:
    """JSON's scalars and lists are YAML's, too: names and numbers are quoted and written alike."""
    lines = [
        "# trajectory_msgs/msg/JointTrajectory",
        "header:",
        f"  stamp: {json.dumps(message['header']['stamp'])}",
        f"  frame_id: {json.dumps(message['header']['frame_id'])}",
        f"joint_names: {json.dumps(message['joint_names'])}",
        "points:",
    ]
    for point in message["points"]:
        lines.append(f"- positions: {_numbers(point['positions'])}")
        lines.append(f"  velocities: {_numbers(point['velocities'])}")
        lines.append(f"  time_from_start: {json.dumps(point['time_from_start'])}")
    return "\n".join(lines) + "\n"


def _numbers(values: Sequence[float]) -> str:
    """YAML 1.1, as ROS reads it, takes 1e-07 for text: exponents get a point."""
    return "[" + ", ".join(_number(value) for value in values) + "]"


def _number(value: float) -> str:
    text = repr(value)
    mantissa, sign, exponent = text.partition("e")
    if sign and "." not in mantissa and math.isfinite(value):
        return f"{mantissa}.0e{exponent}"
    return text
