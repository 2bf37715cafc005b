# SPDX-License-Identifier: BSD-3-Clause
"""A side-scan's record in a few lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bathyal.sonar.navigation import Floats
from bathyal.sonar.record import SonarRecord
from bathyal.sonar.sidescan import BottomTrack


@dataclass(frozen=True)
class AltitudeFit:
    """First returns against the reported altitude, by least squares: range = slope · altitude +
    offset [m]; the correlation, and how many pings have both.
    """

    slope: float
    offset: float
    correlation: float
    pings: int

    def __str__(self) -> str:
        return (
            f"{self.slope:.3f} × reported altitude {self.offset:+.2f} m, "
            f"r = {self.correlation:.4f} in {self.pings:,} pings"
        )


def fit_altitude(first: Floats, altitude: Floats) -> AltitudeFit | None:
    """None where fewer than three pings have both, or the altitude does not change.

    Parameters
    ----------
    first, altitude : (P,) array
        [m]
    """
    known = np.isfinite(first) & np.isfinite(altitude)
    if known.sum() < 3 or np.ptp(altitude[known]) == 0.0 or np.ptp(first[known]) == 0.0:
        return None
    slope, offset = np.polyfit(altitude[known], first[known], 1)
    correlation = np.corrcoef(altitude[known], first[known])[0, 1]
    return AltitudeFit(float(slope), float(offset), float(correlation), int(known.sum()))


def _is_dated(record: SonarRecord) -> bool:
    """A simulated survey begins at 0 s, which a file writes as the first day of 1970."""
    return record.start is not None and bool(record.start > np.datetime64("1971-01-01"))


def describe_record(record: SonarRecord, bottom: BottomTrack) -> dict[str, str]:
    """Names and texts of what a person asks first.

    Parameters
    ----------
    record : SonarRecord
        Of a side-scan.
    bottom : BottomTrack
        Of that record.
    """
    nav = record.navigation
    samples = len(record.range)
    facts = {
        "pings": f"{len(record):,}, {', '.join(record.beam_names)}, {samples:,} samples each",
        "slant range": f"{record.range[-1] + record.range[0]:.2f} m",
    }
    known = record.time[np.isfinite(record.time)]
    if len(known):
        facts["time"] = f"{np.ptp(known):.1f} s" + (
            f" from {record.start} UTC" if _is_dated(record) else ", without a date"
        )
    facts["track"] = f"{record.distance()[-1]:.1f} m"
    if nav.longitude is not None and nav.latitude is not None:
        facts["latitude"] = _span(np.degrees(nav.latitude), "°", 5)
        facts["longitude"] = _span(np.degrees(nav.longitude), "°", 5)
    facts["depth"] = _span(np.asarray(nav.depth), " m", 1)
    facts["altitude"] = _span(np.asarray(nav.altitude), " m", 1)
    facts["first return"] = _span(bottom.altitude, " m", 1)
    fit = fit_altitude(bottom.altitude, np.asarray(nav.altitude))
    if fit is not None:
        facts["first return is"] = str(fit)
    return facts


def _span(values: NDArray[np.floating], unit: str, digits: int) -> str:
    known = values[np.isfinite(values)]
    if not len(known):
        return "not reported"
    return f"{known.min():.{digits}f} to {known.max():.{digits}f}{unit}"
