// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bathyal/effects/effect.hpp"

// Ways in which an arm's residuals may have structure that is no cause: what they depend on. For
// use inside the room.

namespace bathyal::diagnosis {

/// Actions that show a dependence on something.
struct LackOfFitTerm {
  std::string against;      ///< "joints 2 and 3"
  std::string description;  ///< "what moves joint 4 with joints 2 and 3 together"
  /// Probes of one family are alternatives over one number (a period), in its order; else -1.
  int family = -1;
  double multiplicity = 1.0;
  std::function<std::vector<Perturbation>()> perturbations;  ///< one for each column
};

/// All that can be asked of these data. `position` (3, N) is where the model has the tips, in
/// the arm's base frame; without columns where a field over space could not be seen, as at touched
/// points that are free. `data` must outlive the probes.
std::vector<LackOfFitTerm> make_lack_of_fit_terms(const EffectData& data,
                                                  const Eigen::Matrix3Xd& position);

}  // namespace bathyal::diagnosis
