# SPDX-License-Identifier: BSD-3-Clause
"""Simulated touches, to try an identification or a diagnosis on: an arm that differs from its
drawing, a hand that brings its tip to three points, on request an effect that is no geometry."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bathyal._core import Arm, Error, Touches
from bathyal.errors import argument_error
from bathyal.identify.hidden import HiddenEffect, hide_effect
from bathyal.io.files import PathLike
from bathyal.io.tables import write_table

Floats = NDArray[np.float64]

NAMES = ("left", "right", "top")
_TITLES = {"time": "time_s", "session": "session", "temperature": "temperature_C"}
_COUNT, _COUNT_HIDDEN = 21, 40  # touches of each point: as the paper's; enough for a diagnosis
_LEAST_JOINTS = 4  # fewer reach a point in a handful of poses
_PROBE = 0.12  # length of the tool, as a share of the arm's reach
_APART = 0.22  # left from right
_AHEAD, _UP, _HIGHER, _BACK = 0.5, 0.25, 0.16, 0.1  # where the points lie, in the same share
_LENGTH_ERROR, _ANGLE_ERROR = 0.4e-3, 1.5e-3  # of an assembly without a measuring machine [m, rad]
_TRIES = 40  # poses tried for one that is reached
_SPREAD = 1.2  # of the joints about their middle, where a search for a pose begins [rad]


@dataclass(frozen=True)
class SimulatedTouches:
    """Touches of an arm whose truth is known.

    Attributes
    ----------
    touches : Touches
        Of points "left", "right" and "top", without a known distance.
    true_arm : Arm
        Its tool set; without the hidden effect.
    points : (3, 3) array
        World [m].
    apart : float
        From left to right [m]: a whole number of centimetres, to be given as a known distance.
    hidden : HiddenEffect or None
        What `hide` asked for, with its values.
    """

    touches: Touches
    true_arm: Arm
    points: Floats
    apart: float
    hidden: HiddenEffect | None = None


def simulate_touches(
    arm: Arm,
    *,
    count: int | None = None,
    noise: float = 0.09e-3,
    seed: int = 0,
    true_arm: Arm | None = None,
    hide: str = "",
    hide_size: float | None = None,
) -> SimulatedTouches:
    """Touch three points with an arm that differs from its drawing.

    Parameters
    ----------
    arm : Arm
        Nominal; four moving joints or more.
    count : int
        Touches of each point, 2 or more. Unless given, 21 as in Yukhimets, Gubankov (2023), and 40
        with `hide`.
    noise : float
        Standard deviation of a touch, per axis [m].
    seed : int
        Of the random numbers: the same touches for the same number.
    true_arm : Arm, optional
        The arm that touches. Unless given, each row of the drawing is off by about 0.4 mm and
        1.5 mrad. A probe is added to it where it has no tool.
    hide : str
        An effect of the library that the arm has as well: "joint_harmonic", or "joint_harmonic@3"
        for joint 3, counted from 1; `bathyal.identify.hidden.HIDEABLE` has the names. Covariates
        that it depends on (session, time, temperature, direction) are recorded in the touches, and
        the points are then touched in rounds, a touch a minute.
    hide_size : float, optional
        By how much it moves the tip, 3-D rms over the touches [m]. Unless given 1 mm, of
        "thermal" 0.3 mm.

    Returns
    -------
    SimulatedTouches

    Raises
    ------
    ValueError
        For bad numbers, an arm of fewer than four joints, no such effect or joint.
    Error
        Where the points lie beyond the arm's reach or limits.

    Examples
    --------
    >>> import bathyal
    >>> made = simulate_touches(bathyal.arms.ur10e(), count=4)
    >>> made.touches, made.touches.names[0], made.apart
    (Touches(12 poses, 6 joints), 'left', 0.35)
    >>> made = simulate_touches(bathyal.arms.ur10e(), hide="joint_compliance@2", hide_size=0.5e-3)
    >>> print(made.hidden)
    joint_compliance of joint 2, 0.5 mm rms at the tip
    """
    if arm.size < _LEAST_JOINTS:
        raise argument_error("arm", f"{_LEAST_JOINTS} moving joints or more", arm.size)
    if hide_size is not None and not hide:
        raise argument_error("hide_size", "nothing without hide", hide_size)
    if count is None:
        count = _COUNT_HIDDEN if hide else _COUNT
    if count < 2:
        raise argument_error("count", "2 or more", count)
    if not 0 <= noise < math.inf:
        raise argument_error("noise", "0 or more", noise)
    rng = np.random.default_rng(seed)
    reach = _reach(arm)
    true = _assembled(arm, rng) if true_arm is None else true_arm.copy()
    if not np.any(np.asarray(true.tool)[:3, 3]):
        true.tool = _probe(_PROBE * reach)
    points, apart = _points(arm, reach)
    q = np.vstack([_touch(true, point, count, noise, rng) for point in points])
    label = np.repeat(np.arange(len(points)), count)
    names = dict(enumerate(NAMES))
    if not hide:
        return SimulatedTouches(Touches(q, label, names=names), true, points, apart)
    rounds = np.arange(len(q)).reshape(len(points), count).T.ravel()
    q, recorded, hidden = hide_effect(hide, true, q[rounds], hide_size, rng)
    touches = Touches(q, label[rounds], names=names, covariates={**recorded})
    return SimulatedTouches(touches, true, points, apart, hidden)


def write_touches(touches: Touches, path: PathLike, *, comment: str = "") -> None:
    """Write touches as a table that `bathyal.read_touches` reads back: degrees, to 0.0001.

    Of an arm that only turns. Covariates `time`, `session`, `temperature` and `direction` have
    columns of their own; what is known of the points is no part of the table.

    Parameters
    ----------
    touches : Touches
    path : path
        The file appears whole or not at all.
    comment : str
        Lines above the table.
    """
    names = [touches.names.get(label, str(label)) for label in touches.point.tolist()]
    for name in dict.fromkeys(names):
        if name and name.splitlines() != [name]:
            raise argument_error("touches", "names of points of one line each", repr(name))
    joints = touches.q.shape[1]
    titles = ["point", *(f"q{k + 1}_deg" for k in range(joints))]
    columns = [[f"{angle:.4f}" for angle in column] for column in np.degrees(touches.q).T]
    for name, values in touches.covariates.items():
        titles += (
            [f"{name}_{k + 1}" for k in range(joints)] if name == "direction" else [_TITLES[name]]
        )
        columns += [
            [f"{value:g}" for value in column] for column in values.reshape(len(names), -1).T
        ]
    rows = ([name, *cells] for name, *cells in zip(names, *columns, strict=True))
    write_table(path, titles, rows, comments=comment.splitlines())


def _reach(arm: Arm) -> float:
    """Of the arm stretched out: the rows' lengths behind the first joint [m]."""
    table = arm.to_dh()
    lengths = np.hypot(table.a, table.d)
    return float(np.sum(lengths[1:]))


