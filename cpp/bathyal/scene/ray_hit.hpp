// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

namespace bathyal {

/// What a ray met first. `triangle` is −1 and `range` infinite where it met nothing.
struct RayHit {
  double range = std::numeric_limits<double>::infinity();  ///< along the unit direction [m]
  std::int32_t mesh = -1;                                  ///< which mesh of the scene
  std::int32_t triangle = -1;                              ///< which triangle of that mesh
  double u = 0.0;  ///< barycentric weight of corner 1 (eq 4); that of corner 0 is 1 − u − v
  double v = 0.0;  ///< barycentric weight of corner 2
};

}  // namespace bathyal
