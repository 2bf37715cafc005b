// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// An ensemble of a Doppler velocity log as Teledyne RDI's PD6 text gives it. The vehicle's axes:
/// x ahead, y to port, z up.
struct Pd6Ensemble {
  double heading = 0.0;                 ///< from north to east [deg]
  double pitch = 0.0, roll = 0.0;       ///< bow up, port up [deg]
  double time = 0.0;                    ///< UTC, of the day [s]
  int day = 1, month = 1, year = 2000;  ///< of the date
  double sound_speed = 1500.0;          ///< [m/s]
  double depth = 0.0;                   ///< of the transducer [m]
  Vec3 velocity = Vec3::Zero();         ///< over ground, of the vehicle, in it [m/s]
  std::optional<double> altitude = {};  ///< [m]
  double age = 0.0;                     ///< since the last good velocity [s]
  bool valid = true;                    ///< of the velocity
};

/// Lines :SA, :TS, :BS and :BD; velocities in whole mm/s, up to 99.999 m/s.
/// \throw std::invalid_argument for numbers that are not finite or do not fit
std::string pd6_text(const Pd6Ensemble& ensemble);

/// Reads an ensemble line by line: each changes what it tells of. Lines of other kinds are skipped.
/// \return whether the line was one of the four
/// \throw Error for a line of one of the four kinds whose fields are none
bool read_pd6_line(std::string_view line, Pd6Ensemble& ensemble);

}  // namespace bathyal
