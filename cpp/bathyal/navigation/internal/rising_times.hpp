// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

/// \throw std::invalid_argument unless the times are finite and rise
inline void check_rising_times(std::string_view name, const std::vector<double>& time) {
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (!std::isfinite(time[i]) || (i > 0 && !(time[i] > time[i - 1]))) {
      throw_argument(name, "finite times that rise",
                     to_text(time[i]) + " in row " + std::to_string(i));
    }
  }
}

/// \throw std::invalid_argument unless there are `count` rows of finite numbers
inline void check_rows(std::string_view name, const PointMatrix& rows, std::size_t count) {
  if (static_cast<std::size_t>(rows.rows()) != count) {
    throw_argument(name, std::to_string(count) + " rows, one a time", std::to_string(rows.rows()));
  }
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (!rows.row(i).allFinite()) {
      throw_argument(name, "finite numbers", "another in row " + std::to_string(i));
    }
  }
}

}  // namespace bathyal
