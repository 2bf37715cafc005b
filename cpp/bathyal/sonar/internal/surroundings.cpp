// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/surroundings.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/sonar/internal/facets.hpp"

namespace bathyal::sonar {
namespace {

std::string text_of(const Vec3& point) {
  std::string text = "(";
  for (int axis = 0; axis < 3; ++axis)
    text.append(axis == 0 ? "" : ", ").append(to_text(point[axis]));
  return text.append(")");
}

}  // namespace

double checked_altitude(const WorldSnapshot& world, const Water& water, const Vec3& sonar) {
  const double surface = water.surface() ? water.surface_height(sonar.x(), sonar.y(), world.time)
                                         : std::numeric_limits<double>::infinity();
  if (sonar.z() > surface) {
    throw_argument("world_from_vehicle",
                   "the sonar below the surface at " + to_text(surface) + " m",
                   "it at " + text_of(sonar));
  }
  const Vec3 up = Vec3(0.0013, 0.0029, 1.0);  // through no pole or edge of what was built upright
  const RayHit below = world.scene.cast(sonar, -up);
  const RayHit above = world.scene.cast(sonar, up);
  const Facets facets(world.scene);
  const bool back_above = above.mesh >= 0 && facets.normal(above).dot(up) > 0.0;
  const bool front_below = below.mesh >= 0 && facets.normal(below).dot(up) > 0.0;
  if (back_above && !front_below) {
    throw_argument(
        "world_from_vehicle", "the sonar above the bottom and outside of all bodies",
        "it at " + text_of(sonar) + ", " + to_text(above.range) + " m below a surface's back");
  }
  const double altitude = world.scene.cast(sonar, -Vec3::UnitZ()).range;
  return std::isfinite(altitude) ? altitude : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace bathyal::sonar
