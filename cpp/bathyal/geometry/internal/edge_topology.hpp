// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal::geometry {

/// How the triangles of a mesh hang together. Edges of a corner repeated in one triangle are no
/// edges.
struct EdgeTopology {
  Index components = 0;
  Index boundary_edges = 0;
  Index nonmanifold_edges = 0;
  Index inconsistent_edges = 0;
  Index nonmanifold_vertices = 0;
  std::vector<double> boundary_loops;  ///< lengths, longest first [m]
};

/// Two boundary edges belong to one loop when they meet in the same fan of triangles, so a rim that
/// touches itself in a vertex is two loops.
EdgeTopology edge_topology(const TriangleMesh& mesh, int num_threads);

/// Triangles on the same three vertices as one before them.
Index count_duplicate_triangles(TriangleView triangles, Index vertex_count, int num_threads);

}  // namespace bathyal::geometry
