// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string_view>

#include "bathyal/base/error.hpp"

namespace bathyal {

// Checks of single values, for the public functions and for the `check()` of their option structs.
// NaN passes none of them.

inline void check_finite(std::string_view name, double value) {
  if (!std::isfinite(value)) throw_argument(name, "a finite number", to_text(value));
}

inline void check_positive(std::string_view name, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw_argument(name, "a finite number above 0", to_text(value));
  }
}

inline void check_not_negative(std::string_view name, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw_argument(name, "a finite number of 0 or more", to_text(value));
  }
}

/// low and high belong to the range.
inline void check_range(std::string_view name, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    throw_argument(name, "a number from " + to_text(low) + " to " + to_text(high), to_text(value));
  }
}

}  // namespace bathyal
