// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace bathyal {

/// One unknown of an estimation problem: all that solvers and the analysis of observability use.
struct Parameter {
  static constexpr double kNoPrior = std::numeric_limits<double>::infinity();

  std::string name;         ///< as in `theta_3`, unique
  std::string description;  ///< as in "theta of row 3"
  std::string unit;         ///< "m", "rad" or another
  std::string group;        ///< what it belongs to: "row 3", "tool", "base"
  double nominal = 0.0;
  double scale = 1.0;           ///< a typical change of it, in its unit; above 0
  double prior_std = kNoPrior;  ///< of its deviation from nominal, in its unit
};

/// Index of the parameter `name`, -1 when there is none.
inline int find_parameter(const std::vector<Parameter>& parameters, const std::string& name) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace bathyal
