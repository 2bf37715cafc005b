// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "bathyal/sonar/sonar.hpp"

namespace bathyal::sonar {

/// Mean of a pattern over a cell of the array's sine, so that a beam of few rays, or of one, has
/// the energy of its pattern.
class PatternMean {
 public:
  /// \param squared of the two-way power of an array that transmits and receives
  PatternMean(BeamPattern kind, bool squared);

  /// From off − half to off + half, in half-power places off the axis; to 10⁻⁵ of the axis.
  double operator()(double off, double half) const;

 private:
  double power(double off) const;
  double at(double off) const;        ///< by the table
  double integral(double off) const;  ///< from the axis

  BeamPattern kind_;
  bool squared_;
  std::vector<double> powers_, integrals_;  ///< at equal steps from the axis
};

/// Made once for each pattern.
const PatternMean& pattern_mean(BeamPattern kind, bool squared);

}  // namespace bathyal::sonar
