// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bathyal/base/random.hpp"

namespace bathyal::generate {

// Parts of the bottom, drawn from streams of their own: more of one leave the others alone.
enum Stream : std::uint64_t {
  kReliefStream = 0x5ea0,
  kMeanderStream,
  kPatchStream,
  kEdgeStream,
  kDefectStream,
  kBoulderStream,
};

/// 0 below 0, 1 above 1, smooth between.
inline double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Calls `visit(random, x0, y0)` for the nine cells of side `side` around a place, in fixed order:
/// the stream of random numbers of each, and its corner. What lies in a cell and reaches no further
/// than a side out of it is found, wherever one asks.
template <class Visit>
void visit_cells(std::uint64_t seed, std::uint64_t stream, double side, double x, double y,
                 const Visit& visit) {
  const double column = std::floor(x / side);
  const double row = std::floor(y / side);
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const auto a = static_cast<std::uint32_t>(static_cast<std::int64_t>(column) + i);
      const auto b = static_cast<std::uint32_t>(static_cast<std::int64_t>(row) + j);
      RandomStream random(seed ^ (stream << 48U),
                          (static_cast<std::uint64_t>(a) << 32U) | static_cast<std::uint64_t>(b));
      visit(random, (column + i) * side, (row + j) * side);
    }
  }
}

}  // namespace bathyal::generate
