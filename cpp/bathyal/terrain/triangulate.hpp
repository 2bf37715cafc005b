// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "bathyal/geometry/triangle_mesh.hpp"
#include "bathyal/terrain/delaunay.hpp"
#include "bathyal/terrain/sheets.hpp"

namespace bathyal {

/// A bottom made from soundings, and what was left out of it.
struct Triangulation {
  TriangleMesh mesh;   ///< the cloud's points row for row, with their attributes and datum
  SheetReport sheets;  ///< where the cloud is no height field, so that `mesh` is not to be trusted
  double max_edge = 0.0;    ///< as in Delaunay
  Index cut_triangles = 0;  ///< as in Delaunay
  Index merged_points = 0;  ///< as in Delaunay
};

/// Triangulates a cloud as a height field (delaunay) and looks whether it is one (find_sheets). The
/// mesh shares the memory of the cloud.
/// \throw std::invalid_argument for points that are not finite and for fewer than three points that
/// differ in (x, y) and are not on one line.
Triangulation triangulate(const PointCloud& cloud, const DelaunayOptions& options = {});

/// \throw std::invalid_argument that counts the points that are not finite and names clean_cloud.
void check_clean(std::string_view name, PointView points);

}  // namespace bathyal
