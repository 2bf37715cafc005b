// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal::toolpath {

/// Finds the vertices near a point that belong to the same sheet of a mesh. Keeps a reference to
/// the mesh.
class SheetWalk {
 public:
  explicit SheetWalk(const TriangleMesh& mesh);

  /// Vertices within `radius` of `centre`, reached from `triangle` over triangles that share a
  /// vertex with one already reached, come within `radius` and look the same way as `triangle` (to
  /// 90°). Rising.
  std::vector<std::int32_t> vertices_within(std::int32_t triangle, const Vec3& centre,
                                            double radius) const;

  /// Corners of all triangles that share a vertex with `triangle`. Rising.
  std::vector<std::int32_t> vertices_around(std::int32_t triangle) const;

 private:
  const TriangleMesh& mesh_;
  std::vector<std::int32_t> start_;  // triangles of vertex v: triangles_[start_[v] … start_[v+1])
  std::vector<std::int32_t> triangles_;
};

}  // namespace bathyal::toolpath
