// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bathyal/soundings/formats/xtf.hpp"

namespace bathyal {

/// Side-scan pings of a file, in SI units and radians; NaN where it says nothing.
struct SidescanPings {
  std::vector<std::string> beam_names;  ///< "port", "starboard"
  std::int64_t samples = 0;             ///< of a row; shorter ones end in NaN
  std::vector<float> amplitude;         ///< (pings, beams, samples), near to far
  std::vector<double> slant_range;      ///< (pings, beams) [m]
  std::vector<double> time;             ///< since 1970-01-01 00:00 UTC [s]
  std::vector<double> x, y;             ///< of the sensor: east, north [m], or as `geographic` says
  bool geographic = false;              ///< x is longitude, y latitude [rad]
  std::vector<double> depth, altitude, heading, pitch, roll, speed;
  std::vector<double> sound_speed;  ///< [m/s]
  std::vector<std::int64_t> number;
  double frequency = 0.0;       ///< [Hz]
  double amplitude_step = 1.0;  ///< of a file written here: what a step of its samples means
  std::string sonar_name;

  std::size_t count() const { return time.size(); }
  std::int64_t rows() const { return static_cast<std::int64_t>(beam_names.size()); }
};

/// Port and starboard of an XTF file. The port row is stored far to near, and turned round here.
/// \throw Error for a file without side-scan channels, or whose rows would need more than 16 times
///        the file's own memory.
SidescanPings sidescan_of(const XtfFile& file);

/// An XTF file of such pings, 16 bits a sample; `amplitude_step` is found so that the largest
/// amplitude has the highest step, unless it is given (above 0). NaN is written as 0.
/// \throw std::invalid_argument for arrays that do not fit each other, or amplitudes below 0.
XtfFile xtf_of(const SidescanPings& pings);

}  // namespace bathyal
