// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal::workspace {

/// A mesh whose vertices of equal position are one: an STL file repeats each corner of every
/// triangle, and only joined triangles tell whether a surface is closed.
struct WeldedMesh {
  explicit WeldedMesh(const TriangleMesh& mesh);

  /// Corner of a triangle, as the mesh has it.
  Vec3 corner(std::size_t triangle, std::size_t c) const {
    return points[static_cast<std::size_t>(triangles[triangle][c])];
  }

  /// Of all its points; empty without any.
  Eigen::AlignedBox3d box() const;

  std::vector<Vec3> points;                            ///< distinct positions
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< row for row those of the mesh
};

/// An edge along which the triangles do not cancel: a rim, or a place where triangles that run the
/// same way meet.
struct OpenEdge {
  std::int32_t from, to;  ///< vertices of the welded mesh
  int count;              ///< triangles that run from → to less those that run to → from
};

/// What edges say about a mesh. Edges of no length are left out.
struct EdgeReport {
  std::vector<OpenEdge> open;      ///< none: the winding number is whole everywhere
  std::size_t boundary = 0;        ///< edges of one triangle
  std::size_t nonmanifold = 0;     ///< edges of more than two triangles
  std::size_t inconsistent = 0;    ///< edges of two triangles that run the same way
  std::vector<std::int32_t> part;  ///< of each triangle: those joined by edges have one number
  std::int32_t parts = 0;          ///< numbered from 0 by their first triangle
};

EdgeReport edge_report(const WeldedMesh& mesh);

}  // namespace bathyal::workspace
