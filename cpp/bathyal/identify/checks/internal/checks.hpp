// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/identify/checks/internal/outliers.hpp"
#include "bathyal/identify/checks/internal/residual_structure.hpp"
#include "bathyal/identify/fit/arm_fit.hpp"

// Checks of a fit and of its data, each of which may add warnings.

namespace bathyal::identify {

/// Input of the checks: a fit with everything but its warnings.
struct CheckContext {
  const Measurement& measurement;
  const ArmResiduals& system;
  const Arm& nominal;
  const ArmFit& fit;
  const ResidualStructure& structure;
  const OutlierSearch& search;
};

/// "joint 3 (elbow)".
std::string joint_label(const Arm& arm, Index coordinate);

/// All warnings, the most serious first: what is wrong, what it means and what to do next.
std::vector<std::string> all_warnings(const CheckContext& context);

/// The warnings that no effect can explain: about the machine, its scale and the poses.
std::vector<std::string> gross_warnings(const CheckContext& context);

/// Whether the fit is of another machine, or of an arm that is far from its nominal geometry.
bool is_unusable(const CheckContext& context);

/// Whether outliers make up most of the residuals: they then cause whatever else is conspicuous in
/// the fit, which is not reported until they are corrected.
bool outliers_dominate(const CheckContext& context);

/// Checks of the fit: another machine, rows that contradict each other, large residuals.
void check_fit(const CheckContext& context, std::vector<std::string>& warnings);

/// Of these: another machine, or an arm that is far from its nominal geometry.
void check_arm(const CheckContext& context, std::vector<std::string>& warnings);

/// Checks of lengths: no observed scale, touches that contradict known lengths or positions.
void check_lengths(const CheckContext& context, std::vector<std::string>& warnings);

/// Checks of the poses: too few, too similar, joints at rest, limits exceeded.
void check_data(const CheckContext& context, std::vector<std::string>& warnings);

}  // namespace bathyal::identify
