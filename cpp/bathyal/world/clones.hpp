// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bathyal/scene/scene.hpp"

namespace bathyal {

/// How copies of a mesh are scattered over what lies below.
struct CloneOptions {
  std::uint64_t seed = 0;
  std::optional<std::array<double, 4>> region;  ///< low x, low y, high x, high y [m]; else all
  std::array<double, 2> scale = {0.7, 1.4};     ///< drawn evenly between, above 0
  bool turned = true;                           ///< about the vertical, by any angle
  double tilt = 0.2;                            ///< at most, about a horizontal axis [rad], 0 to π
  double sunk = 0.15;  ///< part of its height, untilted, below the ground under its origin, 0 to 1
  double apart = 0.0;  ///< least distance of two of them, seen from above [m]

  void check() const;
};

/// Where a clone lies, and how large it is.
struct ClonePlace {
  Pose world_from_object = Pose::Identity();
  double scale = 1.0;
};

/// Places for `count` copies on the ground below them. Place i is drawn from a stream of its own.
/// \throw std::invalid_argument where a place is not found in 1,000 draws: no ground in the region,
///        or no room left.
std::vector<ClonePlace> clone_places(const TriangleMesh& mesh, std::int64_t count,
                                     const Scene& ground, const CloneOptions& options = {});

}  // namespace bathyal
