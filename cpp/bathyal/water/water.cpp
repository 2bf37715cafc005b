// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/water.hpp"

#include <algorithm>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

double value_at(const WaterProfile& profile, const std::vector<double>& values, double depth) {
  const auto above = std::upper_bound(profile.depth.begin(), profile.depth.end(), depth);
  if (above == profile.depth.begin()) return values.front();
  if (above == profile.depth.end()) return values.back();
  const auto row = static_cast<std::size_t>(above - profile.depth.begin());
  const double part =
      (depth - profile.depth[row - 1]) / (profile.depth[row] - profile.depth[row - 1]);
  return values[row - 1] + part * (values[row] - values[row - 1]);
}

}  // namespace

double Water::depth(double z) const {
  if (!surface_) return reference_depth_;
  if (!(z <= *surface_)) {
    throw_argument("z", "a height at or below the surface at " + to_text(*surface_) + " m",
                   to_text(z) + " m");
  }
  return *surface_ - z;
}

double Water::sound_speed(double z) const {
  return value_at(profile_, profile_.sound_speed, depth(z));
}

double Water::temperature(double z) const {
  return value_at(profile_, profile_.temperature, depth(z));
}

double Water::salinity(double z) const { return value_at(profile_, profile_.salinity, depth(z)); }

}  // namespace bathyal
