// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include "bathyal/scene/internal/cut.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/prefetch.hpp"
#include "bathyal/scene/internal/slab_filter.hpp"

namespace bathyal {
namespace {

using scene::Cutter;
using scene::SlabFilter;

/// Largest coordinate of the scene in the world [m].
double reach_of(const Scene::Hierarchy& hierarchy) {
  return scene::reach(hierarchy.origin) + hierarchy.reach();
}

/// The blocks whose boxes the section may cut. Breadth first: by the time a node is looked at its
/// prefetch is long complete.
std::vector<std::int32_t> find_blocks(const Cutter& cutter, const Scene::Hierarchy& hierarchy,
                                      const SlabFilter& height) {
  const SlabFilter along =
      cutter.has_strip()
          ? SlabFilter(hierarchy, cutter.along(), cutter.anchor(), cutter.along().stableNorm(),
                       cutter.along_slack(reach_of(hierarchy)))
          : height;
  std::vector<std::int32_t> blocks;
  std::vector<std::int32_t> nodes = {0};
  for (std::size_t next = 0; next < nodes.size(); ++next) {
    const scene::WideNode& node = hierarchy.nodes[static_cast<std::size_t>(nodes[next])];
    scene::for_each_lane((height.filter(node) & along.filter(node)).bits(), [&](int lane) {
      const std::int32_t child = node.child[lane];
      if (child < 0) {
        blocks.push_back(~child);
      } else {
        nodes.push_back(child);
        scene::prefetch(hierarchy.nodes[static_cast<std::size_t>(child)]);
      }
    });
  }
  return blocks;
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
std::vector<std::uint32_t> find_candidates(const Cutter& cutter,
                                           const Scene::Hierarchy& hierarchy) {
  if (hierarchy.nodes.empty()) return {};
  const SlabFilter height(hierarchy, cutter.normal(), cutter.anchor(), 0.0,
                          cutter.height_slack(reach_of(hierarchy)));
  const std::vector<std::int32_t> blocks = find_blocks(cutter, hierarchy, height);
  const auto block = [&](std::size_t i) -> const scene::TriangleBlock& {
    return hierarchy.blocks[static_cast<std::size_t>(blocks[i])];
  };
  std::vector<std::uint32_t> candidates;
  candidates.reserve(scene::kWidth * blocks.size());
  fetching_ahead(
      blocks.size(), [&](std::size_t i) { scene::prefetch(block(i)); },
      [&](std::size_t i) {
        scene::for_each_lane(height.filter(block(i)).bits(),
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
  const std::vector<std::uint32_t> primitives = find_candidates(cutter, hierarchy);
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
  return cut_scene(Cutter(plane.normal(), anchor_near(plane, hierarchy_->origin)), *hierarchy_);
}

std::vector<Polyline> Scene::section(const Vec3& a, const Vec3& b, const Vec3& up) const {
  return cut_scene(Cutter::between(a, b, up), *hierarchy_);
}

}  // namespace bathyal
