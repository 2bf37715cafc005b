// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bathyal/base/page_array.hpp"
#include "bathyal/scene/internal/local_frame.hpp"
#include "bathyal/scene/internal/nodes.hpp"
#include "bathyal/scene/internal/winding.hpp"
#include "bathyal/scene/scene.hpp"

namespace bathyal {

/// The bounding volume hierarchy of a scene: eight boxes a node, one block of up to eight triangles
/// a leaf. `nodes[0]` is the root; there is no node when there is no triangle. A node comes
/// before its children, so a loop from the last node to the first sees children before parents, and
/// every block belongs to exactly one lane of one node. The same bytes for any number of threads.
///
/// Boxes and blocks are in the local frame, local = world − origin, in float; boxes are rounded
/// outwards. They serve to cull; hits are decided in double on `corners`. Where the scene has
/// instances, each mesh has a hierarchy of its own, and "world" here is the mesh's own frame.
struct Scene::Hierarchy : scene::LocalFrame {
  /// Copies no mesh array.
  /// \throw std::invalid_argument when the triangles reach further than 10¹² m from their middle,
  /// or when there are more than 2³² − 2 of them.
  Hierarchy(std::vector<TriangleMesh> meshes, int num_threads);

  /// \copydoc scene::name_of
  scene::PrimitiveName name(std::uint32_t primitive) const {
    return scene::name_of(arrays.data(), static_cast<std::int32_t>(arrays.size()), primitive);
  }

  /// The triangle's row in its mesh, and the vertices that it counts.
  struct Row {
    const double* vertices;
    const std::int32_t* index;

    const double* corner(int c) const { return vertices + 3 * std::int64_t{index[c]}; }
  };
  Row row(const scene::PrimitiveName& name) const {
    const scene::MeshArrays& mesh = arrays[static_cast<std::size_t>(name.mesh)];
    return {mesh.vertices, mesh.triangles + 3 * std::int64_t{name.triangle}};
  }
  Row row(std::uint32_t primitive) const { return row(name(primitive)); }

  /// The triangle's three corners in the world [m], as the mesh has them.
  static std::array<Vec3, 3> corners(const Row& row) {
    return {Vec3(row.corner(0)), Vec3(row.corner(1)), Vec3(row.corner(2))};
  }
  std::array<Vec3, 3> corners(std::uint32_t primitive) const { return corners(row(primitive)); }

  std::size_t memory() const { return nodes.bytes() + blocks.bytes() + clusters.bytes(); }

  std::vector<TriangleMesh> meshes;
  std::vector<scene::MeshArrays> arrays;  ///< of each mesh
  std::uint32_t primitive_count = 0;
  PageArray<scene::WideNode> nodes;
  PageArray<scene::TriangleBlock> blocks;
  scene::Clusters clusters;  ///< for winding numbers; made at the first query
};

}  // namespace bathyal
