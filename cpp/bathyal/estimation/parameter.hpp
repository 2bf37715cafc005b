// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace bathyal {

/// One unknown of an identification. The solver and the search for what can be told know no more
/// of it than this.
struct Column {
  static constexpr double kNoPrior = std::numeric_limits<double>::infinity();

  std::string name;   ///< as in `theta_3`, unique
  std::string words;  ///< as in "theta of row 3"
  std::string unit;   ///< "m", "rad" or another
  std::string group;  ///< what it belongs to: "row 3", "tool", "base"
  double nominal = 0.0;
  double scale = 1.0;           ///< an ordinary change of it, in its unit; above 0
  double prior_std = kNoPrior;  ///< how far it may lie from nominal, in its unit
};

/// Position of the column `name`, -1 when there is none.
inline int find_column(const std::vector<Column>& columns, const std::string& name) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace bathyal
