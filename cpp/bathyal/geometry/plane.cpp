// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/plane.hpp"

#include "bathyal/base/check.hpp"

namespace bathyal {

Plane::Plane(const Vec3& normal, double offset) {
  const double length = normal.stableNorm();
  check_positive("normal", length);
  check_finite("offset", offset);
  normal_ = normal / length;
  offset_ = offset / length;
}

Plane Plane::through(const Vec3& point, const Vec3& normal) {
  const double length = normal.stableNorm();
  check_positive("normal", length);
  const Vec3 unit = normal / length;
  return {unit, unit.dot(point)};
}

}  // namespace bathyal
