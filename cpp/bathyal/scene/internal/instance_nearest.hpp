// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

#include "bathyal/scene/internal/instances.hpp"
#include "bathyal/scene/internal/nearest_walk.hpp"

namespace bathyal::scene {

/// What lies nearest to a query among instances: a walk down the tree over their boxes, nearest
/// first, and in each that may come nearer a NearestWalk in its mesh's frame, where distances are
/// shorter by its scale. `Query` is as NearestWalk has it, in the world.
template <class Query>
class InstanceNearest {
 public:
  using Found = typename Query::Found;

  InstanceNearest(const Scene::Instances& instances, const Query& query, double within)
      : instances_(instances),
        query_(query),
        within_(within),
        distance_(within),
        limit_(query.limit(within)) {}

  /// `query_in(hierarchy, frame)` is the query in an instance's frame.
  template <class QueryIn>
  void run(const QueryIn& query_in) {
    if (instances_.nodes.empty()) return;
    stack_[depth_++] = {0.0F, 0};
    while (depth_ > 0) {
      const Waiting top = stack_[--depth_];
      if (top.bound > limit_) continue;
      if (top.item < 0) {
        look_into(~top.item, query_in);
      } else {
        open(instances_.nodes[static_cast<std::size_t>(top.item)]);
      }
    }
  }

  /// −1 where nothing was found.
  std::int32_t row() const { return row_; }
  std::uint32_t triangle() const { return triangle_; }
  double distance() const { return distance_; }

  /// In the frame of the row's mesh.
  const Found& found() const { return best_; }

 private:
  /// A node, or ~row, that may hold something nearer.
  struct Waiting {
    float bound;
    std::int32_t item;
  };

  void open(const WideNode& node) {
    LaneDistances bounds;
    query_.bound(node, bounds);
    const std::size_t first = depth_;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      if (node.child[lane] == kNoChild || bounds[lane] > limit_) continue;
      std::size_t at = depth_++;
      for (; at > first && stack_[at - 1].bound < bounds[lane]; --at) stack_[at] = stack_[at - 1];
      stack_[at] = {bounds[lane], node.child[lane]};
    }
  }

  template <class QueryIn>
  void look_into(std::int32_t row, const QueryIn& query_in) {
    constexpr double kRounding = 1.0 + 0x1p-46;  // equal distances are looked at too
    const InstanceFrame& frame = instances_.frame(row);
    const Scene::Hierarchy& hierarchy = instances_.hierarchy(row);
    NearestWalk walk(hierarchy, query_in(hierarchy, frame),
                     distance_ * frame.per_metre * kRounding);
    walk.run();
    if (walk.primitive() == kNoPrimitive) return;
    const double squared = frame.scale * frame.scale * walk.found().squared_distance;
    const double distance = frame.scale * std::sqrt(walk.found().squared_distance);
    if (distance > within_) return;
    if (row_ >= 0 && std::tie(squared, row) >= std::tie(squared_, row_)) return;
    squared_ = squared;
    distance_ = distance;
    row_ = row;
    triangle_ = walk.primitive();
    best_ = walk.found();
    limit_ = query_.limit(distance);
  }

  const Scene::Instances& instances_;
  Query query_;
  double within_;
  double distance_;  ///< of what was found, else `within` [m]
  double squared_ = std::numeric_limits<double>::infinity();
  float limit_;
  std::int32_t row_ = -1;
  std::uint32_t triangle_ = kNoPrimitive;
  Found best_{std::numeric_limits<double>::infinity()};
  std::array<Waiting, kStackSize> stack_;
  std::size_t depth_ = 0;
};

}  // namespace bathyal::scene
