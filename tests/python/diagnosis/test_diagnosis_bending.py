# SPDX-License-Identifier: BSD-3-Clause
"""A link of a URDF that bends is named, whatever rows its joints are converted to."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]

_NOISE = 3e-5  # [m]
_ROOM = np.array([1.2, -0.7, 0.4])  # of the base in the tracker's frame [m]

# Origin of each joint in the frame before it [m], and its axis: none of the origins is where the
# axis is nearest to its neighbours.
_JOINTS = (
    ((0.00, 0.00, 0.20), (0, 0, 1)),
    ((0.05, 0.14, 0.25), (0, 1, 0)),
    ((0.02, -0.11, 0.45), (0, 1, 0)),
    ((0.30, 0.03, 0.05), (1, 0, 0)),
    ((0.15, 0.00, 0.00), (0, 1, 0)),
    ((0.08, 0.00, 0.00), (1, 0, 0)),
)
_TIP = (0.12, 0.00, 0.03)
# Of links 1 … 6 [kg], and where each has its centre [m].
_MASSES = (14.0, 11.0, 7.0, 3.0, 2.0, 1.5)
_CENTERS = (
    (0.02, 0.06, 0.10),
    (0.01, -0.05, 0.20),
    (0.12, 0.02, 0.03),
    (0.07, 0.0, 0.01),
    (0.03, 0.01, 0.0),
    (0.04, 0.0, 0.02),
)


def _vector(numbers: tuple[float, ...]) -> str:
    return " ".join(str(number) for number in numbers)


def _urdf(folder: Path, sliding: int = 0) -> Path:
    """The arm as text; joint 1 moves link_1. `sliding`: of a joint that does not turn."""
    lines = ['<robot name="bent">', '<link name="link_0"/>']
    for k, ((origin, axis), mass, center) in enumerate(
        zip(_JOINTS, _MASSES, _CENTERS, strict=True), start=1
    ):
        lines += [
            f'<link name="link_{k}"><inertial><origin xyz="{_vector(center)}"/>',
            f'<mass value="{mass}"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" '
            'iyz="0"/></inertial></link>',
            f'<joint name="joint_{k}" type="{"prismatic" if k == sliding else "revolute"}">',
            f'<parent link="link_{k - 1}"/>',
            f'<child link="link_{k}"/><origin xyz="{_vector(origin)}"/>',
            f'<axis xyz="{_vector(axis)}"/>',
            '<limit lower="-3" upper="3" effort="99" velocity="1"/></joint>',
        ]
    lines += [
        '<link name="tip"/><joint name="tip_joint" type="fixed"><parent link="link_6"/>',
        f'<child link="tip"/><origin xyz="{_vector(_TIP)}"/></joint></robot>',
    ]
    path = folder / "bent.urdf"
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def _turn(axis: tuple[int, ...], angle: float) -> Array:
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]], float)
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


def _tip(q: Array, bending: int, flexibility: float, sliding: int = 0) -> Array:
    """In the base, of an arm whose link `bending` (1 … 6) is a beam between its joints' origins."""
    rotation, place = np.eye(3), np.zeros(3)
    origins, centers = [], []
    for k, ((origin, axis), center, value) in enumerate(
        zip(_JOINTS, _CENTERS, q, strict=True), start=1
    ):
        place = place + rotation @ origin
        if k == sliding:
            place = place + rotation @ axis * value
        else:
            rotation = rotation @ _turn(axis, value)
        origins.append(place)
        centers.append(place + rotation @ np.array(center))
    tip = place + rotation @ np.array(_TIP)
    origins.append(tip)
    start, end = origins[bending - 1], origins[bending]
    weights = [mass * np.array([0.0, 0.0, -9.80665]) for mass in _MASSES[bending:]]
    force = sum(weights, np.zeros(3))
    moment = sum(
        (np.cross(c - end, w) for c, w in zip(centers[bending:], weights, strict=True)),
        np.zeros(3),
    )
    beam = end - start
    length = np.linalg.norm(beam)
    along = beam / length
    # At the end of a clamped beam: a force across F gives F L³ / 3 E I and F L² / 2 E I, a moment
    # across M gives M L² / 2 E I and M L / E I.
    across = force - along * (along @ force)
    bent = moment - along * (along @ moment)
    shift = flexibility * (across * length**3 / 3 + np.cross(bent, along) * length**2 / 2)
    turn = flexibility * (np.cross(along, across) * length**2 / 2 + bent * length)
    size = np.linalg.norm(turn)
    moved = _turn(tuple(turn / size), float(size)) @ (tip - end) if size > 0 else tip - end
    return np.asarray(end + shift + moved)


@pytest.mark.parametrize("seed", [0, 1, 2, 3])
@pytest.mark.parametrize(("link", "flexibility"), [(1, 2e-5), (2, 1e-5), (3, 1.5e-4)])
def test_the_link_that_bends_is_named(
    tmp_path: Path, link: int, flexibility: float, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    q = rng.uniform(-1.6, 1.6, (200, 6))
    tips = np.array([_tip(row, link, flexibility) for row in q]) + _ROOM
    arm = bathyal.Arm.from_urdf(_urdf(tmp_path), tip="tip")
    data = bathyal.Tracked(q, tips + rng.normal(0, _NOISE, tips.shape))
    report = bathyal.diagnose(arm, data)
    assert report.verdict == "named", report.leftover
    [found] = report.effects
    assert (found.name, found.joint) == ("link_compliance", link - 1)
    low, high = found.parameters["flexibility"].interval
    width = high - low  # 3.9 standard errors: the truth is within 4 of the value
    assert low - width / 2 < flexibility < high + width / 2


def test_a_link_on_a_slide_is_as_long_wherever_it_is(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    q = rng.uniform(-1.6, 1.6, (200, 6))
    q[:, 1] *= 0.3  # [m]
    tips = np.array([_tip(row, bending=2, flexibility=1e-5, sliding=2) for row in q]) + _ROOM
    arm = bathyal.Arm.from_urdf(_urdf(tmp_path, sliding=2), tip="tip")
    report = bathyal.diagnose(
        arm, bathyal.Tracked(q, tips + rng.normal(0, 0.3 * _NOISE, tips.shape))
    )
    [found] = report.effects
    assert (found.name, found.joint) == ("link_compliance", 1)
    assert report.verdict == "named", report.leftover
    low, high = found.parameters["flexibility"].interval
    assert low - (high - low) / 2 < 1e-5 < high + (high - low) / 2
