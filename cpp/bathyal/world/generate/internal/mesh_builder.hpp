// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bathyal/geometry/pose.hpp"
#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal::generate {

using Ring = std::vector<Vec3>;

/// `count` points of a circle about `center`, from `u` towards `v`, orthonormal; equal ones of an
/// ellipse.
Ring ellipse(const Vec3& center, const Vec3& u, const Vec3& v, double radius_u, double radius_v,
             int count);

/// Triangles as they are put together: closed bodies with outward normals, one after the other.
class MeshBuilder {
 public:
  std::int32_t vertex(const Vec3& point);
  void triangle(std::int32_t a, std::int32_t b, std::int32_t c) { triangles_.push_back({a, b, c}); }
  void quad(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }

  /// A body through rings of one length, counter-clockwise about the way they follow one another;
  /// fans to `start` and `end` close it.
  void loft(const std::vector<Ring>& rings, const Vec3& start, const Vec3& end);
  /// The same, closed flat at the middles of the first and the last ring.
  void loft(const std::vector<Ring>& rings);

  void box(const Vec3& low, const Vec3& high);
  /// Between two points, closed flat.
  void cylinder(const Vec3& from, const Vec3& to, double radius, int sides);
  /// About the z axis through `center`; the first and last ring are its poles.
  void sphere(const Vec3& center, double radius, int sides);

  /// Each vertex from `first` on, moved.
  void transform(const Pose& pose, std::size_t first = 0);

  std::vector<Vec3>& vertices() { return vertices_; }
  std::size_t triangle_count() const { return triangles_.size(); }

  /// Moved along z so that the lowest vertex is at 0.
  void rest();

  TriangleMesh mesh(Attributes attributes = {}) const;

 private:
  std::vector<Vec3> vertices_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
};

}  // namespace bathyal::generate
