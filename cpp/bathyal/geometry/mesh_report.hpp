// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal {

/// Measures by which to assess a mesh before use. Angles in radians, lengths in metres.
struct MeshReport {
  Index vertex_count = 0;
  Index unused_vertices = 0;  ///< of no triangle
  Index triangle_count = 0;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounding box of the vertices in use

  double area = 0.0;         ///< of the surface [m²]
  double planar_area = 0.0;  ///< of its shadow on the horizontal plane, every place once [m²]
  double rugosity = 0.0;     ///< area / planar_area; NaN without a shadow

  Index components = 0;                ///< pieces joined by edges
  std::vector<double> boundary_loops;  ///< lengths of the rims, longest first [m]
  Index boundary_edges = 0;            ///< of one triangle only
  Index nonmanifold_edges = 0;         ///< of three triangles or more
  Index nonmanifold_vertices = 0;      ///< where fans of triangles touch by the vertex alone
  Index inconsistent_edges = 0;        ///< whose two triangles run the same way along it
  Index zero_area_triangles = 0;       ///< lower than 1e-12 of their longest edge
  Index duplicate_triangles = 0;       ///< on the same three vertices as an earlier one
  bool closed = false;                 ///< every edge has two triangles, turned consistently
  double volume = 0.0;  ///< inside, negative when turned inside out; NaN unless closed

  Index inverted_triangles = 0;      ///< facing down: the normal's z is below 0
  double area_share_inverted = 0.0;  ///< their part of the area

  // Of the angle between a triangle's normal and up, 0 to π, weighted by area; NaN without area.
  double slope_mean = 0.0, slope_median = 0.0, slope_p95 = 0.0, slope_max = 0.0;
};

/// Measures a mesh. The planar area is exact where no two triangles lie over one another, and
/// otherwise integrated over about 1000 lines (a few parts in 10⁴). Published rugosities divide by
/// other planar areas (a concave hull, a coarsened mesh): compare with care. An empty mesh gives
/// zeros, and NaN where there is nothing to divide. The same bytes for any number of threads.
MeshReport mesh_report(const TriangleMesh& mesh, int num_threads = 0);

/// A few lines for people.
std::string describe(const MeshReport& report);

}  // namespace bathyal
