// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/base/page_array.hpp"
#include "bathyal/scene/internal/cells.hpp"
#include "bathyal/scene/internal/nodes.hpp"
#include "bathyal/scene/internal/split.hpp"

// From boxes sorted into cells to nodes of eight, for trees over triangles and over instances.

namespace bathyal::scene {

/// The binary tree over all items; a leaf holds up to eight.
struct BinaryTree {
  PageArray<Box> items;
  std::vector<BinaryNode> nodes;  ///< nodes[0] is the root
};

/// Each cell's own tree in parallel, then one over the cells.
BinaryTree build_binary_tree(SortedBoxes boxes, int num_threads);

/// Which binary nodes become the children of a wide node.
struct WidePlan {
  std::uint32_t source[kWidth];
  std::int32_t child[kWidth];  ///< as in WideNode: ~ the number of a leaf
};

struct Plan {
  std::vector<WidePlan> nodes;
  std::vector<std::uint32_t> leaves;  ///< the binary node of each
};

/// Numbers wide nodes and leaves, both so that what hangs under one node lies together.
Plan plan_wide_nodes(const std::vector<BinaryNode>& nodes);

/// Sets the node's children and their boxes, edges to 0.
void fill_boxes(const BinaryTree& tree, const WidePlan& plan, WideNode& node);

/// Puts a box into one lane of a node.
void set_lane(WideNode& node, int lane, const Box& box, std::int32_t child);

/// A lane without a child.
void clear_lane(WideNode& node, int lane);

}  // namespace bathyal::scene
