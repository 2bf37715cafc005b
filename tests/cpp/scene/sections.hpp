// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"

// A level grid to cut, and what every section promises.

namespace bathyal::test {

/// A level grid of columns × rows points at 1 m, its first point at `corner`.
inline TriangleMesh level_grid(int columns, int rows, const Vec3& corner = Vec3::Zero()) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) vertices.push_back(corner + Vec3(i, j, 0.0));
  }
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i;
      triangles.emplace_back(a, a + 1, a + columns + 1);
      triangles.emplace_back(a, a + columns + 1, a + columns);
    }
  }
  return mesh_of(vertices, triangles);
}

inline double length(const Polyline& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    sum += (line.points[i] - line.points[i - 1]).norm();
  }
  return sum;
}

inline double length(const std::vector<Polyline>& lines) {
  double sum = 0.0;
  for (const Polyline& line : lines) sum += length(line);
  return sum;
}

/// What every section promises, whatever the mesh.
inline void expect_well_formed(const std::vector<Polyline>& lines, const Scene& scene) {
  using Corner = std::array<double, 3>;
  std::set<std::tuple<std::int32_t, Corner, Corner>> seen;
  for (const Polyline& line : lines) {
    ASSERT_GE(line.points.size(), 2U);
    ASSERT_EQ(line.mesh.size(), line.points.size() - 1);
    ASSERT_EQ(line.triangle.size(), line.points.size() - 1);
    EXPECT_EQ(line.closed, line.points.front() == line.points.back());
    for (std::size_t i = 0; i < line.mesh.size(); ++i) {
      EXPECT_EQ(line.mesh[i], line.mesh[0]);
      const Vec3 &p = line.points[i], &q = line.points[i + 1];
      EXPECT_NE(p, q) << "a segment of no length";
      Corner a{p.x(), p.y(), p.z()}, b{q.x(), q.y(), q.z()};
      if (b < a) std::swap(a, b);
      EXPECT_TRUE(seen.emplace(line.mesh[i], a, b).second) << "a segment twice";
      const TriangleMesh& mesh = scene.meshes()[static_cast<std::size_t>(line.mesh[i])];
      const Vec3 v0 = mesh.corner(line.triangle[i], 0);
      const double size = 1.0 + v0.norm();
      const Vec3 normal = mesh.area_vector(line.triangle[i]).normalized();
      EXPECT_NEAR(normal.dot(p - v0), 0.0, 1e-13 * size) << "off its triangle's plane";
      EXPECT_NEAR(normal.dot(q - v0), 0.0, 1e-13 * size);
    }
  }
}

inline void expect_equal(const std::vector<Polyline>& a, const std::vector<Polyline>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].points, b[i].points);
    EXPECT_EQ(a[i].closed, b[i].closed);
  }
}

}  // namespace bathyal::test
