// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/plane.hpp"

#include <cmath>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

/// A normal this short is scaled first: its length may have as few digits as a denormal number.
constexpr double kShort = 1e-250;
constexpr double kLengthen = 0x1p600;  ///< exact

}  // namespace

Plane::Plane(const Vec3& normal, double offset) {
  const double length = normal.stableNorm();
  check_positive("normal", length);
  check_finite("offset", offset);
  const double scale = length < kShort ? kLengthen : 1.0;
  const double scaled_length = scale == 1.0 ? length : (scale * normal).stableNorm();
  normal_ = scale * normal / scaled_length;
  offset_ = scale * offset / scaled_length;
  if (!std::isfinite(offset_)) {
    throw_argument("offset", "a number that stays finite when the normal gets unit length",
                   to_text(offset) + " with a normal of length " + to_text(length));
  }
}

Plane Plane::through(const Vec3& point, const Vec3& normal) {
  const double length = normal.stableNorm();
  check_positive("normal", length);
  const Vec3 unit =
      length < kShort ? Vec3((kLengthen * normal).stableNormalized()) : Vec3(normal / length);
  return {unit, unit.dot(point)};
}

}  // namespace bathyal
