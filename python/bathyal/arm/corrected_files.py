# SPDX-License-Identifier: BSD-3-Clause
"""Corrected arms in files: the JSON of an arm with its effects and what taught them."""

from __future__ import annotations

from typing import Any

import numpy as np

from bathyal import effects
from bathyal._core import CorrectedArm, Error, FoundEffect, Support
from bathyal.arm.json import arm_fields, listed, read_keys, rigid_arm, write_json
from bathyal.io.files import PathLike, known_suffix

KEYS = ("effects", "support")

_EFFECT_KEYS = {key: key for key in ("name", "joint", "cause", "settings", "parameters")}
_PARAMETER_KEYS = {key: key for key in ("name", "unit", "scale", "value")}
_RANGE_KEYS = {"low": "low", "high": "high"}
_SUPPORT_KEYS = {
    "joints": "joints",
    "gaps": "gaps",
    "gravity": "gravity_m_s2",
    "covariates": "covariates",
    "sessions": "sessions",
}


def save_corrected_arm(model: CorrectedArm, path: PathLike) -> None:
    """Write all of a corrected arm; what `CorrectedArm.save` and `.write` do.

    Parameters
    ----------
    model : CorrectedArm
    path : path
        ``.json``: what `Arm.save` writes of the rigid part, the effects with settings and values,
        and the support, to the last digit. The file appears whole or not at all. An effect of your
        own is stored by its name: `bathyal.effects.register` it before the file is read.

    Raises
    ------
    ValueError
        For another suffix.
    OSError
        Where the file cannot be written.
    """
    known_suffix(path, (".json",), "JSON")
    fields = arm_fields(model.arm)
    fields["effects"] = [_effect_fields(found) for found in model.effects]
    fields["support"] = _support_fields(model.support)
    write_json(fields, path)


def corrected_arm(fields: dict[str, Any]) -> CorrectedArm:
    """The corrected arm of such a file's contents."""
    arm = rigid_arm({key: value for key, value in fields.items() if key not in KEYS})
    found = [_effect(one) for one in listed(fields, "effects")]
    return CorrectedArm(arm, found, _support(fields.get("support")))


def _effect_fields(found: FoundEffect) -> dict[str, Any]:
    parameters = [
        {"name": name, "unit": found.units[name], "scale": found.scales[name], "value": value}
        for name, value in found.parameters.items()
    ]
    return {
        "name": found.name,
        "joint": found.joint,
        "cause": found.cause,
        "settings": found.settings,
        "parameters": parameters,
    }


def _range_fields(numbers: Any) -> dict[str, Any]:
    low, high = np.asarray(numbers).tolist()
    return {"low": low, "high": high}


def _support_fields(support: Support) -> dict[str, Any]:
    return {
        "joints": _range_fields(support.joints),
        "gaps": [gaps.tolist() for gaps in support.gaps],
        "gravity_m_s2": _range_fields(support.gravity),
        "covariates": {name: _range_fields(r) for name, r in support.covariates.items()},
        "sessions": support.sessions.tolist(),
    }


def _effect(fields: Any) -> FoundEffect:
    parts = read_keys(fields, _EFFECT_KEYS, "an effect")
    name = parts.get("name")
    if not isinstance(name, str):
        raise Error(f"an effect: expected a name, got {name!r:.60}")
    if name not in {effect.name for effect in effects.list()}:
        raise Error(
            f"its effect {name!r} is not known: give it to bathyal.effects.register before the "
            "file is read, where it is one of your own"
        )
    numbers = [read_keys(p, _PARAMETER_KEYS, "a parameter") for p in listed(parts, "parameters")]
    return FoundEffect(
        name,
        {p["name"]: p["value"] for p in numbers},
        joint=parts.get("joint"),
        settings=parts.get("settings", {}),
        units={p["name"]: p["unit"] for p in numbers},
        scales={p["name"]: p["scale"] for p in numbers},
        cause=parts.get("cause", ""),
    )


def _range(fields: Any, what: str) -> Any:
    parts = read_keys(fields, _RANGE_KEYS, what)
    return [parts["low"], parts["high"]]


def _support(fields: Any) -> Support:
    parts = read_keys(fields, _SUPPORT_KEYS, "support")
    covariates = parts.get("covariates", {})
    if not isinstance(covariates, dict):
        raise Error(f"covariates: expected an object, got {covariates!r:.60}")
    return Support(
        _range(parts["joints"], "joints"),
        gaps=listed(parts, "gaps") if "gaps" in parts else (),
        gravity=_range(parts["gravity"], "gravity"),
        covariates={name: _range(range, name) for name, range in covariates.items()},
        sessions=[float(session) for session in listed(parts, "sessions")],
    )
