// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/sonar/echo.hpp"

namespace bathyal::sonar {

/// What the beams of one receiving array hear by their far side lobes. The rays of a beam end past
/// its second one; beyond, each neighbour's echo tells what comes from its sector of the fan, and
/// the beam hears it by its own pattern: the power of sector j in beam i is E_j S_ij / W_j, with
/// S_ij the integral of i's pattern over that sector, as far as i has no rays there, and W_j that
/// of j's over its own rays. What lies outside of the outer beams is not heard.
class SideLobes {
 public:
  /// None but for a multibeam or an imaging sonar with SonarOptions::side_lobes and a pattern.
  explicit SideLobes(const SonarOptions& options);

  bool none() const { return mix_.empty(); }

  /// Adds to each row what its beam hears of the others; the truth stays as it is.
  void add(Echo& echo, int num_threads) const;

 private:
  std::size_t beams_ = 0;
  std::vector<double> mix_;  ///< (beams, beams), S_ij / W_j
};

}  // namespace bathyal::sonar
