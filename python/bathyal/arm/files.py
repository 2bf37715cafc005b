# SPDX-License-Identifier: BSD-3-Clause
"""Arms from and to files; the JSON file that keeps all of an arm."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bathyal._core import Arm, CorrectedArm
from bathyal.arm import corrected_files as corrected_arm_files
from bathyal.arm.exports import write_ros_kinematics, write_ur_calibration
from bathyal.arm.json import arm_fields, read_json, rigid_arm, write_json
from bathyal.arm.urdf_reader import arm_from_urdf
from bathyal.arm.urdf_writer import urdf_of_arm
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, known_suffix, read_document, reading


def read_arm(path: PathLike, **options: Any) -> Arm | CorrectedArm:
    """Read an arm.

    Parameters
    ----------
    path : path
        ``.json`` as `Arm.save` and `CorrectedArm.save` write it, or ``.urdf``.
    **options
        Of `Arm.from_urdf`, for a URDF: `tip`, `root`, `name`.

    Returns
    -------
    Arm, or CorrectedArm
        The second where the file has effects inside.

    Raises
    ------
    ValueError
        For a suffix that is not read; options for a JSON file; as `Arm.from_urdf`.
    OSError
        Where there is no such file, or it may not be read.
    Error
        For a file that is broken, of another format or of a version that is not known, for one
        that is not as the manifest of its folder says, and for an effect of your own that was not
        registered (`bathyal.effects.register`).

    Examples
    --------
    >>> import bathyal, tempfile
    >>> path = tempfile.mkdtemp() + "/lever.json"
    >>> bathyal.Arm.from_dh(a=[0.3], alpha=[0], d=[0], theta=[0], name="lever").save(path)
    >>> bathyal.read_arm(path)
    Arm("lever", 1 joint)
    """
    if known_suffix(path, (".json", ".urdf"), "robot") == ".urdf":
        return arm_from_urdf(path, **options)
    if options:
        name = next(iter(options))
        raise argument_error(name, "only for a .urdf file", "one for .json")
    content = read_document(path)
    with reading(path, "arm"):
        fields = read_json(content)
        corrected = any(key in fields for key in corrected_arm_files.KEYS)
        return corrected_arm_files.corrected_arm(fields) if corrected else rigid_arm(fields)


def find_arm(name: PathLike, **options: Any) -> Arm:
    """An arm by its name in `bathyal.arms`, or from a file.

    Parameters
    ----------
    name : str or path
        Such as "ur10e" or "Reach Alpha 5"; case, blanks and hyphens do not count. Or a .urdf or
        .json file.
    **options
        As of `read_arm`, for a URDF.

    Raises
    ------
    ValueError
        For a name that no arm has; the text lists those that there are.
    Error, OSError
        As `read_arm`.

    Examples
    --------
    >>> find_arm("UR10e")
    Arm("UR10e", 6 joints)
    """
    from bathyal import arms

    text = os.fspath(name)
    known = re.sub(r"[ _-]+", "_", text.strip().lower())
    if known in arms.__all__:
        if options:
            raise argument_error(next(iter(options)), "nothing else with an arm's name", "one")
        arm: Arm = getattr(arms, known)()
        return arm
    if Path(text).suffix.lower() in (".json", ".urdf"):
        found = read_arm(text, **options)
        if isinstance(found, CorrectedArm):
            raise argument_error("arm", "an arm without effects", f"{found!r} in {text}")
        return found
    raise argument_error("arm", f"{', '.join(arms.__all__)}, or a .urdf or .json file", repr(text))


def save_arm(arm: Arm, path: PathLike) -> None:
    """Write all of an arm; what `Arm.save` does.

    Parameters
    ----------
    arm : Arm
    path : path
        ``.json``: rows, limits, what follows what, links with masses, volumes and frames, base,
        tool, name and source, to the last digit. The file appears whole or not at all.

    Raises
    ------
    ValueError
        For another suffix.
    OSError
        Where the file cannot be written.
    """
    known_suffix(path, (".json",), "JSON")
    _write_json(arm, path)


def write_arm(arm: Arm, path: PathLike, *, nominal: Arm | None = None) -> None:
    """Write an arm in the format of the suffix; what `Arm.write` does.

    Parameters
    ----------
    arm : Arm
    path : path
        ``.json`` (all of it), ``.urdf``, ``.yaml`` or ``.yml`` (the kinematics of ROS'
        ur_description) or ``.conf`` (Universal Robots' calibration). The file appears whole or not
        at all.
    nominal : Arm, optional
        For ``.conf``: the maker's arm, to which the file holds the differences.

    Raises
    ------
    ValueError
        For a suffix that is not written, an arm that the format cannot hold, a `nominal` that is
        missing or not asked for.
    OSError
        Where the file cannot be written.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "kinematics.yaml"
    >>> bathyal.arms.ur10e().write(path)
    >>> path.read_text().splitlines()[2:4]
    ['kinematics:', '  shoulder:']
    """
    suffix = known_suffix(path, (*_WRITERS, ".conf"), "robot")
    if suffix == ".conf":
        write_ur_calibration(arm, path, nominal)
        return
    if nominal is not None:
        raise argument_error("nominal", "only for a .conf file", f"one for {suffix}")
    _WRITERS[suffix](arm, path)


def _write_json(arm: Arm, path: PathLike) -> None:
    write_json(arm_fields(arm), path)


_WRITERS: dict[str, Callable[[Arm, PathLike], object]] = {
    ".json": _write_json,
    ".urdf": urdf_of_arm,
    ".yaml": write_ros_kinematics,
    ".yml": write_ros_kinematics,
}
