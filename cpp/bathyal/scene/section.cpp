// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <vector>

#include "bathyal/scene/internal/cut.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/instances.hpp"
#include "bathyal/scene/internal/prefetch.hpp"
#include "bathyal/scene/internal/slab_filter.hpp"

namespace bathyal {
namespace {

using scene::Cutter;
using scene::InstanceFrame;
using scene::SlabFilter;

/// What may lie in the section's plane, and in its strip; the plane again where there is none.
struct CutFilters {
  SlabFilter height, along;
};

/// Largest coordinate of a tree's boxes in the frame that the tree is in [m].
double reach_of(const scene::LocalFrame& frame) {
  return scene::reach(frame.origin) + frame.reach();
}

CutFilters filters_in(const scene::LocalFrame& frame, const Cutter& cutter) {
  const double reach = reach_of(frame);
  const SlabFilter height(frame, cutter.normal(), cutter.anchor(), 0.0, cutter.height_slack(reach));
  if (!cutter.has_strip()) return {height, height};
  return {height, SlabFilter(frame, cutter.along(), cutter.anchor(), cutter.along().stableNorm(),
                             cutter.along_slack(reach))};
}

/// The same for a mesh in its own frame; with room for the rounding of going there and back.
CutFilters filters_in(const Scene::Hierarchy& hierarchy, const Cutter& cutter,
                      const InstanceFrame& frame) {
  constexpr double kRoom = 4.0;
  const double reach = frame.scale * reach_of(hierarchy) +
                       2.0 * Eigen::Map<const Vec3>(frame.position).cwiseAbs().maxCoeff();
  const Vec3 anchor = scene::to_mesh(frame, cutter.anchor());
  const SlabFilter height(hierarchy, scene::turn_to_mesh(frame, cutter.normal()), anchor, 0.0,
                          kRoom * frame.per_metre * cutter.height_slack(reach));
  if (!cutter.has_strip()) return {height, height};
  return {height, SlabFilter(hierarchy, scene::turn_to_mesh(frame, cutter.along()), anchor,
                             frame.per_metre * cutter.along().stableNorm(),
                             kRoom * frame.per_metre * cutter.along_slack(reach))};
}

/// The leaves (blocks, or rows of instances) whose boxes the section may cut. Breadth first: by the
/// time a node is looked at its prefetch is long complete.
std::vector<std::int32_t> find_leaves(const PageArray<scene::WideNode>& tree,
                                      const CutFilters& filters) {
  std::vector<std::int32_t> leaves;
  if (tree.empty()) return leaves;
  std::vector<std::int32_t> nodes = {0};
  for (std::size_t next = 0; next < nodes.size(); ++next) {
    const scene::WideNode& node = tree[static_cast<std::size_t>(nodes[next])];
    scene::for_each_lane((filters.height.filter(node) & filters.along.filter(node)).bits(),
                         [&](int lane) {
                           const std::int32_t child = node.child[lane];
                           if (child < 0) {
                             leaves.push_back(~child);
                           } else {
                             nodes.push_back(child);
                             scene::prefetch(tree[static_cast<std::size_t>(child)]);
                           }
                         });
  }
  return leaves;
}

/// Calls `work(i)` for every i, after a prefetch of what `fetch(i + kAhead)` names: a
/// section touches a thin trace of a large scene, and would else wait for each of its places.
template <class Fetch, class Work>
void fetching_ahead(std::size_t count, const Fetch& fetch, const Work& work) {
  constexpr std::size_t kAhead = 8;
  for (std::size_t i = 0; i < std::min(kAhead, count); ++i) fetch(i);
  for (std::size_t i = 0; i < count; ++i) {
    if (i + kAhead < count) fetch(i + kAhead);
    work(i);
  }
}

/// The triangles that the section may cut, and few others.
std::vector<std::uint32_t> find_candidates(const Scene::Hierarchy& hierarchy,
                                           const CutFilters& filters) {
  const std::vector<std::int32_t> blocks = find_leaves(hierarchy.nodes, filters);
  const auto block = [&](std::size_t i) -> const scene::TriangleBlock& {
    return hierarchy.blocks[static_cast<std::size_t>(blocks[i])];
  };
  std::vector<std::uint32_t> candidates;
  candidates.reserve(scene::kWidth * blocks.size());
  fetching_ahead(
      blocks.size(), [&](std::size_t i) { scene::prefetch(block(i)); },
      [&](std::size_t i) {
        scene::for_each_lane(filters.height.filter(block(i)).bits(),
                             [&](int lane) { candidates.push_back(block(i).primitive[lane]); });
      });
  return candidates;
}

std::vector<Polyline> cut_scene(const Cutter& cutter, const Scene::Hierarchy& hierarchy) {
  struct Candidate {
    scene::PrimitiveName name;
    Scene::Hierarchy::Row row;
  };
  std::vector<Candidate> candidates;
  const std::vector<std::uint32_t> primitives =
      find_candidates(hierarchy, filters_in(hierarchy, cutter));
  candidates.reserve(primitives.size());
  for (const std::uint32_t primitive : primitives) {
    const scene::PrimitiveName name = hierarchy.name(primitive);
    candidates.push_back({name, hierarchy.row(name)});
    scene::prefetch_three(candidates.back().row.index);
  }
  scene::CutCollector collector(cutter, candidates.size());
  fetching_ahead(
      candidates.size(),
      [&](std::size_t i) {
        for (int c = 0; c < 3; ++c) scene::prefetch_three(candidates[i].row.corner(c));
      },
      [&](std::size_t i) {
        const auto& [name, row] = candidates[i];
        collector.add(Scene::Hierarchy::corners(row), name.mesh, name.triangle);
      });
  return collector.chain();
}

/// Each instance's triangles are cut where they are in the world.
std::vector<Polyline> cut_scene(const Cutter& cutter, const Scene::Instances& instances) {
  struct Candidate {
    std::int32_t row;
    std::uint32_t primitive;
  };
  std::vector<Candidate> candidates;
  for (const std::int32_t row : find_leaves(instances.nodes, filters_in(instances, cutter))) {
    const Scene::Hierarchy& hierarchy = instances.hierarchy(row);
    const InstanceFrame& frame = instances.frame(row);
    const CutFilters filters =
        frame.at_identity ? filters_in(hierarchy, cutter) : filters_in(hierarchy, cutter, frame);
    for (const std::uint32_t primitive : find_candidates(hierarchy, filters)) {
      candidates.push_back({row, primitive});
    }
  }
  scene::CutCollector collector(cutter, candidates.size());
  for (const Candidate& candidate : candidates) {
    std::array<Vec3, 3> corners = instances.hierarchy(candidate.row).corners(candidate.primitive);
    const InstanceFrame& frame = instances.frame(candidate.row);
    if (!frame.at_identity) {
      for (Vec3& corner : corners) corner = scene::to_world(frame, corner);
    }
    collector.add(corners, candidate.row, static_cast<std::int32_t>(candidate.primitive));
  }
  return collector.chain();
}

/// A point of the plane near the scene, so that p keeps its digits at survey coordinates. Moved
/// along one axis only: a plane across an axis passes through exactly the offset it was given.
Vec3 anchor_near(const Plane& plane, const Vec3& origin) {
  Eigen::Index axis = 0;
  plane.normal().cwiseAbs().maxCoeff(&axis);
  Vec3 rest = origin;
  rest[axis] = 0.0;
  rest[axis] = (plane.offset() - plane.normal().dot(rest)) / plane.normal()[axis];
  return rest;
}

}  // namespace

std::vector<Polyline> Scene::section(const Plane& plane) const {
  const scene::LocalFrame& frame =
      instances_ ? static_cast<const scene::LocalFrame&>(*instances_) : *hierarchy_;
  const Cutter cutter(plane.normal(), anchor_near(plane, frame.origin));
  return instances_ ? cut_scene(cutter, *instances_) : cut_scene(cutter, *hierarchy_);
}

std::vector<Polyline> Scene::section(const Vec3& a, const Vec3& b, const Vec3& up) const {
  const Cutter cutter = Cutter::between(a, b, up);
  return instances_ ? cut_scene(cutter, *instances_) : cut_scene(cutter, *hierarchy_);
}

}  // namespace bathyal
