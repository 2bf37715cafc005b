// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python::protocol_docs {

inline constexpr const char* kSentence = R"(A sentence of NMEA 0183, checksum and line end included.

Parameters
----------
body : str
    What lies between $ and \*.

Returns
-------
bytes

Raises
------
ValueError
    For an empty body, or one with other characters than printable ASCII without $ ! \* \\ ^ ~.)";

inline constexpr const char* kPosition =
    R"(Sentences GGA and RMC, five decimals of a minute (1.9 cm).

Parameters
----------
date : tuple of int
    Year, month, day.
time : float
    UTC, of the day [s].
latitude, longitude : float
    [deg]
altitude : float
    [m]
speed : float
    Over ground [m/s].
course : float
    From north to east [deg].
valid : bool
    False: all but the time is left out.

Returns
-------
bytes

Raises
------
ValueError
    For numbers that are no position.)";

inline constexpr const char* kVbw = R"(A sentence VBW: speeds over ground.

Parameters
----------
ahead, port : float
    [m/s]
valid : bool

Returns
-------
bytes

Raises
------
ValueError
    For numbers that are not finite.)";

inline constexpr const char* kPd6 = R"(An ensemble of a Doppler log as PD6 text.

Parameters
----------
date : tuple of int
    Year, month, day.
time : float
    UTC, of the day [s].
heading : float
    From north to east [deg].
pitch, roll : float
    Bow up, port up [deg].
depth : float
    [m]
velocity : (3,) array
    Of the vehicle over ground: ahead, to port, up [m/s].
altitude : float, optional
    [m]
age : float
    Since the last good velocity [s].
valid : bool
    Of the velocity.

Returns
-------
bytes

Raises
------
ValueError
    For numbers that do not fit.)";

inline constexpr const char* kReader = R"(Cuts a stream of bytes into sentences of NMEA 0183.

What is no sentence is skipped and counted.

Examples
--------
>>> from bathyal._core import NmeaReader, nmea_sentence
>>> reader = NmeaReader()
>>> reader.feed(nmea_sentence("HEHDT,12.00,T")[:8])
[]
>>> reader.feed(nmea_sentence("HEHDT,12.00,T")[8:])
['HEHDT,12.00,T']
>>> reader.counts["wrong_checksum"]
0)";

inline constexpr const char* kLine =
    R"(A serial line: so many bytes a second, a buffer that overruns, bits that turn.

Parameters
----------
name : str
    Keys the bit errors.
baud : float
    Bits a second; a byte takes ten.
buffer : int
    Bytes that wait at most; what finds it full is lost.
bit_error_rate : float
    Part of the bits that arrive turned.
seed : int

Raises
------
ValueError
    For numbers that no line has.)";

inline constexpr const char* kCarry = R"(What arrives, in whole lines.

Parameters
----------
given : bytes
    Sent now.
duration : float
    Since the last call [s].

Returns
-------
bytes)";

inline constexpr const char* kReadServo = R"(A packet of ArduPilot's servo outputs.

Parameters
----------
packet : bytes

Returns
-------
tuple
    Rate [Hz], number of the frame, commands of −1 to 1 of 16 or 32 channels (1 100 to 1 900 µs).

Raises
------
Error
    For other bytes.)";

inline constexpr const char* kServo =
    R"(A packet of ArduPilot's servo outputs, as the autopilot sends it.

Parameters
----------
rate : int
    [Hz]
frame : int
pulses : list of int
    16 or 32 [µs].

Returns
-------
bytes

Raises
------
ValueError
    For another number of pulses.)";

inline constexpr const char* kJson = R"(The line of JSON that ArduPilot takes from a simulator.

Parameters
----------
time : float
    [s]
gyro, force, position, attitude, velocity : (3,) array
    Rates and specific force along ahead, starboard, down; position and velocity along north, east,
    down; roll, pitch, yaw [rad, m, s].
altitude : float, optional
    [m]

Returns
-------
bytes

Raises
------
ValueError
    For numbers that are not finite.)";

}  // namespace bathyal::python::protocol_docs
