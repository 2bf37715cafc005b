// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/sonar/sonar.hpp"

namespace bathyal::sonar {

/// One-way power by which a beam receives from directions of the head's frame, by a table of its
/// pattern, to 10⁻⁵ of its axis.
class Reception {
 public:
  Reception(const SonarOptions& options, const Beam& beam);

  double power(const Vec3& direction) const;

 private:
  double shape(double off) const;  ///< of half a width

  BeamPattern pattern_;
  bool round_, swath_;  ///< a swath is received over all of ψ
  Vec3 array_, axis_, up_;
  double steered_, beam_half_, fan_half_;  ///< sines
  double low_, high_, least_cosine_;       ///< of a box: sines of φ, cosine of ψ or of the cone
  double behind_sine_, behind_cosine_;     ///< of the pattern's axis in ψ
  std::vector<double> table_;
};

}  // namespace bathyal::sonar
