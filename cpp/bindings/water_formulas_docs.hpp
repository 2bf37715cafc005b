// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python {

inline constexpr const char* kSoundSpeedDoc = R"(Speed of sound in seawater.

The formulas are as printed, each on the temperature scale of its authors, and numbers broadcast.

Parameters
----------
temperature : float or array
    [°C]
salinity : float or array
    Practical.
depth : float or array
    Below the surface [m]; or `pressure`, one of the two.
pressure : float or array
    Above the atmosphere's [dbar]. Where a formula takes the other one, it is converted by TEOS-10
    at `latitude`, as gsw does.
latitude, longitude : float or array
    North and east [deg]. The longitude only counts for ``"teos10"``: without it absolute salinity
    is the reference salinity, which is within 0.02 g/kg of it but in the Baltic.
formula : str
    ``"mackenzie"``: Mackenzie (1981), 2 to 30 °C, salinity 25 to 40, to 8 000 m.
    ``"chen_millero"``: Chen, Millero (1977) in UNESCO 44, 0 to 40 °C, 0 to 40, to 10 000 dbar.
    ``"del_grosso"``: Del Grosso (1974), 0 to 30 °C, 30 to 40, to 9 807 dbar.
    ``"teos10"``: of gsw, which has to be installed (``pip install 'bathyal[water]'``).
temperature_scale : str, optional
    ``"ITS-90"`` or ``"IPTS-68"``: what `temperature` is on, to be converted to the formula's scale
    (T68 = 1.00024 T90). None: it is on the formula's own, IPTS-68 but for TEOS-10. The difference
    is below 0.02 m/s.

Returns
-------
float or array
    [m/s]; outside a formula's range it extrapolates, with a `RangeWarning`.

Raises
------
ValueError
    For neither or both of depth and pressure, shapes that do not broadcast, and numbers that no
    water has: NaN, a temperature not from −10 to 60 °C, a salinity not from 0 to 100.
Error
    For ``"teos10"`` without gsw.

Examples
--------
>>> import bathyal
>>> round(bathyal.sound_speed(25, 35, 1000), 3)
1550.744
>>> round(bathyal.sound_speed(40, 40, pressure=10000, formula="chen_millero"), 3)
1731.995
)";

inline constexpr const char* kAbsorptionDoc = R"(Absorption of sound in seawater.

Parameters
----------
frequency : float or array
    [Hz]
temperature : float or array
    [°C]
salinity : float or array
    Practical.
depth : float or array
    [m]
ph : float or array
    Of the water.
formula : str
    ``"francois_garrison"`` (1982), ±5 %: −2 to 22 °C, salinity 30 to 35 and to 3 500 m below
    500 kHz; 0 to 30 °C, 0 to 40 and to 10 000 m above.
    ``"ainslie_mccolm"`` (1998), within 10 % of it: 100 Hz to 1 MHz, −6 to 35 °C, 5 to 50, to
    7 000 m, pH 7.7 to 8.3.

Returns
-------
float or array
    One way, of the power in dB/km; outside a formula's range it extrapolates, with a
    `RangeWarning`.

Raises
------
ValueError
    For a frequency not above 0, numbers that no water has, shapes that do not broadcast.

Examples
--------
>>> import bathyal
>>> bathyal.absorption([100e3, 600e3, 900e3], 10, 35, 50).round(1).tolist()
[33.4, 158.6, 298.6]
)";

inline constexpr const char* kDepthFromPressureDoc = R"(Depth [m] at a pressure.

TEOS-10's formula (Roquet and others 2015), what ``gsw.z_from_p`` gives: of the standard ocean,
salinity 35 at 0 °C.

Parameters
----------
pressure : float or array
    Above the atmosphere's [dbar].
latitude : float or array
    [deg]

Returns
-------
float or array
    [m]

Examples
--------
>>> import bathyal
>>> round(bathyal.depth_from_pressure(1000.0, latitude=45), 2)
989.5
)";

inline constexpr const char* kPressureFromDepthDoc = R"(Pressure [dbar] at a depth.

The inverse of `depth_from_pressure`, to rounding.

Parameters
----------
depth : float or array
    [m]
latitude : float or array
    [deg]

Returns
-------
float or array
    Above the atmosphere's [dbar].
)";

inline constexpr const char* kSeawaterDensityDoc = R"(Density of seawater by EOS-80.

UNESCO (1981), fitted to −2 to 40 °C, salinity 0 to 42 and 10 000 dbar; the standard error is
0.009 kg/m³.

Parameters
----------
temperature : float or array
    On ITS-90 [°C].
salinity : float or array
    Practical.
pressure : float or array
    Above the atmosphere's [dbar].

Returns
-------
float or array
    [kg/m³]
)";

inline constexpr const char* kAmbientNoiseDoc = R"(Noise of the sea, by the curves of Wenz (1962).

The sum of turbulence, ships, wind and, above some 100 kHz, the motion of molecules, by the formulas
of Coates (1990).

Parameters
----------
frequency : float or array
    1 Hz to 10 MHz [Hz].
wind_speed : float or array
    At 10 m, 0 to 50 [m/s].
shipping : float or array
    From 0 (none near) to 1 (heavy).

Returns
-------
float or array
    Spectral level [dB re 1 µPa²/Hz].

Examples
--------
>>> import bathyal
>>> bathyal.ambient_noise([1e3, 100e3, 600e3]).round(1).tolist()
[61.0, 28.9, 40.6]
)";

inline constexpr const char* kPracticalSalinityDoc =
    R"(Practical salinity from conductivity, PSS-78.

Parameters
----------
conductivity : float or array
    [S/m]; 0 or less, as of air, gives 0, and NaN stays NaN.
temperature : float or array
    On ITS-90 [°C].
pressure : float or array
    Above the atmosphere's [dbar].

Returns
-------
float or array
    Practical salinity. It was fitted to salinities of 2 to 42.

Examples
--------
>>> import bathyal
>>> round(bathyal.practical_salinity(4.2914, 14.9964, 0.0), 4)
35.0
)";

}  // namespace bathyal::python
