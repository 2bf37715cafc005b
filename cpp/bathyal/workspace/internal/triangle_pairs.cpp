// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/triangle_pairs.hpp"

#include <algorithm>
#include <numeric>

#include "bathyal/base/parallel.hpp"

namespace bathyal::workspace {
namespace {

using Box = Eigen::AlignedBox3d;
using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Triangles order[begin, end); children at `left` and left + 1, or none where it is 0.
struct Node {
  Box box;
  std::int32_t begin = 0, end = 0, left = 0;
};

/// Halves by the middle triangle along the longest side, so that the depth is log2 of their number.
class BoxTree {
 public:
  explicit BoxTree(const WeldedMesh& mesh) : boxes(mesh.triangles.size()) {
    for (std::size_t t = 0; t < boxes.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) boxes[t].extend(mesh.corner(t, c));
    }
    order.resize(boxes.size());
    std::iota(order.begin(), order.end(), 0);
    nodes.push_back(node(0, static_cast<std::int32_t>(order.size())));
    for (std::size_t n = 0; n < nodes.size(); ++n) split(n);
  }

  std::vector<Box> boxes;  ///< of the triangles
  std::vector<std::int32_t> order;
  std::vector<Node> nodes;

 private:
  static constexpr std::int32_t kLeaf = 4;

  Node node(std::int32_t begin, std::int32_t end) const {
    Node made{{}, begin, end, 0};
    for (std::int32_t i = begin; i < end; ++i) {
      made.box.extend(boxes[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])]);
    }
    return made;
  }

  void split(std::size_t n) {
    const Node parent = nodes[n];
    if (parent.end - parent.begin <= kLeaf) return;
    Index axis = 0;
    parent.box.sizes().maxCoeff(&axis);
    const std::int32_t middle = (parent.begin + parent.end) / 2;
    const auto centre = [&](std::int32_t t) {
      const Box& box = boxes[static_cast<std::size_t>(t)];
      return box.min()[axis] + box.max()[axis];
    };
    std::nth_element(order.begin() + parent.begin, order.begin() + middle,
                     order.begin() + parent.end, [&](std::int32_t a, std::int32_t b) {
                       return std::pair(centre(a), a) < std::pair(centre(b), b);
                     });
    nodes[n].left = static_cast<std::int32_t>(nodes.size());
    const Node left = node(parent.begin, middle), right = node(middle, parent.end);
    nodes.push_back(left);
    nodes.push_back(right);
  }
};

/// Pairs of one triangle with those of higher number.
void find_partners(const WeldedMesh& mesh, const BoxTree& tree, std::int32_t triangle,
                   Pairs& pairs) {
  const Box& box = tree.boxes[static_cast<std::size_t>(triangle)];
  std::array<std::int32_t, 128> stack;  // two a level of a tree no deeper than 32
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = tree.nodes[static_cast<std::size_t>(stack[--depth])];
    if (!node.box.intersects(box)) continue;
    if (node.left != 0) {
      stack[depth++] = node.left;
      stack[depth++] = node.left + 1;
      continue;
    }
    for (std::int32_t i = node.begin; i < node.end; ++i) {
      const std::int32_t other = tree.order[static_cast<std::size_t>(i)];
      if (other <= triangle || !tree.boxes[static_cast<std::size_t>(other)].intersects(box)) {
        continue;
      }
      if (intersect(mesh, static_cast<std::size_t>(triangle), static_cast<std::size_t>(other))) {
        pairs.emplace_back(triangle, other);
      }
    }
  }
}

}  // namespace

Pairs intersecting_pairs(const WeldedMesh& mesh, int num_threads) {
  if (mesh.triangles.empty()) return {};
  const BoxTree tree(mesh);
  constexpr std::size_t kGrain = 512;
  const std::size_t count = mesh.triangles.size();
  std::vector<Pairs> chunks((count + kGrain - 1) / kGrain);
  parallel_for(count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      find_partners(mesh, tree, static_cast<std::int32_t>(t), chunks[begin / kGrain]);
    }
  });
  Pairs all;
  for (const Pairs& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace bathyal::workspace
