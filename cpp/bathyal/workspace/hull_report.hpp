// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal {

/// What is wrong with a mesh that is to be a hull, as numbers. Vertices of equal position count as
/// one, so a mesh whose triangles each have their own corners (STL) can be closed.
struct HullReport {
  Index triangle_count = 0;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounding box of the triangles [m]
  double area = 0.0;                             ///< of the surface [m²]

  /// Along every edge as many triangles run one way as the other: the surface has no rim, and
  /// inside is exact. Else it is what films over the holes would hold.
  bool closed = false;
  bool inside_out = false;  ///< normals point inwards, all in all; inside is the same
  double volume = 0.0;      ///< of a closed surface, overlaps counted twice [m³]; else NaN

  Index open_edges = 0;            ///< along which triangles do not cancel
  Index boundary_edges = 0;        ///< of one triangle only
  Index nonmanifold_edges = 0;     ///< of three triangles or more
  Index inconsistent_edges = 0;    ///< whose two triangles run the same way along it
  Index degenerate_triangles = 0;  ///< lower than 1e-12 of their longest edge

  Index parts = 0;              ///< pieces joined by edges
  Index opposed_parts = 0;      ///< closed pieces wound against the whole: cavities, or mistakes
  Index overlapping_parts = 0;  ///< pairs of pieces whose surfaces cross

  /// Pairs of triangles that meet other than by a corner or an edge that they share (exact).
  Index intersecting_pairs = 0;

  std::vector<std::string> warnings;  ///< a short sentence each; none for a sound hull
};

/// Measures a mesh. The same bytes for any number of threads.
HullReport hull_report(const TriangleMesh& mesh, int num_threads = 0);

/// A few lines for people, the warnings among them.
std::string describe(const HullReport& report);

}  // namespace bathyal
