// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/nearness.hpp"
#include "bathyal/scene/internal/prefetch.hpp"

namespace bathyal::scene {

/// One query's way through the hierarchy to what lies nearest, depth first, nearest child first.
/// Whatever may still hold an equal distance is looked at, since the lowest number wins a tie.
///
/// `Query` has `bound(lanes, bounds)` for nodes and blocks, `limit(distance)` (the largest bound of
/// what is within that distance), and `measure(corners)`, a `Query::Found` with the
/// `squared_distance` that decides.
template <class Query>
class NearestWalk {
 public:
  using Found = typename Query::Found;

  /// Considers nothing further away than `within` [m].
  NearestWalk(const Scene::Hierarchy& hierarchy, const Query& query,
              double within = std::numeric_limits<double>::infinity())
      : hierarchy_(hierarchy), query_(query), within_(within), limit_(query.limit(within)) {}

  void run() {
    if (hierarchy_.nodes.empty()) return;
    stack_[depth_++] = {0.0F, 0};
    while (depth_ > 0) {
      const Waiting top = stack_[--depth_];
      if (top.bound > limit_) continue;
      if (top.item < 0) {
        look_at(hierarchy_.blocks[static_cast<std::size_t>(~top.item)]);
      } else {
        open(hierarchy_.nodes[static_cast<std::size_t>(top.item)]);
      }
    }
  }

  /// kNoPrimitive where nothing was found.
  std::uint32_t primitive() const { return primitive_; }
  const Found& found() const { return best_; }

 private:
  /// A node, or ~block, that may hold something nearer.
  struct Waiting {
    float bound;
    std::int32_t item;
  };

  /// Pushes the children that may hold something nearer, the nearest on top.
  void open(const WideNode& node) {
    LaneDistances bounds;
    query_.bound(node, bounds);
    const std::size_t first = depth_;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      const std::int32_t child = node.child[lane];
      if (bounds[lane] > limit_ || child == kNoChild) continue;
      if (child < 0) {
        prefetch(hierarchy_.blocks[static_cast<std::size_t>(~child)]);
      } else {
        prefetch(hierarchy_.nodes[static_cast<std::size_t>(child)]);
      }
      std::size_t at = depth_++;
      for (; at > first && stack_[at - 1].bound < bounds[lane]; --at) stack_[at] = stack_[at - 1];
      stack_[at] = {bounds[lane], child};
    }
  }

  /// Measures the block's triangles, the one with the least bound first.
  void look_at(const TriangleBlock& block) {
    struct Candidate {
      float bound;
      std::uint32_t primitive;
    };
    LaneDistances bounds;
    query_.bound(block, bounds);
    std::array<Candidate, kWidth> candidates;
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      const std::uint32_t primitive = block.primitive[lane];
      if (primitive == kNoPrimitive) break;
      if (bounds[lane] > limit_) continue;
      prefetch_three(hierarchy_.row(primitive).index);
      std::size_t at = count++;
      for (; at > 0 && candidates[at - 1].bound > bounds[lane]; --at) {
        candidates[at] = candidates[at - 1];
      }
      candidates[at] = {bounds[lane], primitive};
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Scene::Hierarchy::Row row = hierarchy_.row(candidates[i].primitive);
      for (int c = 0; c < 3; ++c) prefetch_three(row.corner(c));
    }
    for (std::size_t i = 0; i < count && candidates[i].bound <= limit_; ++i) {
      measure(candidates[i].primitive);
    }
  }

  void measure(std::uint32_t primitive) {
    const Found found = query_.measure(hierarchy_.corners(primitive));
    if (std::tie(found.squared_distance, primitive) >= std::tie(best_.squared_distance, primitive_))
      return;
    const double distance = std::sqrt(found.squared_distance);
    if (distance > within_) return;
    best_ = found;
    primitive_ = primitive;
    limit_ = query_.limit(distance);
  }

  const Scene::Hierarchy& hierarchy_;
  Query query_;
  double within_;
  Found best_{std::numeric_limits<double>::infinity()};
  std::uint32_t primitive_ = kNoPrimitive;
  float limit_;
  std::array<Waiting, kStackSize> stack_;
  std::size_t depth_ = 0;
};

}  // namespace bathyal::scene
