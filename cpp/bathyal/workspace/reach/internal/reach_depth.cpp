// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/internal/reach_depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bathyal/base/parallel.hpp"

namespace bathyal::workspace {
namespace {

/// Of a row of squared distances f: the least f[j] + (i − j)² of each i, the lower envelope of
/// parabolas (Felzenszwalb, Huttenlocher 2012). What lies beyond both ends counts as 0.
void transform_row(std::vector<double>& f, std::vector<double>& out, std::vector<Index>& place,
                   std::vector<double>& border) {
  const auto n = static_cast<Index>(f.size());
  place.resize(f.size());
  border.resize(f.size() + 1);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Index k = -1;
  for (Index q = 0; q < n; ++q) {
    const auto Q = static_cast<std::size_t>(q);
    double from = -kInfinity;
    while (k >= 0) {
      const Index p = place[static_cast<std::size_t>(k)];
      const auto P = static_cast<std::size_t>(p);
      from = ((f[Q] + static_cast<double>(q * q)) - (f[P] + static_cast<double>(p * p))) /
             static_cast<double>(2 * (q - p));
      if (from > border[static_cast<std::size_t>(k)]) break;
      --k;
      from = -kInfinity;
    }
    ++k;
    place[static_cast<std::size_t>(k)] = q;
    border[static_cast<std::size_t>(k)] = from;
    border[static_cast<std::size_t>(k) + 1] = kInfinity;
  }
  Index at = 0;
  for (Index q = 0; q < n; ++q) {
    while (border[static_cast<std::size_t>(at) + 1] < static_cast<double>(q)) ++at;
    const Index p = place[static_cast<std::size_t>(at)];
    const auto end = static_cast<double>(std::min(q + 1, n - q));
    out[static_cast<std::size_t>(q)] = std::min(
        f[static_cast<std::size_t>(p)] + static_cast<double>((q - p) * (q - p)), end * end);
  }
}

}  // namespace

ReachDepth::ReachDepth(const ReachMap& map, int num_threads)
    : origin_(map.origin),
      low_(Vec3::Constant(std::numeric_limits<double>::infinity())),
      high_(-low_),
      voxel_(map.voxel),
      inverse_(1.0 / map.voxel),
      count_(map.count.cast<Index>()),
      size_(map.count.cast<double>()) {
  std::vector<double> squared(map.total());
  for (std::size_t v = 0; v < map.total(); ++v) {
    squared[v] = map.free[v] != 0 ? 1e12 : 0.0;
    if (map.free[v] == 0) continue;
    empty_ = false;
    low_ = low_.cwiseMin(map.middle(static_cast<Index>(v)));
    high_ = high_.cwiseMax(map.middle(static_cast<Index>(v)));
  }
  const Index stride[] = {count_[1] * count_[2], count_[2], 1};
  for (Index axis = 0; axis < 3; ++axis) {
    const Index a = (axis + 1) % 3;
    const Index b = (axis + 2) % 3;
    parallel_for(
        static_cast<std::size_t>(count_[a] * count_[b]), 64, num_threads,
        [&](std::size_t begin, std::size_t end) {
          std::vector<double> row(static_cast<std::size_t>(count_[axis])), out(row.size());
          std::vector<Index> place;
          std::vector<double> border;
          for (auto line = static_cast<Index>(begin); line < static_cast<Index>(end); ++line) {
            const Index first = line / count_[b] * stride[a] + line % count_[b] * stride[b];
            const auto cell = [&](std::size_t i) -> double& {
              return squared[static_cast<std::size_t>(first +
                                                      static_cast<Index>(i) * stride[axis])];
            };
            for (std::size_t i = 0; i < row.size(); ++i) row[i] = cell(i);
            transform_row(row, out, place, border);
            for (std::size_t i = 0; i < row.size(); ++i) cell(i) = out[i];
          }
        });
  }
  depth_.resize(squared.size());
  for (std::size_t v = 0; v < squared.size(); ++v) {
    depth_[v] = static_cast<float>(voxel_ * std::max(0.0, std::sqrt(squared[v]) - 0.5));
  }
}

double ReachDepth::at(const Vec3& point) const {
  const Eigen::Array3d x = ((point - origin_) * inverse_).array() - 0.5;
  if (!((x >= 0.0).all() && (x < size_ - 1.0).all())) return 0.0;
  const Eigen::Array<Index, 3, 1> i = x.cast<Index>();
  const Eigen::Array3d t = x - i.cast<double>();
  double sum = 0.0;
  for (Index corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    Eigen::Array<Index, 3, 1> at = i;
    for (Index k = 0; k < 3; ++k) {
      const bool far = ((corner >> k) & 1) != 0;
      weight *= far ? t[k] : 1.0 - t[k];
      at[k] += far ? 1 : 0;
    }
    sum += weight * static_cast<double>(depth_[index(at[0], at[1], at[2])]);
  }
  return sum;
}

}  // namespace bathyal::workspace
