# SPDX-License-Identifier: BSD-3-Clause
"""The sound speed of TEOS-10, by the package gsw."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bathyal._core import sound_speed_teos10_with
from bathyal.io.files import need

Floats = NDArray[np.float64]


def sound_speed(
    temperature: Floats,
    salinity: Floats,
    pressure: Floats,
    latitude: Floats,
    longitude: Floats | None,
) -> Floats:
    """(N,) [m/s] of ITS-90 temperatures [°C], practical salinities and pressures [dbar].

    Absolute salinity is that of the place [deg]; without a longitude the reference salinity.

    Raises
    ------
    Error
        Where gsw is not installed.
    """
    gsw = need("gsw", "gsw", "the sound speed of TEOS-10", extra="water")
    if longitude is None:
        absolute = gsw.SR_from_SP(salinity)
    else:
        absolute = gsw.SA_from_SP(salinity, np.maximum(pressure, 0.0), longitude, latitude)
    conservative = gsw.CT_from_t(absolute, temperature, pressure)
    return np.asarray(gsw.sound_speed(absolute, conservative, pressure), dtype=float)


sound_speed_teos10_with(sound_speed)
