// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/neighbours.hpp"

#include <algorithm>

#include "bathyal/base/parallel.hpp"

namespace bathyal::soundings {
namespace {

constexpr std::size_t kLeaf = 12;
constexpr std::size_t kQueries = 1024;  ///< answered by one thread in one go

std::size_t middle_of(std::size_t begin, std::size_t end) { return begin + (end - begin) / 2; }

}  // namespace

template <int kDimensions>
Neighbours<kDimensions>::Neighbours(const Soundings& soundings, int num_threads) {
  points_.reserve(soundings.size());
  for (const Sounding& s : soundings) {
    points_.push_back({{s.x, s.y, s.z}, static_cast<std::uint32_t>(points_.size())});
  }
  struct Range {
    std::size_t begin, end;
  };
  std::vector<Range> level{{0, points_.size()}};
  while ((points_.size() >> static_cast<unsigned>(depth_)) > kLeaf) {
    const std::size_t first = nodes_.size();
    nodes_.resize(first + level.size());
    parallel_for(level.size(), 1, num_threads, [&](std::size_t i, std::size_t) {
      split(first + i, level[i].begin, level[i].end);
    });
    std::vector<Range> next;
    next.reserve(2 * level.size());
    for (const Range& range : level) {
      const std::size_t middle = middle_of(range.begin, range.end);
      next.push_back({range.begin, middle});
      next.push_back({middle, range.end});
    }
    level.swap(next);
    ++depth_;
  }
}

/// Puts the lower half along the widest axis in front.
template <int kDimensions>
void Neighbours<kDimensions>::split(std::size_t node, std::size_t begin, std::size_t end) {
  int axis = 0;
  double widest = -1.0;
  for (int a = 0; a < kDimensions; ++a) {
    double low = points_[begin].at[a];
    double high = low;
    for (std::size_t i = begin; i < end; ++i) {
      low = std::min(low, points_[i].at[a]);
      high = std::max(high, points_[i].at[a]);
    }
    if (high - low > widest) {
      widest = high - low;
      axis = a;
    }
  }
  Point* const data = points_.data();
  Point* const middle = data + middle_of(begin, end);
  std::nth_element(data + begin, middle, data + end,
                   [axis](const Point& a, const Point& b) { return a.at[axis] < b.at[axis]; });
  nodes_[node] = {middle->at[axis], axis};
}

template <int kDimensions>
void Neighbours<kDimensions>::look_at(const Point& query, int count, const Point& candidate,
                                      Found& found) const {
  double squared = 0.0;
  for (int a = 0; a < kDimensions; ++a) {
    const double off = candidate.at[a] - query.at[a];
    squared += off * off;
  }
  if (found.count == count && squared >= found.squared[count - 1]) return;
  if (candidate.index == query.index) return;
  int place = found.count < count ? found.count++ : count - 1;
  for (; place > 0 && found.squared[place - 1] > squared; --place) {
    found.squared[place] = found.squared[place - 1];
    found.z[place] = found.z[place - 1];
  }
  found.squared[place] = squared;
  found.z[place] = candidate.at[2];
}

template <int kDimensions>
void Neighbours<kDimensions>::search(const Point& query, int count, std::size_t node,
                                     std::size_t begin, std::size_t end, int depth,
                                     Found& found) const {
  if (depth == depth_) {
    for (std::size_t i = begin; i < end; ++i) look_at(query, count, points_[i], found);
    return;
  }
  const double off = query.at[nodes_[node].axis] - nodes_[node].value;
  const std::size_t middle = middle_of(begin, end);
  const auto lower = [&] { search(query, count, 2 * node + 1, begin, middle, depth + 1, found); };
  const auto upper = [&] { search(query, count, 2 * node + 2, middle, end, depth + 1, found); };
  const auto reaches = [&] { return found.count < count || off * off < found.squared[count - 1]; };
  if (off < 0.0) {
    lower();
    if (reaches()) upper();
  } else {
    upper();
    if (reaches()) lower();
  }
}

template <int kDimensions>
void Neighbours<kDimensions>::for_each(
    int count, int num_threads, const std::function<void(std::size_t, const Found&)>& use) const {
  // In the order of the tree: consecutive queries are neighbours and find the same nodes in cache.
  parallel_for(points_.size(), kQueries, num_threads, [&](std::size_t begin, std::size_t end) {
    Found found;
    for (std::size_t i = begin; i < end; ++i) {
      found.count = 0;
      search(points_[i], count, 0, 0, points_.size(), 0, found);
      use(points_[i].index, found);
    }
  });
}

template class Neighbours<2>;
template class Neighbours<3>;

}  // namespace bathyal::soundings
