// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bathyal/diagnosis/diagnosis.hpp"
#include "bathyal/effects/effect.hpp"

// Lack-of-fit terms of an arm: dependences of the residuals that are no causes by themselves.

namespace bathyal::diagnosis {

/// Perturbations that test for a dependence of the residuals.
struct LackOfFitTerm {
  Dependence dependence;
  int joint = -1;           ///< coordinate that is perturbed; -1: the tip
  std::string description;  ///< "what moves joint 4 with joints 2 and 3 together"
  /// Terms of one family differ in one number only (a period), in its order; else -1.
  int family = -1;
  double multiplicity = 1.0;
  std::function<std::vector<Perturbation>()> perturbations;  ///< one for each column
};

/// All that can be tested with these data. `position` (3, N): tips of the model, in the arm's base
/// frame; without columns where a field over space is not observable, as at free touched points.
/// `data` must outlive the terms.
std::vector<LackOfFitTerm> make_lack_of_fit_terms(const EffectData& data,
                                                  const Eigen::Matrix3Xd& position);

}  // namespace bathyal::diagnosis
