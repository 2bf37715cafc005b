// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/hole.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bathyal::toolpath {
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

/// Whether the axis meets the box at t ≥ 0, with a little to spare for rounding.
bool meets(const Eigen::AlignedBox3d& box, const Vec3& origin, const Vec3& direction) {
  const double spare = 1e-9 * (1.0 + box.sizes().maxCoeff() + box.min().cwiseAbs().maxCoeff());
  double first = 0.0, last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double low = box.min()[k] - spare - origin[k], high = box.max()[k] + spare - origin[k];
    if (direction[k] == 0.0) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    const double a = low / direction[k], b = high / direction[k];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

}  // namespace

Eigen::AlignedBox3d bounds_of(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (std::int32_t m = 0; m < scene.row_count(); ++m) {
    const TriangleMesh mesh = scene.mesh_in_world(m);
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      box.extend(mesh.vertices().row(i).transpose());
    }
  }
  return box;
}

bool passes_through_gap(const Scene& scene, const Eigen::AlignedBox3d& bounds, const Vec3& origin,
                        const Vec3& direction, const Vec3& up) {
  if (bounds.isEmpty() || !meets(bounds, origin, direction)) return false;
  // An axis along `up` lies in every upright plane: any horizontal direction serves.
  Vec3 level = direction.cross(up);
  if (level.norm() < 1e-9) level = direction.unitOrthogonal();
  level.normalize();
  const Vec3 upright = level.cross(direction).normalized();
  return passes_between_ends(scene, origin, direction, upright) ||
         passes_between_ends(scene, origin, direction, level);
}

}  // namespace bathyal::toolpath
