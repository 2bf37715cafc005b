// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <numbers>
#include <vector>

#include "bathyal/sonar/echo.hpp"
#include "bathyal/sonar/presets.hpp"

// Worlds of which the echo is known.

namespace bathyal::test {

inline WorldSnapshot world_of(std::vector<TriangleMesh> meshes, std::vector<double> strength) {
  auto materials = std::make_shared<std::vector<Material>>();
  std::vector<SurfaceMaterial> surfaces;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Material material;
    material.name = "material_" + std::to_string(i);
    material.strength = strength[i];
    materials->push_back(material);
    surfaces.push_back({static_cast<std::int32_t>(i), nullptr});
  }
  return {Scene(std::move(meshes)), std::move(surfaces), std::move(materials), 0.0};
}

inline TriangleMesh mesh_of(const std::vector<Vec3>& corners,
                            const std::vector<std::array<std::int32_t, 3>>& faces) {
  PointMatrix points(static_cast<Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.row(static_cast<Index>(i)) = corners[i].transpose();
  }
  TriangleMatrix triangles(static_cast<Index>(faces.size()), 3);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      triangles(static_cast<Index>(i), c) = faces[i][static_cast<std::size_t>(c)];
  }
  return TriangleMesh(Points(std::move(points)), Triangles(std::move(triangles)));
}

/// A square bottom at a height, wound upwards.
inline TriangleMesh flat(double z, double half = 1000.0) {
  return mesh_of(
      {Vec3(-half, -half, z), Vec3(half, -half, z), Vec3(half, half, z), Vec3(-half, half, z)},
      {{0, 1, 2}, {0, 2, 3}});
}

/// A ball of longitudes and latitudes.
inline TriangleMesh ball(const Vec3& middle, double radius, int rings = 200) {
  std::vector<Vec3> corners;
  std::vector<std::array<std::int32_t, 3>> faces;
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (int j = 0; j < columns; ++j) {
      const double turn = 2.0 * std::numbers::pi * j / columns;
      corners.push_back(middle + radius * Vec3(std::sin(polar) * std::cos(turn),
                                               std::sin(polar) * std::sin(turn), std::cos(polar)));
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < columns; ++j) {
      const int next = (j + 1) % columns;
      const std::int32_t a = i * columns + j, b = i * columns + next;
      faces.push_back({a, a + columns, b + columns});
      faces.push_back({a, b + columns, b});
    }
  }
  return mesh_of(corners, faces);
}

inline Pose at(double x, double y, double z) { return Pose(Eigen::Translation3d(x, y, z)); }

inline double sum(const std::vector<double>& values, std::size_t first, std::size_t count) {
  double total = 0.0;
  for (std::size_t i = 0; i < count; ++i) total += values[first + i];
  return total;
}

}  // namespace bathyal::test
