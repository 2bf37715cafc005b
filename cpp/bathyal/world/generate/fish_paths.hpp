// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "bathyal/geometry/trajectory.hpp"
#include "bathyal/scene/scene.hpp"
#include "bathyal/world/generate/seabed.hpp"

namespace bathyal {

struct FishPathOptions {
  std::uint64_t seed = 0;

  /// Corners of the place in which they swim [m], seen from above; else the scene's box.
  std::optional<std::array<Vec2, 2>> region;
  double clearance = 0.5;  ///< no path comes nearer to the scene [m], above 0
  double altitude = 4.0;   ///< up to so much higher than that they swim [m], 0 or more
  double ceiling = std::numeric_limits<double>::infinity();  ///< z below which they stay [m]
  double speed = 0.6;                                        ///< horizontal [m/s], above 0
  double turn_rate = 0.4;  ///< typical rate at which they change course [rad/s], above 0
  double step = 0.25;      ///< between two poses [s], above 0
  int num_threads = 0;     ///< 0: all

  void check() const;
};

/// Random smooth paths over a terrain, world_from_fish: x ahead, back up. Each path, straight
/// between its poses as a Trajectory is, is checked against the scene. The same bytes for any
/// number of threads; more fish leave the first ones' paths alone. \throw std::invalid_argument,
/// also where no path was found: a region too small to turn in, a ceiling too low for the
/// clearance.
std::vector<Trajectory> fish_paths(const Scene& scene, int count, double duration,
                                   const FishPathOptions& options = {});

}  // namespace bathyal
