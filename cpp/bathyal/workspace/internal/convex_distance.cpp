// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/convex_distance.hpp"

#include <array>
#include <cstddef>

namespace bathyal::workspace {
namespace {

/// Of a product of intervals [−half, half]: outside the Euclidean length of what is beyond each,
/// inside the nearest side. Of equally near sides the first.
template <int N>
struct Intervals {
  using Vector = Eigen::Matrix<double, N, 1>;
  double value;
  Vector gradient;

  Intervals(const Vector& point, const Vector& half) {
    const Vector beyond = point.cwiseAbs() - half;
    Index nearest = 0;
    value = beyond.maxCoeff(&nearest);
    gradient = Vector::Zero();
    if (value > 0.0) {
      gradient = beyond.cwiseMax(0.0);
      value = gradient.stableNorm();
      gradient /= value;
    } else {
      gradient[nearest] = 1.0;
    }
    for (int i = 0; i < N; ++i) gradient[i] = std::copysign(gradient[i], point[i]);
  }
};

/// Unit vector away from the z axis; along x on it.
Vec3 outwards(const Vec3& point, double rho) {
  return rho > 0.0 ? Vec3(point.x() / rho, point.y() / rho, 0.0) : Vec3(Vec3::UnitX());
}

SignedDistance of_cylinder(const KeepOut& shape, const Vec3& point) {
  const double rho = std::hypot(point.x(), point.y());
  const Intervals<2> profile({rho, point.z()}, {shape.radius(), 0.5 * shape.length()});
  return {profile.value,
          profile.gradient[0] * outwards(point, rho) + profile.gradient[1] * Vec3::UnitZ()};
}

/// In the half-plane of distance from the axis and height: the nearer of slanted side and end.
SignedDistance of_cone(const KeepOut& shape, const Vec3& point) {
  using Vec2 = Eigen::Vector2d;
  const double rho = std::hypot(point.x(), point.y());
  const Vec2 query(rho, point.z());
  const Vec2 rim(shape.radius(), shape.length());
  const double slant = rim.stableNorm();
  const Vec2 along = rim / slant;
  const Vec2 normal(along.y(), -along.x());
  const bool inside = normal.dot(query) <= 0.0 && query.y() <= shape.length();

  const Vec2 on_side = std::clamp(along.dot(query), 0.0, slant) * along;
  const Vec2 on_end(std::clamp(rho, 0.0, shape.radius()), shape.length());
  const Vec2 from_side = query - on_side, from_end = query - on_end;
  const double to_side = from_side.stableNorm(), to_end = from_end.stableNorm();
  const bool side_is_nearer = to_side < to_end;
  const double distance = std::min(to_side, to_end);
  Vec2 gradient = side_is_nearer ? normal : Vec2(0.0, 1.0);
  if (!inside && distance > 0.0) gradient = (side_is_nearer ? from_side : from_end) / distance;
  return {inside ? -distance : distance,
          gradient[0] * outwards(point, rho) + gradient[1] * Vec3::UnitZ()};
}

}  // namespace

SignedDistance signed_distance(const KeepOut& shape, const Vec3& point) {
  switch (shape.kind()) {
    case KeepOutKind::kSphere: {
      const double length = point.stableNorm();
      return {length - shape.radius(), length > 0.0 ? Vec3(point / length) : Vec3(Vec3::UnitX())};
    }
    case KeepOutKind::kBox: {
      const Intervals<3> box(point, 0.5 * shape.size());
      return {box.value, box.gradient};
    }
    case KeepOutKind::kCylinder:
      return of_cylinder(shape, point);
    case KeepOutKind::kCone:
      return of_cone(shape, point);
    default:
      return {shape.border().distance(point), shape.border().normal()};
  }
}

}  // namespace bathyal::workspace
