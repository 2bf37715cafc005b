// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "bathyal/soundings/internal/clean_steps.hpp"

namespace bathyal::soundings {

/// The nearest soundings to each sounding, in plan (kDimensions 2) or in space (3).
///
/// A k-d tree whose leaves all lie at one depth: a node over [begin, end) is split at its middle,
/// by rank and not by value, so that equal coordinates do not matter, and node i has the children
/// 2i + 1 and 2i + 2. Built level by level in parallel, the same for any number of threads.
template <int kDimensions>
class Neighbours {
 public:
  static constexpr int kMost = 64;

  Neighbours(const Soundings& soundings, int num_threads);

  /// Squared distances, ascending, and z of the nearest soundings but itself.
  struct Found {
    int count = 0;
    std::array<double, kMost> squared;
    std::array<double, kMost> z;
  };

  /// Calls `use(i, found)` for every sounding i with its up to `count` nearest neighbours; fewer
  /// where there are no more.
  void for_each(int count, int num_threads,
                const std::function<void(std::size_t, const Found&)>& use) const;

 private:
  struct Point {
    std::array<double, 3> at;
    std::uint32_t index;
  };
  struct Node {
    double value = 0.0;
    int axis = 0;
  };

  void split(std::size_t node, std::size_t begin, std::size_t end);
  void search(const Point& query, int count, std::size_t node, std::size_t begin, std::size_t end,
              int depth, Found& found) const;
  void look_at(const Point& query, int count, const Point& candidate, Found& found) const;

  std::vector<Point> points_;
  std::vector<Node> nodes_;
  int depth_ = 0;
};

extern template class Neighbours<2>;
extern template class Neighbours<3>;

}  // namespace bathyal::soundings
