# SPDX-License-Identifier: BSD-3-Clause
"""What the drivers of Universal Robots' arms take: calibration file and ROS kinematics.

Both describe six turning joints and no more: the way to the base before the first and what lies
behind the last are named in comments, for the mounting and the tool.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Arm, arm_from_chain, chain_from_arm
from bathyal.arm.urdf_writer import rpy_of
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, replacing

Floats = NDArray[np.float64]

_LINKS = ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3")
_COLUMNS = ("theta", "a", "d", "alpha")
# A longer d loses a nanometre to rounding, several times over.
_LONGEST = 1e5  # [m]
_NOTHING = 1e-12  # [m, 1]
_PARALLEL = 1e-15  # [rad] rounding


def write_ros_kinematics(arm: Arm, path: PathLike, *, hash: str = "bathyal") -> None:
    """Write the ``kinematics.yaml`` that ROS' ur_description takes in place of its default.

    Each joint's origin in the frame of the joint before it (x, y, z [m]; roll, pitch, yaw [rad] as
    URDF reads them), the first in ``base_link_inertia``, the maker's base frame. So Hayati's beta
    is written exactly. What lies behind the last joint (a, alpha and beta of the last row, flange
    and tool) and `base` are no part of the file: comments give them.

    Parameters
    ----------
    arm : Arm
        Six turning joints, each with a coordinate of its own.
    path : path
        The file appears whole or not at all.
    hash : str
        The driver compares it with the checksum of the connected controller's own calibration
        (``calib_…``) and warns where they differ, as they must for any other calibration.

    Raises
    ------
    ValueError
        For an arm with other joints.
    OSError
        Where the file cannot be written.
    """
    _need_six_joints(arm)
    origins, behind = _origins(arm)
    lines = ["# Origins of the joints, each in the frame of the one before [m, rad]."]
    lines += _beyond("behind wrist_3, set it as the tool (tool0 to flange and tool)", behind)
    lines += _beyond("before base_link_inertia, set it as the mounting", np.asarray(arm.base))
    lines += ["# Not the controller's own calibration.", "kinematics:"]
    for link, origin in zip(_LINKS, origins, strict=True):
        lines.append(f"  {link}:")
        numbers = [*origin[:3, 3], *rpy_of(origin)]
        for key, number in zip(("x", "y", "z", "roll", "pitch", "yaw"), numbers, strict=True):
            lines.append(f"    {key}: {_text(number)}")
    lines.append(f"  hash: {hash}")
    _write(path, lines)


def write_ur_calibration(arm: Arm, path: PathLike, nominal: Arm | None) -> None:
    """Write the differences to the maker's table as a controller's ``calibration.conf`` has them.

    ``delta_theta``, ``delta_a``, ``delta_d`` and ``delta_alpha`` [rad, m] of section ``[mounting]``
    are added to the controller's own table, in which there is no beta: a row that has one becomes
    the common normal's, exactly, whose d between nearly parallel axes may be many metres (in the
    maker's own calibrations, too). What the table cannot hold is named in comments.

    Parameters
    ----------
    arm : Arm
        Six turning joints, each with a coordinate of its own, the first about z of the base.
    path : path
        The file appears whole or not at all.
    nominal : Arm
        The maker's arm, of the same kind, for instance ``bathyal.arms.ur10e()``.

    Raises
    ------
    ValueError
        For an arm with other joints, a first axis that is not the base's z, or axes so nearly
        parallel that no table without beta describes them to a nanometre.
    OSError
        Where the file cannot be written.
    """
    if nominal is None:
        raise argument_error("nominal", "the maker's arm, for instance arms.ur10e()", None)
    (rows, behind), (maker, _) = _plain_rows(arm, "arm"), _plain_rows(nominal, "nominal")
    delta = rows - maker
    delta[:, [0, 3]] = np.remainder(delta[:, [0, 3]] + np.pi, 2 * np.pi) - np.pi
    lines = [f"# Added to the table of {nominal.name or 'the maker'} [rad, m]."]
    lines += _beyond("behind the last row, set it as the tool", behind)
    lines += _beyond("before the first row, set it as the mounting", np.asarray(arm.base))
    lines.append("[mounting]")
    for name, column in zip(_COLUMNS, delta.T, strict=True):
        lines.append(f"delta_{name} = [ {', '.join(map(_text, column))}]")
    _write(path, lines)


def _need_six_joints(arm: Arm, name: str = "arm") -> None:
    joints = chain_from_arm(arm)["joints"][:-1]
    kinds = [joint["type"] for joint in joints]
    if kinds != ["revolute"] * 6 or arm.size != 6:
        raise argument_error(
            name,
            "six turning joints, each with a coordinate of its own",
            f"{', '.join(kinds)} and {arm.size} coordinates",
        )


def _origins(arm: Arm) -> tuple[list[Floats], Floats]:
    """Of joints whose frames turn about their own z, and wrist_3_from_tool."""
    table = arm.to_dh()
    rows = np.stack([table.theta, table.d, table.a, table.alpha, table.beta], axis=1)
    before = np.asarray(table.root)
    origins = []
    for theta, d, a, alpha, beta in rows:
        origins.append(before @ _turned(theta, 2, along=d))
        before = _turned(alpha, 0, along=a) @ _turned(beta, 1)
    return origins, before @ np.asarray(table.flange) @ np.asarray(arm.tool)


def _plain_rows(arm: Arm, name: str) -> tuple[Floats, Floats]:
    """(6, 4) theta, a, d, alpha of a table without beta, and last_row_from_tool."""
    _need_six_joints(arm, name)
    if np.any(arm.to_dh().beta):
        plain = arm_from_chain(chain_from_arm(arm), nearly_parallel=0.0)
    else:
        plain = arm
    table = plain.to_dh()
    if not np.allclose(table.root, np.eye(4), rtol=0, atol=_NOTHING):
        raise argument_error(name, "a first joint about z of the base", "another axis")
    rows = np.stack([table.theta, table.a, table.d, table.alpha], axis=1)
    if np.any(np.abs(rows[:, 2]) > _LONGEST):
        sine = np.abs(np.sin(rows[:5, 3]))
        row = int(np.argmin(np.where(sine > _PARALLEL, sine, np.inf)))
        raise argument_error(
            name,
            "axes that a table without beta describes to a nanometre",
            f"axes {row + 1} and {row + 2} that are parallel but for {sine[row]:.1e} rad",
        )
    behind = np.asarray(table.flange)
    last = _turned(np.arctan2(behind[2, 1], behind[2, 2]), 0, along=behind[0, 3])
    if np.allclose(last, behind, rtol=0, atol=_NOTHING) and not np.any(rows[5, [1, 3]]):
        rows[5, 1], rows[5, 3] = last[0, 3], np.arctan2(behind[2, 1], behind[2, 2])
        behind = np.eye(4)
    return rows, behind @ np.asarray(arm.tool)


def _turned(angle: float, axis: int, along: float = 0.0) -> Floats:
    """A turn about, and a way along, one axis."""
    pose = np.eye(4)
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    pose[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
    pose[axis, 3] = along
    return pose


def _beyond(what: str, pose: Floats) -> list[str]:
    """A comment for a transform that the file has no place for."""
    if np.allclose(pose, np.eye(4), rtol=0, atol=_NOTHING):
        return []
    numbers = " ".join(map(_text, [*pose[:3, 3], *rpy_of(pose)]))
    return [f"# {what}: x y z [m] roll pitch yaw [rad] {numbers}"]


def _write(path: PathLike, lines: Sequence[str]) -> None:
    with replacing(path) as aside:
        aside.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _text(number: Any) -> str:
    return repr(float(number) + 0.0)
