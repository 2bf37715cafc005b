// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

/// normal · x = offset, the normal of unit length (Filaretov, Konoplin, Konoplin 2018, eq 1: m and
/// d). For a bottom the normal points up, out of the bottom.
class Plane {
 public:
  Plane() = default;

  /// Scales both so that the normal is of unit length.
  /// \throw std::invalid_argument for a normal of zero length, a value that is not finite, or an
  /// offset that is not when it is scaled.
  Plane(const Vec3& normal, double offset);

  static Plane through(const Vec3& point, const Vec3& normal);

  const Vec3& normal() const { return normal_; }
  double offset() const { return offset_; }

  /// Signed distance [m], positive on the side the normal points to.
  double distance(const Vec3& point) const { return normal_.dot(point) - offset_; }
  Vec3 project(const Vec3& point) const { return point - distance(point) * normal_; }

 private:
  Vec3 normal_ = Vec3::UnitZ();
  double offset_ = 0.0;
};

}  // namespace bathyal
