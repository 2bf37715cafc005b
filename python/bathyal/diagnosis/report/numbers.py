# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of a diagnosis as people read them: mm, degrees, per cent, and no more figures than
an interval warrants."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from bathyal.view.text import number

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

# Units as they are kept, and as they are shown: the unit, and how many of it make one.
_SHOWN = {
    "m": ("mm", 1e3),
    "rad": ("°", math.degrees(1.0)),
    "s": ("ms", 1e3),
    "m/s": ("mm/h", 3.6e6),
    "rad/s": ("°/h", 3600 * math.degrees(1.0)),
    "m/m": ("mm/m", 1e3),
    "1/K": ("µm/(m K)", 1e6),
    "m/N": ("mm/kN", 1e6),
    "rad/(N m)": ("°/(kN m)", 1e3 * math.degrees(1.0)),
    "1/(N m²)": ("1/(MN m²)", 1e6),
    "kg rad/(N m)": ("kg °/(kN m)", 1e3 * math.degrees(1.0)),
}
_SHARES = ("scale", "ratio")  # plain numbers that are shown in per cent
_FEWEST_P = 1e-3  # smaller ones are shown as p < this
_MOST_DIGITS = 12
_NAMES = {"cos": "cosine", "sin": "sine"}


def length_text(metres: float) -> str:
    """ "0.312 mm", "0.031 mm": to a micrometre or three figures, in the unit that suits."""
    size = abs(metres)
    if not math.isfinite(size):
        return "?"
    if size < 1e-9:
        return "0 mm" if size == 0 else "under 1 nm"
    if 1e-5 <= size < 1e-4:
        return f"{number(1e3 * metres, 3)} mm"
    unit, factor = ("m", 1.0) if size >= 1 else ("mm", 1e3) if size >= 1e-5 else ("µm", 1e6)
    return f"{figures(factor * metres)} {unit}"


def share_text(share: float) -> str:
    """ "97 %" of something; "−3 %" where it grew."""
    if not math.isfinite(share):
        return "?"
    digits = 0 if abs(share) >= 0.1 or share == 0 else 1
    return f"{number(100 * share, digits)} %"


def gained_share_text(report: Diagnosis, gain: float) -> str:
    """ "97 % of the variance above noise", where repeats measure the noise; where the floor is what
    the model itself leaves, the share of the whole variance."""
    if report.noise_is_measured:
        return f"{share_text(gain)} of the variance above noise"
    held = report.held_out
    whole = held.rms_before**2
    above = whole - held.noise**2
    return f"{share_text(gain * above / whole if whole > 0 else gain)} of the held-out variance"


def chance_text(p: float) -> str:
    """ "p = 0.03", "p < 0.001"."""
    if not math.isfinite(p):
        return "p not known"
    return f"p < {_FEWEST_P}" if p < _FEWEST_P else f"p = {p:.2g}"


def odds_text(odds: float) -> str:
    """What the odds of an alternative come to: "12 to 1 against it"."""
    if not math.isfinite(odds):
        return "odds not known"
    if odds >= 0.67:
        return "as likely"
    if odds < 1e-3:
        return "more than 1,000 to 1 against it"
    return f"{1 / odds:.{0 if odds < 0.2 else 1}f} to 1 against it"


def is_setting(estimate: Any) -> bool:
    """Whether a parameter is a setting, which selects a form of an effect: it has no unit
    and no interval."""
    return not estimate.unit


def parameter_name(name: str) -> str:
    """ "shift x 2" of shift_x_2."""
    parts = name.split("_")
    return " ".join([_NAMES.get(parts[0], parts[0]), *parts[1:]])


def setting_text(name: str, value: float) -> str:
    """ "order 2", "by joint 4", "after 120 rows"; empty for those that are of no use to people."""
    if name == "by":
        return f"by joint {value + 1:.0f}"
    if name == "moment":
        return f"after {value:.0f} rows"
    if name == "time":
        return f"at {value:.6g} s"
    if name == "from":
        return f"from session {value:.0f} on"
    return f"{name} {value:.4g}" if name in ("order", "terms") else ""


def shown_unit(name: str, unit: str) -> tuple[str, float]:
    """The unit that a parameter is shown in, and how many of it make one of its own."""
    if unit in _SHOWN:
        return _SHOWN[unit]
    if unit == "1" and name.split("_")[0] in _SHARES:
        return "%", 100.0
    return ("" if unit == "1" else unit), 1.0


def estimate_text(name: str, estimate: Any) -> str:
    """ "0.0275° (0.0269 … 0.0281)": an estimate and its 95 % interval, to two figures of it."""
    unit, factor = shown_unit(name, estimate.unit)
    low, high = (factor * float(end) for end in estimate.interval)
    value = factor * float(estimate.value)
    half = (high - low) / 2
    if not math.isfinite(value):
        return "?"
    if not math.isfinite(half):
        return f"{figures(value)}{spaced(unit)} (nothing bounds it)"
    if half <= 0:
        return f"{figures(value)}{spaced(unit)}"
    digits = 1 - math.floor(math.log10(half))
    if digits > _MOST_DIGITS:
        return f"{value:.3g}{spaced(unit)}".replace("-", "−")
    value, low, high = (round(x, digits) for x in (value, low, high))
    texts = [number(x, max(digits, 0)) for x in (value, low, high)]
    return f"{texts[0]}{spaced(unit)} ({texts[1]} … {texts[2]})"


def spaced(unit: str) -> str:
    """A unit as it is written behind its number."""
    return unit if unit in ("°", "") else f" {unit}"


def figures(value: float) -> str:
    """Three of them, with a true minus, and powers of ten where there would be a row of zeros."""
    if value != 0 and not 1e-3 <= abs(value) < 1e6:
        return f"{value:.2e}".replace("-", "−")
    if abs(value) >= 100 or value == 0:
        return number(value, 0)
    return f"{value:#.3g}".replace("-", "−")
