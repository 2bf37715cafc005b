// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "bathyal/workspace/keepout.hpp"

namespace bathyal::workspace {

/// Signed distance of a convex volume at a point and a subgradient of it, of unit length.
struct SignedDistance {
  double value;
  Vec3 gradient;
};

/// Of the volume in its own frame (a half-space: in the frame it names). Exact inside and outside.
SignedDistance signed_distance(const KeepOut& shape, const Vec3& point);

/// The least value on [0, 1] of a convex function; `at(t)` gives value and a subgradient. Two
/// tangents, one falling and one rising, bound the function from below where they cross: the next t
/// is there (at a kink that is the least value itself), or in the middle where the bracket would
/// not shrink by half. Ends when the bound is within `tolerance`.
template <class Function>
double convex_minimum(const Function& at, double tolerance) {
  auto [low_value, low_slope] = at(0.0);
  if (!(low_slope < 0.0)) return low_value;
  auto [high_value, high_slope] = at(1.0);
  if (!(high_slope > 0.0)) return high_value;
  double low = 0.0, high = 1.0, best = std::min(low_value, high_value);
  constexpr int kMostSteps = 200;
  bool halve = false;
  for (int step = 0; step < kMostSteps; ++step) {
    const double width = high - low;
    const double offset = (high_value - low_value - high_slope * width) / (low_slope - high_slope);
    const double bound = low_value + low_slope * offset;
    if (!(best - bound > tolerance)) break;
    double t = low + offset;
    if (halve || !(t > low && t < high)) t = 0.5 * (low + high);
    if (!(t > low && t < high)) break;
    const auto [value, slope] = at(t);
    best = std::min(best, value);
    if (slope == 0.0) break;
    if (slope < 0.0) {
      low = t, low_value = value, low_slope = slope;
    } else {
      high = t, high_value = value, high_slope = slope;
    }
    halve = !halve && high - low > 0.5 * width;
  }
  return best;
}

}  // namespace bathyal::workspace
