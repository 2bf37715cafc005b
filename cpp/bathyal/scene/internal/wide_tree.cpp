// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/wide_tree.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "bathyal/base/parallel.hpp"

namespace bathyal::scene {
namespace {

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

}  // namespace

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
        entry.child[i] = ~static_cast<std::int32_t>(plan.leaves.size());
        plan.leaves.push_back(entry.source[i]);
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

void set_lane(WideNode& node, int lane, const Box& box, std::int32_t child) {
  for (int axis = 0; axis < 3; ++axis) {
    node.low[axis][lane] = box.low[axis];
    node.high[axis][lane] = box.high[axis];
  }
  node.child[lane] = child;
  node.edge[lane] = 0.0F;
}

void clear_lane(WideNode& node, int lane) { set_lane(node, lane, Box(), kNoChild); }

void fill_boxes(const BinaryTree& tree, const WidePlan& plan, WideNode& node) {
  for (int lane = 0; lane < kWidth; ++lane) {
    if (plan.child[lane] == kNoChild) {
      clear_lane(node, lane);
    } else {
      set_lane(node, lane, tree.nodes[plan.source[lane]].box, plan.child[lane]);
    }
  }
}

}  // namespace bathyal::scene
