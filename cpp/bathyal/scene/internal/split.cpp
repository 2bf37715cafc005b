// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/split.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "bathyal/scene/internal/nodes.hpp"

namespace bathyal::scene {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kBlock = kWidth;
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Items [first, first + count), their box, and the box of their (doubled) middles.
struct Range {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Box box;
  Box middles;

  void add(const Box& item) {
    box.add(item);
    const Float4 middle = twice_middle(item);
    middles.low = min4(middles.low, middle);
    middles.high = max4(middles.high, middle);
  }
};

/// Maps a middle to its bin on each axis.
struct Binning {
  Float4 base;
  Float4 scale;
  int bins;

  explicit Binning(const Range& range)
      : base(range.middles.low),
        bins(static_cast<int>(std::min<std::uint32_t>(kBins, 4 + range.count / 4))) {
    const Float4 extent = range.middles.high - range.middles.low;
    for (int axis = 0; axis < 3; ++axis) {
      // A little below the number of bins, so that the last middle falls into the last bin.
      const float s = 0.9999F * static_cast<float>(bins) / extent[axis];
      scale[axis] = extent[axis] > 0.0F && s < kInf ? s : 0.0F;
    }
    scale[3] = 0.0F;
    base[3] = 0.0F;
  }

  Int4 operator()(const Box& item) const {
    return __builtin_convertvector((twice_middle(item) - base) * scale, Int4);
  }
};

struct Cut {
  float cost = kInf;
  int axis = -1;  ///< −1: no cut separates the items
  int bin = 0;    ///< last bin of the left side
};

float blocks(std::uint32_t triangles) {
  return static_cast<float>((triangles + kBlock - 1) / kBlock);
}

/// The cheapest cut between bins along one axis.
void try_axis(int axis, int bin_count, const Box* box, const std::uint32_t* weight, Cut& best) {
  float right_cost[kBins];
  Box side;
  std::uint32_t triangles = 0;
  for (int b = bin_count - 1; b > 0; --b) {
    side.add(box[b]);
    triangles += weight[b];
    right_cost[b] = triangles == 0 ? kInf : side.area() * blocks(triangles);
  }
  side = Box();
  triangles = 0;
  for (int b = 0; b + 1 < bin_count; ++b) {
    side.add(box[b]);
    triangles += weight[b];
    if (triangles == 0) continue;
    const float cost = side.area() * blocks(triangles) + right_cost[b + 1];
    if (cost < best.cost) best = {cost, axis, b};
  }
}

Cut best_cut(const Box* items, const Range& range, const Binning& binning) {
  Box box[3][kBins];
  std::uint32_t weight[3][kBins] = {};
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    const Int4 bin = binning(items[i]);
    const std::uint32_t triangles = items[i].first_tag();
    for (int axis = 0; axis < 3; ++axis) {
      box[axis][bin[axis]].add(items[i]);
      weight[axis][bin[axis]] += triangles;
    }
  }
  Cut best;
  for (int axis = 0; axis < 3; ++axis) {
    if (binning.scale[axis] > 0.0F) {
      try_axis(axis, binning.bins, box[axis], weight[axis], best);
    }
  }
  return best;
}

class Splitter {
 public:
  Splitter(Box* items, std::uint32_t leaf_items, std::vector<BinaryNode>& nodes)
      : items_(items), leaf_items_(leaf_items), nodes_(nodes) {}

  void split(std::uint32_t node, const Range& range, int depth) {
    nodes_[node].box = range.box;
    if (range.count <= leaf_items_) {
      nodes_[node].box.set_tags(range.first, range.count);
      return;
    }
    Range left;
    Range right;
    const Binning binning(range);
    const Cut cut = depth < kAreaDepth ? best_cut(items_, range, binning) : Cut{};
    if (cut.axis >= 0) {
      partition(range, binning, cut, left, right);
    } else {
      halve(range, left, right);
    }
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].box.set_tags(child, 0);
    nodes_.resize(nodes_.size() + 2);
    split(child, left, depth + 1);
    split(child + 1, right, depth + 1);
  }

 private:
  void partition(const Range& range, const Binning& binning, const Cut& cut, Range& left,
                 Range& right) {
    std::uint32_t i = range.first;
    std::uint32_t j = range.first + range.count;
    while (true) {
      while (i < j && binning(items_[i])[cut.axis] <= cut.bin) left.add(items_[i++]);
      while (i < j && binning(items_[j - 1])[cut.axis] > cut.bin) right.add(items_[--j]);
      if (i >= j) break;
      std::swap(items_[i], items_[j - 1]);
    }
    left.first = range.first;
    left.count = i - range.first;
    right.first = i;
    right.count = range.count - left.count;
  }

  /// Where no cut helps (all middles equal, or the tree is deep already): half of the items each.
  void halve(const Range& range, Range& left, Range& right) {
    left.first = range.first;
    left.count = range.count / 2;
    right.first = range.first + left.count;
    right.count = range.count - left.count;
    for (std::uint32_t i = 0; i < left.count; ++i) left.add(items_[left.first + i]);
    for (std::uint32_t i = 0; i < right.count; ++i) right.add(items_[right.first + i]);
  }

  Box* items_;
  std::uint32_t leaf_items_;
  std::vector<BinaryNode>& nodes_;
};

}  // namespace

void split_by_area(Box* items, std::uint32_t first, std::uint32_t count, std::uint32_t leaf_items,
                   std::vector<BinaryNode>& nodes, std::uint32_t root) {
  Range range;
  range.first = first;
  range.count = count;
  for (std::uint32_t i = first; i < first + count; ++i) range.add(items[i]);
  Splitter(items, leaf_items, nodes).split(root, range, 0);
}

}  // namespace bathyal::scene
