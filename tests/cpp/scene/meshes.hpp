// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "bathyal/geometry/triangle_mesh.hpp"

// Small meshes with a known shape, for the tests of this room.

namespace bathyal::test {

inline TriangleMesh mesh_of(const std::vector<Vec3>& vertices,
                            const std::vector<Eigen::Vector3i>& triangles) {
  PointMatrix points(static_cast<Index>(vertices.size()), 3);
  for (Index i = 0; i < points.rows(); ++i) points.row(i) = vertices[static_cast<std::size_t>(i)];
  TriangleMatrix indices(static_cast<Index>(triangles.size()), 3);
  for (Index i = 0; i < indices.rows(); ++i) {
    indices.row(i) = triangles[static_cast<std::size_t>(i)];
  }
  return {std::move(points), std::move(indices)};
}

inline TriangleMesh one_triangle(const Vec3& corner) {
  return mesh_of({corner, corner + Vec3::UnitX(), corner + Vec3::UnitY()}, {{0, 1, 2}});
}

/// A height field of columns × rows points at 1 m with waves, triangles facing up.
inline TriangleMesh seabed(int columns, int rows, const Vec3& offset = Vec3::Zero()) {
  std::vector<Vec3> vertices;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      vertices.push_back(offset +
                         Vec3(i, j, std::sin(0.3 * i) + 2.0 * std::cos(0.05 * j + 0.11 * i)));
    }
  }
  std::vector<Eigen::Vector3i> triangles;
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i;
      triangles.emplace_back(a, a + 1, a + columns + 1);
      triangles.emplace_back(a, a + columns + 1, a + columns);
    }
  }
  return mesh_of(vertices, triangles);
}

/// Corners at ±half around `centre`; twelve triangles facing out.
inline TriangleMesh box(const Vec3& half, const Vec3& centre = Vec3::Zero()) {
  std::vector<Vec3> vertices;
  for (int i = 0; i < 8; ++i) {
    vertices.push_back(centre + Vec3((i & 1) != 0 ? half.x() : -half.x(),
                                     (i & 2) != 0 ? half.y() : -half.y(),
                                     (i & 4) != 0 ? half.z() : -half.z()));
  }
  return mesh_of(vertices, {{0, 2, 1},
                            {1, 2, 3},
                            {4, 5, 6},
                            {5, 7, 6},
                            {0, 1, 4},
                            {1, 5, 4},
                            {2, 6, 3},
                            {3, 6, 7},
                            {0, 4, 2},
                            {2, 4, 6},
                            {1, 3, 5},
                            {3, 7, 5}});
}

inline TriangleMesh tetrahedron(const Vec3& centre = Vec3::Zero()) {
  return mesh_of({centre + Vec3(1, 1, 1), centre + Vec3(1, -1, -1), centre + Vec3(-1, 1, -1),
                  centre + Vec3(-1, -1, 1)},
                 {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

/// An octahedron divided `levels` times, its vertices on the sphere; triangles facing out.
inline TriangleMesh sphere(int levels, double radius, const Vec3& centre = Vec3::Zero()) {
  std::vector<Vec3> vertices = {Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                                -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  std::vector<Eigen::Vector3i> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                            {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle_of;
    const auto middle = [&](int a, int b) {
      const auto [entry, added] =
          middle_of.try_emplace(std::minmax(a, b), static_cast<int>(vertices.size()));
      if (added) {
        vertices.push_back(
            (vertices[static_cast<std::size_t>(a)] + vertices[static_cast<std::size_t>(b)])
                .normalized());
      }
      return entry->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& t : triangles) {
      const int ab = middle(t[0], t[1]);
      const int bc = middle(t[1], t[2]);
      const int ca = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  for (Vec3& v : vertices) v = centre + radius * v;
  return mesh_of(vertices, triangles);
}

}  // namespace bathyal::test
