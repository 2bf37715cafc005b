// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "bathyal/sonar/sonar.hpp"

namespace bathyal::sonar {

/// The rays of one beam in the sonar's frame, column by column: a column has one φ, its rays rise
/// in ψ, so that neighbours meet neighbouring places.
struct BeamRays {
  Beam beam;
  double half_psi = 0.0;  ///< half of what a ray covers in ψ [rad]; 0 of pixels, which are points
  double half_phi = 0.0;  ///< and in φ
  std::vector<double> direction;     ///< (N, 3), unit
  std::vector<double> weight;        ///< (N,) ∫ b² dΩ, or what a pixel counts
  std::vector<double> transmitted;   ///< the same by what the beam transmits alone; where it moves
  std::vector<std::size_t> columns;  ///< first ray of each, then N
  Vec3 least = Vec3::Zero(), most = Vec3::Zero();  ///< of the directions, axis by axis
};

/// All beams of a sonar. Rays without weight are left out.
std::vector<BeamRays> ray_fans(const SonarOptions& options);

}  // namespace bathyal::sonar
