# SPDX-License-Identifier: BSD-3-Clause
"""Arms from and to files; the JSON file that keeps all of an arm."""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from bathyal._core import Arm, Error, arm_from_parts, arm_parts
from bathyal.arm_exports import write_ros_kinematics, write_ur_calibration
from bathyal.errors import argument_error
from bathyal.files import PathLike, known_suffix, opened, reading, replacing
from bathyal.urdf import arm_from_urdf
from bathyal.urdf_writer import urdf_of_arm

_FORMAT = "bathyal arm"
_VERSION = 1
_MOST_BYTES = 64 << 20

# The file's keys are the engine's with their unit; `{}` is rad or m, as the joint turns or slides.
_ARM_KEYS = {
    "name": "name",
    "source": "source",
    "base": "world_from_base_m",
    "root": "base_from_root_m",
    "joints": "joints",
    "links": "links",
    "flange": "last_row_from_flange_m",
    "tool": "flange_from_tool_m",
}
_JOINT_KEYS = {
    "name": "name",
    "type": "type",
    "a": "a_m",
    "alpha": "alpha_rad",
    "d": "d_m",
    "theta": "theta_rad",
    "beta": "beta_rad",
    "coordinate": "coordinate",
    "follows": "follows",
    "multiplier": "multiplier",
    "offset": "offset_{}",
    "lower": "lower_{}",
    "upper": "upper_{}",
    "velocity": "velocity_{}_per_s",
    "effort": "effort_{}",
}
_LINK_KEYS = {
    "name": "name",
    "frame": "row_from_link_m",
    "mass": "mass_kg",
    "center_of_mass": "center_of_mass_m",
    "inertia": "inertia_kg_m2",
    "volume": "volume_m3",
    "center_of_buoyancy": "center_of_buoyancy_m",
    "frames": "frames",
}
_FRAME_KEYS = {"name": "name", "pose": "link_from_frame_m"}
_UNITS = {"revolute": ("rad", "Nm"), "prismatic": ("m", "N"), "fixed": ("rad", "Nm")}


def read_arm(path: PathLike, **options: Any) -> Arm:
    """Read an arm.

    Parameters
    ----------
    path : path
        ``.json`` as `Arm.save` writes it, or ``.urdf``.
    **options
        Of `Arm.from_urdf`, for a URDF: `tip`, `root`, `name`.

    Returns
    -------
    Arm

    Raises
    ------
    ValueError
        For a suffix that is not read; options for a JSON file; as `Arm.from_urdf`.
    OSError
        Where there is no such file, or it may not be read.
    Error
        For a file that is broken, of another format or of a version that is not known.

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
    with opened(path) as (stream, size), reading(path, "arm"):
        if size > _MOST_BYTES:
            raise Error(f"expected at most {_MOST_BYTES >> 20} MB, got {size / 2**20:.0f} MB")
        told = json.loads(stream.read(), parse_constant=_refuse_constant)
        return _arm(told)


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
            raise argument_error(next(iter(options)), "nothing beside an arm's name", "one")
        arm: Arm = getattr(arms, known)()
        return arm
    if Path(text).suffix.lower() in (".json", ".urdf"):
        return read_arm(text, **options)
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
        For ``.conf``: the maker's arm, to which the file tells the differences.

    Raises
    ------
    ValueError
        For a suffix that is not written, an arm that the format cannot tell, a `nominal` that is
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
    with replacing(path) as aside:
        aside.write_text(_laid_out(_told(arm)) + "\n", encoding="utf-8")


_WRITERS: dict[str, Callable[[Arm, PathLike], object]] = {
    ".json": _write_json,
    ".urdf": urdf_of_arm,
    ".yaml": write_ros_kinematics,
    ".yml": write_ros_kinematics,
}


def _told(arm: Arm) -> dict[str, Any]:
    parts = arm_parts(arm)
    parts["joints"] = [_renamed(joint, _joint_keys(joint["type"])) for joint in parts["joints"]]
    for link in parts["links"]:
        link["frames"] = [_renamed(frame, _FRAME_KEYS) for frame in link["frames"]]
    parts["links"] = [_renamed(link, _LINK_KEYS) for link in parts["links"]]
    return {"format": _FORMAT, "version": _VERSION, **_renamed(parts, _ARM_KEYS)}


def _laid_out(value: Any, indent: str = "") -> str:
    """JSON as a person would set it: a line for a key, and one for a row of numbers."""
    deeper = indent + "  "
    if isinstance(value, dict) and value:
        lines = [f"{deeper}{json.dumps(key)}: {_laid_out(value[key], deeper)}" for key in value]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    if isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value):
        lines = [deeper + _laid_out(item, deeper) for item in value]
        return "[\n" + ",\n".join(lines) + f"\n{indent}]"
    return json.dumps(value, allow_nan=False, ensure_ascii=False)


def _renamed(parts: dict[str, Any], keys: dict[str, str]) -> dict[str, Any]:
    return {told: _plain(parts[key]) for key, told in keys.items()}


def _plain(value: Any) -> Any:
    """What JSON can tell; no limit is null."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, float) and math.isinf(value):
        return None
    return value


def _joint_keys(kind: str) -> dict[str, str]:
    if kind not in _UNITS:
        raise Error(f"joint type: expected {', '.join(_UNITS)}, got {kind!r}")
    unit, effort = _UNITS[kind]
    keys = {key: told.format(unit) for key, told in _JOINT_KEYS.items()}
    return keys | {"effort": f"effort_{effort}"}


def _arm(told: Any) -> Arm:
    if not isinstance(told, dict) or told.get("format") != _FORMAT:
        raise Error(f'it does not say "format": "{_FORMAT}"')
    if told.get("version") != _VERSION:
        raise Error(f"expected version {_VERSION}, got {told.get('version')!r}")
    rest = {key: value for key, value in told.items() if key not in ("format", "version")}
    parts = _read(rest, _ARM_KEYS, "the arm")
    parts["joints"] = [_joint(joint) for joint in _list(parts, "joints")]
    parts["links"] = [_read(link, _LINK_KEYS, "a link") for link in _list(parts, "links")]
    for link in parts["links"]:
        link["frames"] = [_read(frame, _FRAME_KEYS, "a frame") for frame in _list(link, "frames")]
    return arm_from_parts(parts)


def _joint(told: Any) -> dict[str, Any]:
    kind = told.get("type", "revolute") if isinstance(told, dict) else "revolute"
    return _read(told, _joint_keys(str(kind)), "a joint")


def _read(told: Any, keys: dict[str, str], what: str) -> dict[str, Any]:
    """Back to the engine's keys; null is left out, and so has its default."""
    if not isinstance(told, dict):
        raise Error(f"{what}: expected an object, got {told!r:.60}")
    back = {told_key: key for key, told_key in keys.items()}
    unknown = [key for key in told if key not in back]
    if unknown:
        raise Error(f"{what}: its key {unknown[0]!r} is not known; known are {', '.join(back)}")
    return {back[key]: value for key, value in told.items() if value is not None}


def _list(parts: dict[str, Any], key: str) -> list[Any]:
    value = parts.get(key, [])
    if not isinstance(value, list):
        raise Error(f"{key}: expected a list, got {value!r:.60}")
    return value


def _refuse_constant(word: str) -> float:
    raise Error(f"the number {word} is none")
