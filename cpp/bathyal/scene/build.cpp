// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/scene/internal/cells.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/wide_tree.hpp"

namespace bathyal {
namespace scene {
namespace {

constexpr std::size_t kGrain = 16384;  ///< triangles of one task

struct Extent {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  Extent& operator+=(const Extent& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
    return *this;
  }
};

/// Box of all triangles in the world. Vertices that no triangle uses do not count: a stray one far
/// away would cost the local frame its digits.
Extent extent_of(const std::vector<TriangleMesh>& meshes, int num_threads) {
  Extent total;
  for (const TriangleMesh& mesh : meshes) {
    const double* vertices = mesh.vertices().data();
    const std::int32_t* index = mesh.triangles().data();
    total += parallel_sum<Extent>(
        static_cast<std::size_t>(mesh.triangle_count()), kGrain, num_threads,
        [&](std::size_t begin, std::size_t end) {
          Extent part;
          for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
            const Vec3 p = Eigen::Map<const Vec3>(vertices + 3 * std::int64_t{index[i]});
            part.low = part.low.cwiseMin(p);
            part.high = part.high.cwiseMax(p);
          }
          return part;
        });
  }
  return total;
}

/// Writes one lane of a block; returns the longer of |e1|₁ and |e2|₁, not rounded down.
float fill_lane(const Scene::Hierarchy& hierarchy, std::uint32_t primitive, TriangleBlock& block,
                int lane) {
  const auto [v0, v1, v2] = hierarchy.corners(primitive);
  const Vec3 e1 = v1 - v0;
  const Vec3 e2 = v2 - v0;
  for (int axis = 0; axis < 3; ++axis) {
    block.v0[axis][lane] = static_cast<float>(v0[axis] - hierarchy.origin[axis]);
    block.e1[axis][lane] = static_cast<float>(e1[axis]);
    block.e2[axis][lane] = static_cast<float>(e2[axis]);
  }
  block.primitive[lane] = primitive;
  return static_cast<float>(1.000001 * std::max(e1.lpNorm<1>(), e2.lpNorm<1>()));
}

float fill_block(const Scene::Hierarchy& hierarchy, const Box* items, std::uint32_t count,
                 TriangleBlock& block) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  float edge = 0.0F;
  for (int lane = 0; lane < kWidth; ++lane) {
    if (lane < static_cast<int>(count)) {
      edge = std::max(edge, fill_lane(hierarchy, items[lane].second_tag(), block, lane));
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      block.v0[axis][lane] = block.e1[axis][lane] = block.e2[axis][lane] = kNan;
    }
    block.primitive[lane] = kNoPrimitive;
  }
  return edge;
}

void fill_node(Scene::Hierarchy& hierarchy, const BinaryTree& tree, const WidePlan& plan,
               WideNode& node) {
  fill_boxes(tree, plan, node);
  for (int lane = 0; lane < kWidth; ++lane) {
    const std::int32_t child = plan.child[lane];
    if (child >= 0 || child == kNoChild) continue;
    const BinaryNode& source = tree.nodes[plan.source[lane]];
    node.edge[lane] = fill_block(hierarchy, tree.items.data() + source.first_item(),
                                 source.item_count(), hierarchy.blocks[~child]);
  }
}

void check_reach(const Extent& extent) {
  const double reach = 0.5 * (extent.high - extent.low).maxCoeff();
  if (!(reach <= kLargestReach)) {
    throw_argument("meshes", "triangles within 1e12 m of their middle", to_text(reach) + " m");
  }
}

}  // namespace
}  // namespace scene

Scene::Hierarchy::Hierarchy(std::vector<TriangleMesh> given, int num_threads)
    : meshes(std::move(given)) {
  resolve_threads(num_threads);  // refuses a negative number even where there is nothing to build
  std::uint64_t count = 0;
  for (const TriangleMesh& mesh : meshes) {
    arrays.push_back(
        {mesh.vertices().data(), mesh.triangles().data(), static_cast<std::uint32_t>(count)});
    count += static_cast<std::uint64_t>(mesh.triangle_count());
    if (count >= scene::kNoPrimitive) {
      throw_argument("meshes", "fewer than 4294967295 triangles together", std::to_string(count));
    }
  }
  primitive_count = static_cast<std::uint32_t>(count);
  if (primitive_count == 0) return;

  const scene::Extent extent = scene::extent_of(meshes, num_threads);
  scene::check_reach(extent);
  origin = (0.5 * extent.low + 0.5 * extent.high).array().round();
  low = extent.low - origin;
  high = extent.high - origin;

  const scene::BinaryTree tree =
      scene::build_binary_tree(scene::sort_into_cells(*this, num_threads), num_threads);
  const scene::Plan plan = scene::plan_wide_nodes(tree.nodes);
  nodes = PageArray<scene::WideNode>(plan.nodes.size());
  blocks = PageArray<scene::TriangleBlock>(plan.leaves.size());
  parallel_for(plan.nodes.size(), 256, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      scene::fill_node(*this, tree, plan.nodes[i], nodes[i]);
    }
  });
}

}  // namespace bathyal
