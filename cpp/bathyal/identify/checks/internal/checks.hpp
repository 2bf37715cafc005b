// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/identify/checks/internal/outliers.hpp"
#include "bathyal/identify/checks/internal/residual_structure.hpp"
#include "bathyal/identify/fit/arm_fit.hpp"

// What a doubting reader would say of a fit. For use inside the room.

namespace bathyal {

/// What there is to look at: a fit with everything but its warnings.
struct Case {
  const Measurement& measurement;
  const ArmSystem& system;
  const Arm& nominal;
  const ArmFit& fit;
  const JointStructure& structure;
  const OutlierSearch& search;
};

/// "joint 3 (elbow)".
std::string joint_words(const Arm& arm, Index coordinate);

/// A warning or more each: what it means and what to do next. The gravest first.
std::vector<std::string> find_doubts(const Case& seen);

/// Those of them that no effect beside geometry answers: of the machine, its size and the poses.
std::vector<std::string> find_gross_doubts(const Case& seen);

/// Whether the fit is of another machine, or of an arm that no one would build.
bool is_unusable(const Case& seen);

/// Whether outliers make up most of what is left: what else is odd about the numbers of the fit is
/// their doing, and is not worth telling before they are mended.
bool is_swamped(const Case& seen);

/// Those that the fit gives: it belongs to another machine, rows contradict each other, it leaves
/// too much.
void doubt_fit(const Case& seen, std::vector<std::string>& warnings);

/// Of these: it belongs to another machine, or to an arm that no one would build.
void doubt_arm(const Case& seen, std::vector<std::string>& warnings);

/// Those about lengths: nothing measured tells the arm's size, or touches contradict what was told.
void doubt_lengths(const Case& seen, std::vector<std::string>& warnings);

/// Those that the poses give: too few, too alike, joints that stand still, limits exceeded.
void doubt_data(const Case& seen, std::vector<std::string>& warnings);

}  // namespace bathyal