def _assembled(arm: Arm, rng: np.random.Generator) -> Arm:
    """The arm as it might have been put together."""
    from bathyal._core import arm_from_parts, arm_parts

    parts = arm_parts(arm)
    for joint in parts["joints"]:
        if joint["type"] == "fixed":
            continue
        for name, error in (("a", _LENGTH_ERROR), ("d", _LENGTH_ERROR),
                            ("theta", _ANGLE_ERROR), ("alpha", _ANGLE_ERROR)):  # fmt: skip
            joint[name] += rng.normal(0, error)
    return arm_from_parts(parts)


def _probe(length: float) -> Floats:
    """A tip off the last axis: on it the last joint would not move the tip."""
    tool = np.eye(4)
    tool[:3, 3] = np.round([0.3 * length, -0.2 * length, length], 3)
    return tool


def _points(arm: Arm, reach: float) -> tuple[Floats, float]:
    """Three points in front of the arm, two of them a known distance apart."""
    apart = round(_APART * reach, 2)
    middle = np.array([_AHEAD * reach, 0.0, _UP * reach])
    aside = np.array([0.0, apart / 2, 0.0])
    top = middle + np.array([-_BACK * reach, 0.0, _HIGHER * reach])
    base = np.asarray(arm.base)
    return np.stack([middle + aside, middle - aside, top]) @ base[:3, :3].T + base[:3, 3], apart


def _touch(
    arm: Arm, point: ArrayLike, count: int, noise: float, rng: np.random.Generator
) -> Floats:
    """(count, n) poses, within limits, whose tip is at the point but for noise."""
    lower = np.maximum(arm.lower, -np.pi)
    upper = np.minimum(arm.upper, np.pi)
    middle, half = (lower + upper) / 2, (upper - lower) / 2
    half = np.minimum(half, _SPREAD)
    tries = _TRIES * count
    start = middle + rng.uniform(-1, 1, (tries, arm.size)) * half
    places = (
        np.asarray(point) + rng.normal(0, noise, (tries, 3))
        if noise
        else np.tile(point, (tries, 1))
    )
    found = arm.inverse(places, start, task="position", max_starts=1)
    reached = np.flatnonzero(np.asarray(found.status) == "reached")
    if len(reached) < count:
        raise Error(f"{arm.name or 'the arm'} reaches the example's points in {len(reached)} poses "
                    f"of {tries}: expected {count} of them")  # fmt: skip
    return np.asarray(found.q)[reached[:count]]
