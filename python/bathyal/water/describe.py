# SPDX-License-Identifier: BSD-3-Clause
"""What a cast holds, in numbers for programs and in text for people."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime, timezone
from typing import Any

import numpy as np

from bathyal._core import Profile

_COLUMNS = (
    ("depth", "m"),
    ("temperature", "°C"),
    ("salinity", ""),
    ("sound_speed", "m/s"),
    ("pressure", "dbar"),
)


@contextmanager
def noting_ranges(lines: list[str]) -> Iterator[None]:
    """Python's warnings become lines."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    lines += [str(warning.message) for warning in caught]


def with_speed(profile: Profile) -> Profile:
    """The cast itself, or with its sound speed computed where it has none and can have one."""
    known = profile.temperature is not None and profile.salinity is not None
    return profile.with_sound_speed() if profile.sound_speed is None and known else profile


def describe(profile: Profile) -> tuple[dict[str, Any], dict[str, str]]:
    """Place, time, rows and ranges: as data with units in the names, and as rows of text."""
    cast = with_speed(profile)
    computed = cast is not profile
    usable = len(cast.cleaned())
    data: dict[str, Any] = {
        "kind": "cast", "rows": len(cast), "rows_on_the_way_down": usable,
        "instrument": cast.instrument, "source": cast.source, "position_deg": cast.position,
        "time": _time_text(cast.time), "sound_speed_computed": computed, "ranges": {},
    }  # fmt: skip
    rows = {"instrument": cast.instrument or "not said", "source": cast.source}
    if cast.position is not None:
        rows["position"] = f"{cast.position[0]:.5f}°, {cast.position[1]:.5f}°"
    if cast.time is not None:
        rows["time"] = _time_text(cast.time) or ""
    rows["rows"] = f"{len(cast):,}, on the way down {usable:,}"
    for name, unit in _COLUMNS:
        values = getattr(cast, name)
        if values is None or not np.isfinite(values).any():
            continue
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        data["ranges"][name] = [low, high]
        note = " (computed)" if computed and name == "sound_speed" else ""
        rows[name.replace("_", " ") + note] = f"{low:.6g} to {high:.6g} {unit}".rstrip()
    return data, rows


def rows_of(profile: Profile) -> tuple[list[str], list[list[float]]]:
    """Titles and rows of the way down, as `read_profile` reads them."""
    cast = with_speed(profile).cleaned()
    columns = [(name, unit, getattr(cast, name)) for name, unit in _COLUMNS]
    kept = [(name, unit, values) for name, unit, values in columns if values is not None]
    titles = [f"{name} [{unit}]" if unit else name for name, unit, _ in kept]
    return titles, np.column_stack([values for _, _, values in kept]).tolist()


def _time_text(time: float | None) -> str | None:
    if time is None:
        return None
    return datetime.fromtimestamp(time, timezone.utc).strftime("%Y-%m-%d %H:%M:%S UTC")
