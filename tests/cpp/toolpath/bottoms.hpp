// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "bathyal/toolpath/toolpath.hpp"

// Small bottoms whose paths are known by hand.

namespace bathyal::test {

using Height = std::function<double(double, double)>;

/// A grid of (2 × columns × rows) triangles over [x0, x1] × [y0, y1], moved by `shift`; cells for
/// which `keep(column, row)` is false are left out.
inline TriangleMesh grid(const Height& height, double x0, double x1, int columns, double y0,
                         double y1, int rows, const Vec3& shift = Vec3::Zero(),
                         const std::function<bool(int, int)>& keep = {}) {
  PointMatrix vertices((columns + 1) * (rows + 1), 3);
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) {
      const double x = x0 + (x1 - x0) * c / columns, y = y0 + (y1 - y0) * r / rows;
      vertices.row(r * (columns + 1) + c) = Vec3(x, y, height(x, y)) + shift;
    }
  }
  std::vector<std::int32_t> corners;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      if (keep && !keep(c, r)) continue;
      const int v = r * (columns + 1) + c, w = v + columns + 1;
      corners.insert(corners.end(), {v, v + 1, w + 1, v, w + 1, w});
    }
  }
  return {vertices, TriangleMatrix(Eigen::Map<TriangleMatrix>(
                        corners.data(), static_cast<Index>(corners.size() / 3), 3))};
}

inline Scene scene_of(TriangleMesh mesh) { return Scene({std::move(mesh)}, 1); }

inline TriangleMesh mesh_of(const std::vector<Vec3>& points,
                            const std::vector<std::array<std::int32_t, 3>>& triangles) {
  PointMatrix vertices(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) vertices.row(static_cast<Index>(i)) = points[i];
  TriangleMatrix indices(static_cast<Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    indices.row(static_cast<Index>(i)) << triangles[i][0], triangles[i][1], triangles[i][2];
  }
  return {vertices, indices};
}

/// Axes straight down from z = `from` over each (x, y).
inline Aims down(const std::vector<Eigen::Vector2d>& at, double from = 100.0) {
  Aims aims(static_cast<Index>(at.size()), 6);
  for (std::size_t i = 0; i < at.size(); ++i) {
    aims.row(static_cast<Index>(i)) << at[i].x(), at[i].y(), from, 0, 0, -1;
  }
  return aims;
}

inline Aims axis(const Vec3& point, const Vec3& direction) {
  Aims aims(1, 6);
  aims << point.transpose(), direction.transpose();
  return aims;
}

inline Aims rows(std::initializer_list<Aims> parts) {
  Aims aims(static_cast<Index>(parts.size()), 6);
  Index i = 0;
  for (const Aims& part : parts) aims.row(i++) = part.row(0);
  return aims;
}

/// No options but the orientation as the paper has it.
inline ToolPathOptions piecewise_constant() {
  ToolPathOptions options;
  options.orientation = Orientation::kPiecewiseConstant;
  return options;
}

/// The samples' points on the bottom in order, each once.
inline std::vector<Vec3> points_of(const ToolPath& path) {
  std::vector<Vec3> points;
  for (const Vec3& p : path.surface) {
    if (points.empty() || (p - points.back()).norm() > 1e-9) points.push_back(p);
  }
  return points;
}

inline bool any(const std::vector<bool>& flags) {
  return std::find(flags.begin(), flags.end(), true) != flags.end();
}

inline bool warned(const ToolPath& path, const std::string& what) {
  for (const std::string& w : path.warnings) {
    if (w.find(what) != std::string::npos) return true;
  }
  return false;
}

}  // namespace bathyal::test
