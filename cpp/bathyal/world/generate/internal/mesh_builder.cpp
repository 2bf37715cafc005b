// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/internal/mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace bathyal::generate {
namespace {

Vec3 middle_of(const Ring& ring) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : ring) sum += point - ring.front();
  return ring.front() + sum / static_cast<double>(ring.size());
}

}  // namespace

Ring ellipse(const Vec3& center, const Vec3& u, const Vec3& v, double radius_u, double radius_v,
             int count) {
  Ring ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    ring.push_back(center + radius_u * std::cos(angle) * u + radius_v * std::sin(angle) * v);
  }
  return ring;
}

std::int32_t MeshBuilder::vertex(const Vec3& point) {
  vertices_.push_back(point);
  return static_cast<std::int32_t>(vertices_.size() - 1);
}

void MeshBuilder::loft(const std::vector<Ring>& rings, const Vec3& start, const Vec3& end) {
  const std::int32_t first_tip = vertex(start);
  const std::int32_t last_tip = vertex(end);
  const auto first = static_cast<std::int32_t>(vertices_.size());
  for (const Ring& ring : rings) vertices_.insert(vertices_.end(), ring.begin(), ring.end());
  const auto sides = static_cast<std::int32_t>(rings.front().size());
  const auto count = static_cast<std::int32_t>(rings.size());
  for (std::int32_t j = 0; j < sides; ++j) {
    const std::int32_t next = (j + 1) % sides;
    triangle(first_tip, first + next, first + j);
    for (std::int32_t i = 0; i + 1 < count; ++i) {
      const std::int32_t here = first + i * sides;
      quad(here + j, here + next, here + sides + next, here + sides + j);
    }
    const std::int32_t last = first + (count - 1) * sides;
    triangle(last_tip, last + j, last + next);
  }
}

void MeshBuilder::loft(const std::vector<Ring>& rings) {
  loft(rings, middle_of(rings.front()), middle_of(rings.back()));
}

void MeshBuilder::box(const Vec3& low, const Vec3& high) {
  const auto ring = [&](double z) {
    return Ring{{low.x(), low.y(), z},
                {high.x(), low.y(), z},
                {high.x(), high.y(), z},
                {low.x(), high.y(), z}};
  };
  loft({ring(low.z()), ring(high.z())});
}

void MeshBuilder::cylinder(const Vec3& from, const Vec3& to, double radius, int sides) {
  const Vec3 axis = (to - from).normalized();
  const Vec3 u = axis.unitOrthogonal();
  const Vec3 v = axis.cross(u);
  loft({ellipse(from, u, v, radius, radius, sides), ellipse(to, u, v, radius, radius, sides)});
}

void MeshBuilder::sphere(const Vec3& center, double radius, int sides) {
  std::vector<Ring> rings;
  const int bands = sides / 2;
  for (int i = 1; i < bands; ++i) {
    const double angle = std::numbers::pi * i / bands;
    const double across = radius * std::sin(angle);
    rings.push_back(ellipse(center - radius * std::cos(angle) * Vec3::UnitZ(), Vec3::UnitX(),
                            Vec3::UnitY(), across, across, sides));
  }
  loft(rings, center - radius * Vec3::UnitZ(), center + radius * Vec3::UnitZ());
}

void MeshBuilder::transform(const Pose& pose, std::size_t first) {
  for (std::size_t i = first; i < vertices_.size(); ++i) vertices_[i] = pose * vertices_[i];
}

void MeshBuilder::rest() {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : vertices_) lowest = std::min(lowest, vertex.z());
  for (Vec3& vertex : vertices_) vertex.z() -= lowest;
}

TriangleMesh MeshBuilder::mesh(Attributes attributes) const {
  PointMatrix points(static_cast<Index>(vertices_.size()), 3);
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    points.row(static_cast<Index>(i)) = vertices_[i];
  TriangleMatrix triangles(static_cast<Index>(triangles_.size()), 3);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangles(static_cast<Index>(i), static_cast<Index>(k)) = triangles_[i][k];
    }
  }
  return {std::move(points), std::move(triangles), std::move(attributes)};
}

}  // namespace bathyal::generate
