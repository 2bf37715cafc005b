// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "bathyal/geometry/pose.hpp"
#include "bathyal/water/absorption.hpp"
#include "bathyal/water/current.hpp"
#include "bathyal/water/profile.hpp"
#include "bathyal/water/speed_profile.hpp"
#include "bathyal/water/tide.hpp"
#include "bathyal/water/waves.hpp"

namespace bathyal {

struct WaterOptions {
  std::optional<double> surface = {};  ///< z of the mean sea surface [m]; unset: out of reach
  double reference_depth = 50.0;       ///< of the whole water where there is no surface [m]

  /// Casts; several need `time`. A column that a cast has not is taken from the numbers below, its
  /// sound speed from the formula, where it has temperature and salinity.
  std::vector<WaterProfile> profiles = {};
  std::vector<double> time =
      {};  ///< of each profile, rising [s]; linear between, at the ends as there

  double temperature = 10.0;  ///< [°C]
  double salinity = 35.0;     ///< practical
  std::optional<double> sound_speed =
      {};  ///< of water without a profile [m/s]; unset: by the formula
  SoundSpeedFormula formula = SoundSpeedFormula::kMackenzie;
  double ph = 8.0;
  double latitude = 0.7853981633974483;  ///< for depth and pressure [rad]; 45° N

  Current current = {};
  Waves waves = {};  ///< need a surface
  Tide tide = {};    ///< needs a surface

  /// \throw std::invalid_argument
  void check() const;
};

/// The water of a world: one place that sonars and vehicles read. Depth counts from the mean
/// surface: a profile moves with neither tide nor waves.
class Water {
 public:
  /// The same everywhere, without a surface.
  Water() : Water(WaterOptions{}) {}
  explicit Water(WaterOptions options);

  /// z of the mean sea surface [m]; without one it is out of reach, and the water is the same
  /// everywhere, as it is at reference_depth().
  std::optional<double> surface() const { return options_.surface; }
  double reference_depth() const { return options_.reference_depth; }  ///< [m]
  const WaterOptions& options() const { return options_; }  ///< profiles with every column filled

  /// Depth below the mean surface [m] at a height; reference_depth() without a surface. Between the
  /// mean and the actual surface it is 0.
  /// \throw std::invalid_argument above the actual highest surface (tide and crests).
  double depth(double z) const;

  double sound_speed(double z, double time = 0.0) const;  ///< [m/s] at a height
  double temperature(double z, double time = 0.0) const;  ///< [°C]
  double salinity(double z, double time = 0.0) const;     ///< practical
  double pressure(double z) const;                        ///< above the atmosphere's [dbar]
  double density(double z, double time = 0.0) const;      ///< [kg/m³], EOS-80
  double absorption(double frequency, double z, double time = 0.0,
                    AbsorptionFormula formula = AbsorptionFormula::kFrancoisGarrison) const;

  /// By depth, for the path of sound. One row without a surface or a profile: paths are straight.
  SpeedProfile speed_profile(double time = 0.0) const;

  /// Whether the profiles reach down to a depth; uniform water does everywhere. Below its last row
  /// a profile goes on as there: what needs to know the water asks, and refuses or warns.
  bool covers(double depth) const;
  double deepest() const;  ///< the depth down to which it is known [m]; infinite for uniform water

  bool varies() const { return options_.surface && !options_.profiles.empty(); }  ///< by depth

  /// Of the sea surface [m]: mean, tide and waves. \throw std::invalid_argument without a surface.
  double surface_height(double x, double y, double time) const;

  /// Horizontal current [m/s] at a point of the world, waves apart.
  Vec3 current(const Vec3& point, double time = 0.0) const;

  /// How the water moves: current, orbits of the waves, the tide's rise apart; 0 above the surface.
  Waves::Motion motion(const Vec3& point, double time = 0.0) const;

 private:
  double at(std::vector<double> WaterProfile::*column, double uniform, double depth,
            double time) const;

  WaterOptions options_;
  double uniform_speed_ = 0.0;
  double highest_ = 0.0;  ///< that the surface may rise above its mean [m]
};

}  // namespace bathyal
