// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/water.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bathyal/water/internal/rising.hpp"
#include "bathyal/water/seawater.hpp"

namespace bathyal {
namespace {

/// Every column that a Water reads.
void fill_columns(WaterProfile& profile, const WaterOptions& options) {
  const bool computable = !profile.temperature.empty() && !profile.salinity.empty();
  if (profile.sound_speed.empty()) {
    if (!computable) {
      throw_argument("profile", "its sound speed, or temperature and salinity to compute it from",
                     profile.temperature.empty() ? "no temperature" : "no salinity");
    }
    profile.sound_speed = profile_sound_speed(profile, options.formula, options.latitude);
  }
  const std::size_t rows = profile.depth.size();
  if (profile.temperature.empty()) profile.temperature.assign(rows, options.temperature);
  if (profile.salinity.empty()) profile.salinity.assign(rows, options.salinity);
}

double uniform_sound_speed(const WaterOptions& options) {
  if (options.sound_speed) return *options.sound_speed;
  return sound_speed(options.formula, options.temperature, options.salinity,
                     {.depth = options.reference_depth,
                      .pressure = pressure_from_depth(options.reference_depth, options.latitude)});
}

/// How far crests and tide may rise above the mean surface [m].
double highest_surface(const WaterOptions& options) {
  double height = options.tide.highest();
  for (const WaveComponent& c : options.waves.components()) height += c.amplitude;
  return height;
}

}  // namespace

void WaterOptions::check() const {
  if (surface) check_finite("surface", *surface);
  check_range("reference_depth", reference_depth, 0.0, 12000.0);
  check_seawater(temperature, salinity);
  if (sound_speed) check_range("sound_speed", *sound_speed, 1300.0, 1800.0);
  check_range("ph", ph, 6.0, 10.0);
  if (!(std::abs(latitude) <= 0.5 * std::numbers::pi)) {
    throw_argument("latitude", "from −90° to 90°", to_text(latitude) + " rad");
  }
  for (const WaterProfile& profile : profiles) profile.check();
  check_rising("time", time);
  if (profiles.size() != time.size() && (profiles.size() > 1 || time.size() > 1)) {
    throw_argument("time",
                   "a time for each of " + counted(static_cast<long>(profiles.size()), "profile"),
                   std::to_string(time.size()));
  }
  if (!surface && !waves.flat()) throw_argument("waves", "a surface= for them", "none");
  if (!surface && !tide.none()) throw_argument("tide", "a surface= for it", "none");
}

Water::Water(WaterOptions options) : options_(std::move(options)) {
  options_.check();
  for (WaterProfile& profile : options_.profiles) fill_columns(profile, options_);
  uniform_speed_ = uniform_sound_speed(options_);
  highest_ = highest_surface(options_);
}

double Water::depth(double z) const {
  if (!options_.surface) return options_.reference_depth;
  if (!(z <= *options_.surface + highest_)) {
    throw_argument(
        "z", "a height at or below the surface at " + to_text(*options_.surface + highest_) + " m",
        to_text(z) + " m");
  }
  return std::max(*options_.surface - z, 0.0);
}

double Water::at(std::vector<double> WaterProfile::*column, double uniform, double depth,
                 double time) const {
  if (options_.profiles.empty()) return uniform;
  const auto value = [&](std::size_t i) {
    const WaterProfile& profile = options_.profiles[i];
    return column_at(profile, profile.*column, depth);
  };
  if (options_.profiles.size() == 1) return value(0);
  const Interval in = interval_of(options_.time, time);
  const double low = value(in.low);
  return in.high == in.low ? low : low + in.share * (value(in.high) - low);
}

double Water::sound_speed(double z, double time) const {
  return at(&WaterProfile::sound_speed, uniform_speed_, depth(z), time);
}

double Water::temperature(double z, double time) const {
  return at(&WaterProfile::temperature, options_.temperature, depth(z), time);
}

double Water::salinity(double z, double time) const {
  return at(&WaterProfile::salinity, options_.salinity, depth(z), time);
}

double Water::pressure(double z) const { return pressure_from_depth(depth(z), options_.latitude); }

double Water::density(double z, double time) const {
  return seawater_density(temperature(z, time), salinity(z, time), pressure(z));
}

double Water::absorption(double frequency, double z, double time, AbsorptionFormula formula) const {
  const AbsorptionPlace place{.temperature = temperature(z, time),
                              .salinity = salinity(z, time),
                              .depth = depth(z),
                              .ph = options_.ph};
  check_absorption(frequency, place);
  return bathyal::absorption(formula, frequency, place);
}

SpeedProfile Water::speed_profile(double time) const {
  if (!varies())
    return SpeedProfile(
        at(&WaterProfile::sound_speed, uniform_speed_, options_.reference_depth, time));
  std::vector<double> depth;
  for (const WaterProfile& profile : options_.profiles) {
    depth.insert(depth.end(), profile.depth.begin(), profile.depth.end());
  }
  std::sort(depth.begin(), depth.end());
  depth.erase(std::unique(depth.begin(), depth.end()), depth.end());
  std::vector<double> speed;
  for (const double d : depth) {
    speed.push_back(at(&WaterProfile::sound_speed, uniform_speed_, d, time));
  }
  return {std::move(depth), std::move(speed)};
}

double Water::deepest() const {
  double deepest = std::numeric_limits<double>::infinity();
  for (const WaterProfile& profile : options_.profiles) {
    deepest = std::min(deepest, profile.depth.back());
  }
  return varies() ? deepest : std::numeric_limits<double>::infinity();
}

bool Water::covers(double depth) const { return depth <= deepest(); }

double Water::surface_height(double x, double y, double time) const {
  if (!options_.surface) throw_argument("surface", "water with a surface", "none within reach");
  return *options_.surface + options_.tide.height(time) + options_.waves.elevation(x, y, time);
}

Vec3 Water::current(const Vec3& point, double time) const {
  const Eigen::Vector2d flow = options_.current.at(depth(point.z()), time);
  return {flow.x(), flow.y(), 0.0};
}

Waves::Motion Water::motion(const Vec3& point, double time) const {
  Waves::Motion motion;
  if (!options_.surface) {
    motion.velocity = current(point, time);
    return motion;
  }
  if (!(point.z() <= surface_height(point.x(), point.y(), time))) return motion;
  const double mean = *options_.surface + options_.tide.height(time);
  motion = options_.waves.motion({point.x(), point.y(), point.z() - mean}, time);
  motion.velocity += current(point, time);
  return motion;
}

}  // namespace bathyal
