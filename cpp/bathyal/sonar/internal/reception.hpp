// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/sonar/internal/pattern_mean.hpp"
#include "bathyal/sonar/sonar.hpp"

namespace bathyal::sonar {

/// One-way power by which a beam receives rays from directions of the head's frame, the mean over
/// what a ray covers in φ.
class Reception {
 public:
  /// \param half_phi half of what a ray covers in φ [rad]
  Reception(const SonarOptions& options, const Beam& beam, double half_phi);

  double power(const Vec3& direction) const;

 private:
  BeamPattern pattern_;
  bool round_, swath_;  ///< a swath is received over all of ψ
  Vec3 array_, axis_, up_;
  double steered_, beam_half_, fan_half_;  ///< sines
  double low_, high_, least_cosine_;       ///< of a box: sines of φ, cosine of ψ or of the cone
  double behind_sine_, behind_cosine_;     ///< of the pattern's axis in ψ
  double cell_sine_, cell_cosine_;         ///< of half a ray's cell in φ
  const PatternMean& mean_;
};

}  // namespace bathyal::sonar
