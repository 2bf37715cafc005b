// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/residual_noise.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal {

Noise residual_noise(const ArmResiduals& system, const Eigen::Array2d& squares,
                     const Eigen::Array2d& taken, const IdentifyOptions& options) {
  const Eigen::Array2d dof = system.free_rows() - taken;
  const auto estimate = [&](Index kind, double now) {
    return dof[kind] > 0.5 ? std::max(now * std::sqrt(squares[kind] / dof[kind]), kLeastNoise)
                           : now;
  };
  Noise noise = system.noise();
  if (!options.noise) noise.position = estimate(0, noise.position);
  if (system.rotation_rows() > 0 && !options.rotation_noise) {
    noise.rotation = estimate(1, noise.rotation);
  }
  return noise;
}

double relative_change(const Noise& noise, const Noise& old) {
  return std::max(std::abs(noise.position / old.position - 1.0),
                  std::abs(noise.rotation / old.rotation - 1.0));
}

}  // namespace bathyal
