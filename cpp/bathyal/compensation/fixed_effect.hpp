// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/effects/effect.hpp"

namespace bathyal {

/// An effect that stands as it was found while the geometry is sought anew. For use inside the
/// room.
struct HeldEffect {
  EffectVariant variant;
  Eigen::VectorXd values;
  std::vector<std::vector<Action>> actions;  ///< at the rows of the measurement, as actions_of
};

}  // namespace bathyal
