// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {

/// Vertices and the triangles over them, counter-clockwise seen from outside (from above, for a
/// bottom). Invariants: every vertex is finite, every index names a vertex. Vertices that no
/// triangle uses are allowed: a mesh made from a cloud keeps its points row for row, so that vertex
/// i is sounding i. Immutable, cheap to copy; of vertices that a caller can write to, and so make
/// the first invariant false, what computes takes a snapshot(). Triangles are always the mesh's
/// own: indices that change after they were checked reach outside of the vertices.
class TriangleMesh {
 public:
  TriangleMesh() = default;

  /// \throw std::invalid_argument for a vertex that is not finite, an index out of range, or an
  /// attribute that is not as long as `vertices`.
  TriangleMesh(Points vertices, Triangles triangles, Attributes attributes = {}, Datum datum = {});

  PointView vertices() const { return vertices_.view(); }
  TriangleView triangles() const { return triangles_.view(); }
  const Points& shared_vertices() const { return vertices_; }
  const Triangles& shared_triangles() const { return triangles_; }
  const Attributes& attributes() const { return attributes_; }
  const Datum& datum() const { return datum_; }
  Index vertex_count() const { return vertices_.rows(); }
  Index triangle_count() const { return triangles_.rows(); }

  /// The same mesh over arrays that nobody can write to: see SharedArray.
  /// \throw std::invalid_argument as the constructor, of what is written in them by now.
  TriangleMesh snapshot() const;

  /// Corner `corner` (0, 1, 2) of triangle `triangle`.
  Vec3 corner(Index triangle, int corner) const {
    return vertices().row(triangles()(triangle, corner));
  }

  /// (V1 − V0) × (V2 − V0): twice the area long, along the outward normal.
  Vec3 area_vector(Index triangle) const {
    const Vec3 v0 = corner(triangle, 0);
    return (corner(triangle, 1) - v0).cross(corner(triangle, 2) - v0);
  }

 private:
  Points vertices_;
  Triangles triangles_;
  Attributes attributes_;
  Datum datum_;
};

}  // namespace bathyal
