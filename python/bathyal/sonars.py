# SPDX-License-Identifier: BSD-3-Clause
"""Sonars by class, with values as their data sheets give them.

`physics="off"` leaves geometry and Lambert's law; `physics="real"` turns every effect on.
`Sonar.replace` changes any of it.
"""

from bathyal._core import Sonar

__all__ = [
    "echo_sounder",
    "imaging",
    "multibeam",
    "paper_forward_sounders",
    "paper_side_scan",
    "scanning",
    "side_scan",
    "side_scan_100khz",
]


def side_scan(*, physics: str = "off") -> Sonar:
    """Port and starboard, 600 kHz, 75 m, from straight down to the horizon."""
    return Sonar.preset("side_scan", physics)


def side_scan_100khz(*, physics: str = "off") -> Sonar:
    """Port and starboard, 100 kHz, 200 m: for small things far away."""
    return Sonar.preset("side_scan_100khz", physics)


def paper_side_scan(*, physics: str = "off") -> Sonar:
    """The model of Bobkov and others (2014): ideal cameras of 45° × 0.6° that look from the
    horizontal to 45° down, 100 × 8,000 pixels a side, to 120 m. A sample is the sum of K_d cos θ
    over the pixels whose range falls in it."""
    return Sonar.preset("paper_side_scan", physics)


def multibeam(*, physics: str = "off") -> Sonar:
    """256 beams of 1° × 1° over 120°, straight down, 400 kHz."""
    return Sonar.preset("multibeam", physics)


def echo_sounder(*, physics: str = "off") -> Sonar:
    """One round beam of 10°, straight down, 200 kHz."""
    return Sonar.preset("echo_sounder", physics)


def paper_forward_sounders(*, physics: str = "off") -> Sonar:
    """Five echo sounders that look ahead, from 60° down to 30° up (Bobkov and others 2014)."""
    return Sonar.preset("paper_forward_sounders", physics)


def imaging(*, physics: str = "off") -> Sonar:
    """Forward looking, 900 kHz: 512 beams over 130°, 20° high, 30 m."""
    return Sonar.preset("imaging", physics)


def scanning(*, physics: str = "off") -> Sonar:
    """A mechanically scanning head, 675 kHz: 1.8° × 30°, 0.9° from ping to ping, 50 m."""
    return Sonar.preset("scanning", physics)
