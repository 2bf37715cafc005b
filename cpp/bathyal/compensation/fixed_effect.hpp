// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/effects/effect.hpp"

namespace bathyal {

/// An effect with fixed values while the geometry is estimated.
struct FixedEffect {
  EffectVariant variant;
  Eigen::VectorXd values;
  std::vector<std::vector<Perturbation>>
      perturbations;  ///< at the rows of the measurement, as perturbations_of
};

}  // namespace bathyal
