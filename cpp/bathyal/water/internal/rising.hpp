// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "bathyal/base/error.hpp"

namespace bathyal {

/// \throw std::invalid_argument unless the numbers are finite and rise.
inline void check_rising(std::string_view name, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || (i > 0 && !(values[i] > values[i - 1]))) {
      throw_argument(name, "finite numbers that rise",
                     to_text(values[i]) + " in row " + std::to_string(i));
    }
  }
}

/// Between which rows a value lies, and the share of the upper one; 0 and 1 at the ends.
struct Interval {
  std::size_t low = 0;
  std::size_t high = 0;
  double share = 0.0;
};

inline Interval interval_of(const std::vector<double>& rows, double value) {
  const auto above = std::upper_bound(rows.begin(), rows.end(), value);
  if (above == rows.begin()) return {};
  const auto high = static_cast<std::size_t>(above - rows.begin());
  if (above == rows.end()) return {high - 1, high - 1, 0.0};
  return {high - 1, high, (value - rows[high - 1]) / (rows[high] - rows[high - 1])};
}

}  // namespace bathyal
