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
#include "bathyal/scene/internal/split.hpp"

namespace bathyal {
namespace scene {
namespace {

constexpr double kLargestReach = 1e12;  ///< products of three lengths stay far from float's limit
constexpr std::size_t kGrain = 16384;   ///< triangles of one task

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

/// The binary tree over all triangles.
struct BinaryTree {
  PageArray<Box> items;
  std::vector<BinaryNode> nodes;  ///< nodes[0] is the root
};

/// Each cell's own tree in parallel, then one over the cells.
BinaryTree build_binary_tree(SortedBoxes boxes, int num_threads) {
  constexpr std::size_t kCellsPerTask = 16;
  const std::vector<Cell>& cells = boxes.cells;
  std::vector<std::vector<BinaryNode>> parts((cells.size() + kCellsPerTask - 1) / kCellsPerTask);
  parallel_for(cells.size(), kCellsPerTask, num_threads, [&](std::size_t begin, std::size_t end) {
    std::vector<BinaryNode>& part = parts[begin / kCellsPerTask];
    part.resize(end - begin);  // the roots come first
    for (std::size_t c = begin; c < end; ++c) {
      split_by_area(boxes.items.data(), cells[c].first, cells[c].count, kWidth, part,
                    static_cast<std::uint32_t>(c - begin));
    }
  });

  std::vector<Box> roots(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    roots[c] = parts[c / kCellsPerTask][c % kCellsPerTask].box;
    roots[c].set_tags(cells[c].count, static_cast<std::uint32_t>(c));
  }
  BinaryTree tree;
  tree.nodes.resize(1);
  split_by_area(roots.data(), 0, static_cast<std::uint32_t>(roots.size()), 1, tree.nodes, 0);

  // The leaves of the upper tree become the roots of the cells' trees.
  const std::size_t upper = tree.nodes.size();
  std::vector<std::uint32_t> base(parts.size());
  std::size_t total = upper;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    base[p] = static_cast<std::uint32_t>(total);
    total += parts[p].size();
  }
  const auto rebased = [&](std::size_t part, BinaryNode node) {
    if (!node.is_leaf()) node.box.set_tags(base[part] + node.left(), 0);
    return node;
  };
  for (BinaryNode& node : tree.nodes) {
    if (!node.is_leaf()) continue;
    const std::size_t cell = roots[node.first_item()].second_tag();
    const std::size_t part = cell / kCellsPerTask;
    node = rebased(part, parts[part][cell % kCellsPerTask]);
  }
  tree.nodes.resize(total);
  parallel_for(parts.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      for (std::size_t i = 0; i < parts[p].size(); ++i) {
        tree.nodes[base[p] + i] = rebased(p, parts[p][i]);
      }
    }
  });
  tree.items = std::move(boxes.items);
  return tree;
}

/// Which binary nodes become the children of a wide node.
struct WidePlan {
  std::uint32_t source[kWidth];
  std::int32_t child[kWidth];
};

struct Plan {
  std::vector<WidePlan> nodes;
  std::vector<std::uint32_t> blocks;  ///< the binary leaf of each block
};

/// Opens the widest of the children until there are eight of them, or only leaves.
int gather_children(const std::vector<BinaryNode>& nodes, std::uint32_t root,
                    std::uint32_t* source) {
  int count = 1;
  source[0] = root;
  while (count < kWidth) {
    int widest = -1;
    float area = -1.0F;
    for (int i = 0; i < count; ++i) {
      const BinaryNode& node = nodes[source[i]];
      if (!node.is_leaf() && node.box.area() > area) {
        area = node.box.area();
        widest = i;
      }
    }
    if (widest < 0) break;
    const std::uint32_t left = nodes[source[widest]].left();
    source[widest] = left;
    source[count++] = left + 1;
  }
  return count;
}

/// Numbers wide nodes and blocks, both so that what hangs under one node lies together.
Plan plan_wide_nodes(const std::vector<BinaryNode>& nodes) {
  Plan plan;
  std::vector<std::pair<std::uint32_t, std::size_t>> waiting{{0U, 0U}};  // binary node, wide node
  plan.nodes.resize(1);
  while (!waiting.empty()) {
    const auto [root, wide] = waiting.back();
    waiting.pop_back();
    WidePlan entry;
    std::fill_n(entry.child, kWidth, kNoChild);
    const int count = gather_children(nodes, root, entry.source);
    const std::size_t first_waiting = waiting.size();
    for (int i = 0; i < count; ++i) {
      if (nodes[entry.source[i]].is_leaf()) {
        entry.child[i] = ~static_cast<std::int32_t>(plan.blocks.size());
        plan.blocks.push_back(entry.source[i]);
      } else {
        entry.child[i] = static_cast<std::int32_t>(plan.nodes.size());
        waiting.emplace_back(entry.source[i], plan.nodes.size());
        plan.nodes.emplace_back();
      }
    }
    std::reverse(waiting.begin() + static_cast<std::ptrdiff_t>(first_waiting), waiting.end());
    plan.nodes[wide] = entry;
  }
  return plan;
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
  constexpr float kInf = std::numeric_limits<float>::infinity();
  for (int lane = 0; lane < kWidth; ++lane) {
    const std::int32_t child = node.child[lane] = plan.child[lane];
    node.edge[lane] = 0.0F;
    if (child == kNoChild) {
      for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][lane] = kInf;
        node.high[axis][lane] = -kInf;
      }
      continue;
    }
    const BinaryNode& source = tree.nodes[plan.source[lane]];
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][lane] = source.box.low[axis];
      node.high[axis][lane] = source.box.high[axis];
    }
    if (child < 0) {
      node.edge[lane] = fill_block(hierarchy, tree.items.data() + source.first_item(),
                                   source.item_count(), hierarchy.blocks[~child]);
    }
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
  blocks = PageArray<scene::TriangleBlock>(plan.blocks.size());
  parallel_for(plan.nodes.size(), 256, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      scene::fill_node(*this, tree, plan.nodes[i], nodes[i]);
    }
  });
}

}  // namespace bathyal
