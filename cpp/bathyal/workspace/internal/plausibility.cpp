// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "bathyal/base/text.hpp"
#include "bathyal/workspace/internal/bodies.hpp"

namespace bathyal::workspace {
namespace {

constexpr double kFarApart = 100.0;  // sizes that differ by more are not of one machine

void check_hull(const Bodies& bodies, const Obstacle& hull, std::vector<std::string>& warnings) {
  const double reach = chain_length(bodies.arm);
  const double size = hull.box().diagonal().norm();
  const Vec3 base = bodies.arm.base().translation();
  const double away = hull.box().exteriorDistance(base);
  const std::string arm = "the arm " + three_digits(reach) + " m";
  if (size > kFarApart * reach) {
    warnings.push_back("the hull is " + three_digits(size) + " m large, " + arm +
                       ": are its millimetres taken for metres?");
  } else if (reach > kFarApart * size) {
    warnings.push_back("the hull is " + three_digits(size) + " m large, " + arm +
                       ": is its scale right?");
  }
  if (away > kFarApart * reach) {
    warnings.push_back("the hull is " + three_digits(away) +
                       " m away from the arm's base: is it in the vehicle's frame?");
  }
  if (hull.nearest(Capsule{base, base, 0.0}).distance < -reach) {
    warnings.push_back("the hull holds the whole arm: no posture will be free");
  }
}

}  // namespace

std::vector<std::string> plausibility(const Bodies& bodies) {
  std::vector<std::string> warnings;
  const Vec3 base = bodies.arm.base().translation();
  for (const Obstacle& obstacle : bodies.obstacles) {
    if (obstacle.is_hull()) check_hull(bodies, obstacle, warnings);
    if (obstacle.is_keepout() && obstacle.frame() == kVehicleFrame && !obstacle.motion().moves()) {
      const Vec3 own = obstacle.motion().at(0.0).inverse() * base;
      if (obstacle.nearest({own, own, 0.0}).distance < 0.0) {
        warnings.push_back("keep-out " + obstacle.name() +
                           " holds the arm's base: no posture will be free");
      }
    }
  }
  return warnings;
}

}  // namespace bathyal::workspace
