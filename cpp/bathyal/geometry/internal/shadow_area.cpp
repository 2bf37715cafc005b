// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/internal/shadow_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "bathyal/base/parallel.hpp"

namespace bathyal::geometry {
namespace {

constexpr std::size_t kLines = 1024;
constexpr double kMostCrossings = 2e7;
constexpr double kOverlap = 1e-9;  // of the length; less is rounding at shared edges

struct ShadowPoint {
  double x, y;
};
using Triangle2 = std::array<ShadowPoint, 3>;

Triangle2 in_plan(const TriangleMesh& mesh, Index t, const Vec3& origin) {
  Triangle2 result;
  for (int c = 0; c < 3; ++c) {
    const Vec3 p = mesh.corner(t, c) - origin;
    result[static_cast<std::size_t>(c)] = {p.x(), p.y()};
  }
  return result;
}

struct Interval {
  double low, high;
};

/// Where the line y crosses the triangle.
Interval crossing(const Triangle2& t, double y) {
  Interval x{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < 3; ++i) {
    const ShadowPoint& a = t[i];
    const ShadowPoint& b = t[(i + 1) % 3];
    if ((a.y <= y) == (b.y <= y)) continue;
    const double at = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
    x.low = std::min(x.low, at);
    x.high = std::max(x.high, at);
  }
  return x;
}

/// Lines y = low + (i + 1/2) step.
struct Lines {
  double low, step;
  std::size_t count;

  double y(std::size_t i) const { return low + (static_cast<double>(i) + 0.5) * step; }

  /// First line above `at`; count when there is none.
  std::size_t first_above(double at) const {
    const double i = std::ceil((at - low) / step - 0.5);
    return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(count)));
  }
};

struct Lengths {
  double each = 0.0;    ///< sum over the triangles
  double union_ = 0.0;  ///< every place once

  Lengths& operator+=(const Lengths& other) {
    each += other.each;
    union_ += other.union_;
    return *this;
  }
};

Lengths measure(std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& a, const Interval& b) { return a.low < b.low; });
  Lengths lengths;
  double reached = -std::numeric_limits<double>::infinity();
  for (const Interval& i : intervals) {
    lengths.each += i.high - i.low;
    lengths.union_ += std::max(0.0, i.high - std::max(reached, i.low));
    reached = std::max(reached, i.high);
  }
  return lengths;
}

}  // namespace

// The areas in plan of all triangles, summed, are exact but count a place once for every triangle
// over it; lines across the mesh give the share by which that is too much.
double shadow_area(const TriangleMesh& mesh, int num_threads) {
  const Vec3 origin = local_origin(mesh.vertices());
  const Index count = mesh.triangle_count();
  double total = 0.0, heights = 0.0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Index t = 0; t < count; ++t) {
    total += 0.5 * std::abs(mesh.area_vector(t).z());
    const Triangle2 flat = in_plan(mesh, t, origin);
    const auto [bottom, top] = std::minmax({flat[0].y, flat[1].y, flat[2].y});
    heights += top - bottom;
    low = std::min(low, bottom);
    high = std::max(high, top);
  }
  if (total == 0.0 || !std::isfinite(total)) return total;

  const double extent = high - low;
  const double most = (kMostCrossings - static_cast<double>(count)) * extent / heights;
  const auto line_count =
      static_cast<std::size_t>(std::clamp(most, 16.0, static_cast<double>(kLines)));
  const Lines lines{low, extent / static_cast<double>(line_count), line_count};
  std::vector<std::vector<std::int32_t>> crossed(line_count);
  for (Index t = 0; t < count; ++t) {
    const Triangle2 flat = in_plan(mesh, t, origin);
    const auto [bottom, top] = std::minmax({flat[0].y, flat[1].y, flat[2].y});
    for (std::size_t i = lines.first_above(bottom); i < lines.first_above(top); ++i) {
      crossed[i].push_back(static_cast<std::int32_t>(t));
    }
  }
  const auto lengths =
      parallel_sum<Lengths>(line_count, 16, num_threads, [&](std::size_t begin, std::size_t end) {
        Lengths sum;
        std::vector<Interval> intervals;
        for (std::size_t i = begin; i < end; ++i) {
          intervals.clear();
          for (const std::int32_t t : crossed[i]) {
            const Interval x = crossing(in_plan(mesh, t, origin), lines.y(i));
            if (x.high > x.low) intervals.push_back(x);
          }
          sum += measure(intervals);
        }
        return sum;
      });
  if (!(lengths.each > 0.0) || lengths.each - lengths.union_ <= kOverlap * lengths.each)
    return total;
  return total * (lengths.union_ / lengths.each);
}

}  // namespace bathyal::geometry
