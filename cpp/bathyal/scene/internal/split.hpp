// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/scene/internal/boxes.hpp"

namespace bathyal::scene {

/// A node of the binary tree: its box, and in the tags either (number of the left child, 0), the
/// right child being the next, or (first item, number of items) of a leaf.
struct BinaryNode {
  Box box;

  bool is_leaf() const { return box.second_tag() != 0; }
  std::uint32_t left() const { return box.first_tag(); }
  std::uint32_t first_item() const { return box.first_tag(); }
  std::uint32_t item_count() const { return box.second_tag(); }
};

/// Deepest that one call of split_by_area can go, below its root: kAreaDepth levels by area and
/// then halves.
inline constexpr int kAreaDepth = 32;

/// Splits items[first, first + count) into a binary tree and reorders them so that every leaf's
/// items are neighbours. Splits by the surface area heuristic over bins (Wald 2007), the cost of a
/// side being its area times the blocks of eight triangles that it needs. An item's first tag is
/// how many triangles it contains; the second tag is the owner's. The root goes to nodes[root],
/// which exists; other nodes are appended. A range of `leaf_items` or fewer is a leaf.
/// Pure function of the items: no threads, no randomness.
void split_by_area(Box* items, std::uint32_t first, std::uint32_t count, std::uint32_t leaf_items,
                   std::vector<BinaryNode>& nodes, std::uint32_t root);

}  // namespace bathyal::scene
