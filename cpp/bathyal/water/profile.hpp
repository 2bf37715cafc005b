// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bathyal/water/sound_speed.hpp"

namespace bathyal {

/// A cast: properties of the water by depth. As read from a file its rows are in the order of the
/// file, the way down and the way up, and NaN where the instrument gave nothing; a `Water` takes
/// what `clean_profile` makes of it. A column that was not measured is empty.
struct WaterProfile {
  std::vector<double> depth;        ///< below the surface [m]
  std::vector<double> temperature;  ///< [°C]
  std::vector<double> salinity;     ///< practical
  std::vector<double> sound_speed;  ///< [m/s]
  std::vector<double> pressure;     ///< above the atmosphere's [dbar]

  std::optional<double> latitude;   ///< north [rad]
  std::optional<double> longitude;  ///< east [rad]
  std::optional<double> time;       ///< since 1970-01-01 UTC [s]
  std::string instrument;           ///< as the file names it
  std::string source;               ///< the file, and what was derived of it

  /// Columns that are as long as `depth` or empty, infinite numbers nowhere.
  /// \throw std::invalid_argument
  void check_columns() const;

  /// What a Water needs: at least two rows, depths finite, 0 or more and rising, all other columns
  /// within what water can be. \throw std::invalid_argument that names the row.
  void check() const;
};

struct CleanProfileOptions {
  double step = 0.0;  ///< mean of the rows in each layer of this thickness [m]; 0 keeps each row

  void check() const;
};

/// The way down, fit for a Water: rows with a number missing and those above the surface are left
/// out, and those not deeper than one before (the way up, waves at the start; rows of equal depth
/// become their mean). A column without any number is left out.
/// \throw std::invalid_argument where fewer than two rows remain.
WaterProfile clean_profile(const WaterProfile& profile, const CleanProfileOptions& options = {});

/// Sound speed of each row by a formula; of depth or, by the latitude, pressure. The temperature is
/// taken as the formula takes it. \throw std::invalid_argument without temperature or salinity.
std::vector<double> profile_sound_speed(const WaterProfile& profile, SoundSpeedFormula formula,
                                        double latitude);

/// A column at a depth, linear between rows, at the ends as there.
double column_at(const WaterProfile& profile, const std::vector<double>& column, double depth);

}  // namespace bathyal
