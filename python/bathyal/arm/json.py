# SPDX-License-Identifier: BSD-3-Clause
"""The JSON that keeps all of an arm: keys, layout, and what is refused."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from bathyal._core import Arm, Error, Shape, arm_from_parts, arm_parts
from bathyal.io.files import PathLike, replacing
from bathyal.io.formats.numbers import refuse_truth_values

FORMAT = "bathyal arm"
VERSION = 1
_FRAMING = ("format", "version", "run")

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
    "collision": "collision",
    "visual": "visual",
}
_SHAPE_KEYS = {
    "kind": "kind",
    "size": "size_m",
    "radius": "radius_m",
    "length": "length_m",
    "file": "file",
    "scale": "scale",
    "pose": "link_from_shape_m",
    "part": "part",
}
_SHAPES = ("collision", "visual")
_FRAME_KEYS = {"name": "name", "pose": "link_from_frame_m"}
_UNITS = {"revolute": ("rad", "Nm"), "prismatic": ("m", "N"), "fixed": ("rad", "Nm")}


def write_json(fields: dict[str, Any], path: PathLike) -> None:
    """Write a file's contents; it appears whole or not at all."""
    with replacing(path) as aside:
        aside.write_text(_laid_out(fields) + "\n", encoding="utf-8")


def arm_fields(arm: Arm) -> dict[str, Any]:
    """The fields of a rigid arm's file."""
    parts = arm_parts(arm)
    parts["joints"] = [_renamed(joint, _joint_keys(joint["type"])) for joint in parts["joints"]]
    for link in parts["links"]:
        link["frames"] = [_renamed(frame, _FRAME_KEYS) for frame in link["frames"]]
        for key in _SHAPES:  # an arm without shapes has the file it always had
            shapes = [_renamed(shape.as_dict(), _SHAPE_KEYS) for shape in link.pop(key)]
            if shapes:
                link[key] = shapes
    parts["links"] = [_renamed(link, _LINK_KEYS) for link in parts["links"]]
    return {"format": FORMAT, "version": VERSION, **_renamed(parts, _ARM_KEYS)}


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
    return {name: _plain(parts[key]) for key, name in keys.items() if key in parts}


def _plain(value: Any) -> Any:
    """What JSON can hold; no limit is null."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, float) and math.isinf(value):
        return None
    return value


def _joint_keys(kind: str) -> dict[str, str]:
    if kind not in _UNITS:
        raise Error(f"joint type: expected {', '.join(_UNITS)}, got {kind!r}")
    unit, effort = _UNITS[kind]
    keys = {key: name.format(unit) for key, name in _JOINT_KEYS.items()}
    return keys | {"effort": f"effort_{effort}"}


def read_json(text: bytes) -> dict[str, Any]:
    """The fields of an arm's file, without its format and version, and the run that wrote it."""
    fields = json.loads(text, parse_constant=_refuse_constant)
    if not isinstance(fields, dict) or fields.get("format") != FORMAT:
        raise Error(f'it does not say "format": "{FORMAT}"')
    refuse_truth_values(fields)
    if fields.get("version") != VERSION:
        raise Error(f"expected version {VERSION}, got {fields.get('version')!r}")
    return {key: value for key, value in fields.items() if key not in _FRAMING}


def rigid_arm(fields: dict[str, Any]) -> Arm:
    """The arm of a file's contents."""
    parts = read_keys(fields, _ARM_KEYS, "the arm")
    parts["joints"] = [_joint(joint) for joint in listed(parts, "joints")]
    parts["links"] = [read_keys(link, _LINK_KEYS, "a link") for link in listed(parts, "links")]
    for link in parts["links"]:
        link["frames"] = [read_keys(f, _FRAME_KEYS, "a frame") for f in listed(link, "frames")]
        for key in _SHAPES:
            link[key] = [_shape(shape) for shape in listed(link, key)]
    return arm_from_parts(parts)


def _joint(fields: Any) -> dict[str, Any]:
    kind = fields.get("type", "revolute") if isinstance(fields, dict) else "revolute"
    return read_keys(fields, _joint_keys(str(kind)), "a joint")


def _shape(fields: Any) -> Shape:
    keys = read_keys(fields, _SHAPE_KEYS, "a shape")
    try:
        return Shape(**keys)
    except TypeError:
        raise Error(f"a shape: expected text for kind, file and part, got {fields!r:.80}") from None


def read_keys(fields: Any, keys: dict[str, str], what: str) -> dict[str, Any]:
    """Back to the engine's keys; null is left out, and so has its default."""
    if not isinstance(fields, dict):
        raise Error(f"{what}: expected an object, got {fields!r:.60}")
    back = {name: key for key, name in keys.items()}
    unknown = [key for key in fields if key not in back]
    if unknown:
        raise Error(f"{what}: its key {unknown[0]!r} is not known; known are {', '.join(back)}")
    return {back[key]: value for key, value in fields.items() if value is not None}


def listed(parts: dict[str, Any], key: str) -> list[Any]:
    """The list under a key, or an empty one."""
    value = parts.get(key, [])
    if not isinstance(value, list):
        raise Error(f"{key}: expected a list, got {value!r:.60}")
    return value


def _refuse_constant(text: str) -> float:
    raise Error(f"the number {text} is none")
