// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/hole.hpp"

#include <cmath>

namespace bathyal {
namespace {

/// The open end of the bottom that lies nearest to the axis on one side of it.
struct NearestEnd {
  double across = std::numeric_limits<double>::infinity();  ///< distance from the axis [m]
  double along = 0.0;                                       ///< at which t of the axis [m]
};

/// Cuts the scene by the plane through the axis and `across`, both unit and at right angles.
bool passes_between_ends(const Scene& scene, const Vec3& origin, const Vec3& direction,
                         const Vec3& across) {
  NearestEnd left, right;
  for (const Polyline& line :
       scene.section(Plane::through(origin, direction.cross(across).normalized()))) {
    if (line.closed || line.points.empty()) continue;
    for (const Vec3& end : {line.points.front(), line.points.back()}) {
      const double offset = across.dot(end - origin);
      NearestEnd& side = offset < 0.0 ? left : right;
      if (std::abs(offset) >= side.across) continue;
      side = {std::abs(offset), direction.dot(end - origin)};
    }
  }
  if (!std::isfinite(left.across) || !std::isfinite(right.across)) return false;
  const double width = left.across + right.across;
  if (width == 0.0) return left.along >= 0.0;
  return (left.along * right.across + right.along * left.across) / width >= 0.0;
}

}  // namespace

bool passes_through_gap(const Scene& scene, const Vec3& origin, const Vec3& direction,
                        const Vec3& up) {
  // An axis along `up` lies in every upright plane: any horizontal direction serves.
  Vec3 level = direction.cross(up);
  if (level.norm() < 1e-9) level = direction.unitOrthogonal();
  level.normalize();
  const Vec3 upright = level.cross(direction).normalized();
  return passes_between_ends(scene, origin, direction, upright) ||
         passes_between_ends(scene, origin, direction, level);
}

}  // namespace bathyal
