// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/estimation/rank.hpp"
#include "bathyal/identify/model/arm_parameters.hpp"

namespace bathyal {

/// A parameter that no measurement of this kind can distinguish from the base, the tool and the
/// parameters that are kept: it stays at its nominal value without loss of accuracy.
struct RedundantParameter {
  int column = 0;
  std::vector<NullSpacePartner> partners;  ///< equivalent changes of others, per unit
};

/// Determined numerically, not by rules: from the derivatives of the tip over random poses of an
/// arm with rows like those of this one but without special angles or lengths. Which of several
/// equivalent parameters is kept is decided at the actual arm: together they observe all that is
/// observable there, too. With `base_known` the base is not free to absorb anything, and `fixed`
/// parameters neither absorb nor are redundant.
std::vector<RedundantParameter> find_redundant(const ArmParameters& parameters,
                                               const Measurement& measurement,
                                               const ParameterChoice& choice, bool base_known,
                                               const std::vector<int>& fixed);

}  // namespace bathyal
