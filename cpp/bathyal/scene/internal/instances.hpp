// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "bathyal/base/page_array.hpp"
#include "bathyal/geometry/pose.hpp"
#include "bathyal/scene/internal/cast_kernel.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/instance_frame.hpp"
#include "bathyal/scene/internal/local_frame.hpp"
#include "bathyal/scene/internal/nodes.hpp"

namespace bathyal {
namespace scene {

/// The meshes of a scene's rows, and of each distinct one its hierarchy: what scenes share that
/// differ in their poses only.
struct InstanceMeshes {
  /// `known`, where given, is the hierarchy of the one mesh that there is.
  /// \throw std::invalid_argument as Hierarchy does.
  InstanceMeshes(std::vector<TriangleMesh> meshes, std::shared_ptr<const Scene::Hierarchy> known,
                 int num_threads);

  std::vector<TriangleMesh> meshes;  ///< of each row
  std::vector<std::int32_t> number;  ///< of each row: which of the distinct meshes it is
  std::vector<std::shared_ptr<const Scene::Hierarchy>> hierarchies;  ///< of each distinct mesh
  std::vector<CastScene> views;                                      ///< the same for the kernels
  std::vector<double> radius;  ///< about the middle of its box, of each distinct mesh [m]

  bool has_triangles(std::size_t row) const {
    return hierarchies[static_cast<std::size_t>(number[row])]->primitive_count > 0;
  }
  std::size_t memory() const;
};

/// What a kernel needs of one hierarchy.
CastScene cast_view(const Scene::Hierarchy& hierarchy);

/// Writes origin, box and reach.
void set_local_frame(CastScene& view, const LocalFrame& frame);

/// The rotation and position, without the scale.
Pose pose_of(const InstanceFrame& frame);

// Between the world and the frame of an instance's mesh.
Vec3 to_world(const InstanceFrame& frame, const Vec3& point);
Vec3 to_mesh(const InstanceFrame& frame, const Vec3& point);
Vec3 turn_to_world(const InstanceFrame& frame, const Vec3& direction);
Vec3 turn_to_mesh(const InstanceFrame& frame, const Vec3& direction);

}  // namespace scene

/// Instances of meshes under a tree over their boxes in the world; nodes as in Hierarchy, but
/// ~child is an instance's row, and rows without triangles are in no node. An instance's box
/// contains all that its mesh's own decisions may place in the world.
struct Scene::Instances : scene::LocalFrame {
  /// \throw std::invalid_argument for poses or scales that do not fit the meshes, are not finite,
  /// rigid or above 0, or reach further than 10¹² m from the middle of all.
  Instances(std::shared_ptr<const scene::InstanceMeshes> shared, const std::vector<Pose>& poses,
            const std::vector<double>& scales, int num_threads);

  const Hierarchy& hierarchy(std::int32_t row) const {
    return *shared->hierarchies[static_cast<std::size_t>(frame(row).mesh)];
  }
  const scene::InstanceFrame& frame(std::int32_t row) const {
    return frames[static_cast<std::size_t>(row)];
  }
  std::int32_t size() const { return static_cast<std::int32_t>(frames.size()); }
  scene::InstancedScene view() const;
  std::size_t memory() const;

  std::shared_ptr<const scene::InstanceMeshes> shared;
  PageArray<scene::InstanceFrame> frames;  ///< of each row

  /// A row at the identity that is most of the scene (a bottom), or −1. The tree counts from the
  /// origin of its hierarchy, so that a packet of rays set up for the tree serves for both.
  std::int32_t home = -1;

  PageArray<scene::WideNode> nodes;
};

}  // namespace bathyal
