// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/keepout.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/internal/convex_distance.hpp"
#include "bathyal/workspace/internal/obstacle.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kGrain = 1024;

void check_not_empty(std::string_view name, const std::string& text) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw_argument(name, "a name", "an empty text");
  }
}

void check_rows(std::string_view name, std::ptrdiff_t rows, std::ptrdiff_t expected) {
  if (rows != expected) {
    throw_argument(name, std::to_string(expected) + " rows, as `a`", std::to_string(rows));
  }
}

}  // namespace

std::string to_string(KeepOutKind kind) {
  switch (kind) {
    case KeepOutKind::kSphere:
      return "sphere";
    case KeepOutKind::kBox:
      return "box";
    case KeepOutKind::kCylinder:
      return "cylinder";
    case KeepOutKind::kCone:
      return "cone";
    case KeepOutKind::kHalfSpace:
      return "half_space";
    default:
      return "mesh";
  }
}

KeepOut::KeepOut(KeepOutKind kind, KeepOutLabel label)
    : kind_(kind), frame_(std::move(label.frame)), name_(label.name.value_or(to_string(kind))) {
  check_not_empty("frame", frame_);
  check_not_empty("name", name_);
}

KeepOut KeepOut::sphere(double radius, const Vec3& center, KeepOutLabel label) {
  KeepOut made(KeepOutKind::kSphere, std::move(label));
  check_positive("radius", radius);
  for (const double value : center) check_finite("center", value);
  made.radius_ = radius;
  made.frame_from_shape_.translation() = center;
  return made;
}

KeepOut KeepOut::box(const Vec3& size, const Pose& frame_from_box, KeepOutLabel label) {
  KeepOut made(KeepOutKind::kBox, std::move(label));
  for (const double value : size) check_positive("size", value);
  check_rigid("pose", frame_from_box);
  made.size_ = size;
  made.frame_from_shape_ = frame_from_box;
  return made;
}

KeepOut KeepOut::round(KeepOutKind kind, double radius, double length, const Pose& frame_from_shape,
                       KeepOutLabel label) {
  KeepOut made(kind, std::move(label));
  check_positive("radius", radius);
  check_positive("length", length);
  check_rigid("pose", frame_from_shape);
  made.radius_ = radius;
  made.length_ = length;
  made.frame_from_shape_ = frame_from_shape;
  return made;
}

KeepOut KeepOut::cylinder(double radius, double length, const Pose& frame_from_cylinder,
                          KeepOutLabel label) {
  return round(KeepOutKind::kCylinder, radius, length, frame_from_cylinder, std::move(label));
}

KeepOut KeepOut::cone(double radius, double length, const Pose& frame_from_cone,
                      KeepOutLabel label) {
  return round(KeepOutKind::kCone, radius, length, frame_from_cone, std::move(label));
}

KeepOut KeepOut::half_space(const Plane& border, KeepOutLabel label) {
  KeepOut made(KeepOutKind::kHalfSpace, std::move(label));
  made.border_ = border;
  return made;
}

KeepOut KeepOut::moved(Trajectory frame_from_given) const {
  KeepOut moving = *this;
  moving.motion_ = std::move(frame_from_given);
  return moving;
}

KeepOut KeepOut::mesh(Hull hull, KeepOutLabel label) {
  KeepOut made(KeepOutKind::kMesh, std::move(label));
  made.hull_ = std::move(hull);
  return made;
}

void KeepOut::contains(PointView points, std::span<bool> inside, int num_threads) const {
  if (hull_) return hull_->contains(points, inside, num_threads);
  if (std::ssize(inside) != points.rows()) {
    throw_argument("inside", std::to_string(points.rows()) + " values",
                   std::to_string(inside.size()));
  }
  const std::vector<double> distances = distance(points, num_threads);
  std::transform(distances.begin(), distances.end(), inside.begin(),
                 [](double d) { return d <= 0.0; });
}

std::vector<double> KeepOut::distance(PointView points, int num_threads) const {
  if (hull_) return hull_->signed_distance(points, num_threads);
  check_points_finite("points", points);
  const Pose shape_from_frame = frame_from_shape_.inverse();
  std::vector<double> distances(static_cast<std::size_t>(points.rows()));
  parallel_for(distances.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 point = points.row(static_cast<Index>(i));
      distances[i] = workspace::signed_distance(*this, shape_from_frame * point).value;
    }
  });
  return distances;
}

std::vector<double> KeepOut::capsule_distance(PointView a, PointView b,
                                              std::span<const double> radius,
                                              int num_threads) const {
  check_rows("b", b.rows(), a.rows());
  check_rows("radius", std::ssize(radius), a.rows());
  check_points_finite("a", a);
  check_points_finite("b", b);
  for (const double value : radius) check_not_negative("radius", value);
  const workspace::Obstacle obstacle(*this, workspace::kVehicleFrame);
  std::vector<double> distances(radius.size());
  parallel_for(distances.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Index>(i);
      distances[i] = obstacle.nearest({a.row(row), b.row(row), radius[i]}).distance;
    }
  });
  return distances;
}

}  // namespace bathyal
