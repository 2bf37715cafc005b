// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/identify/arm_fit.hpp"
#include "bathyal/identify/outliers.hpp"
#include "bathyal/identify/structure.hpp"

// What a doubting reader would say of a fit. For use inside the room.

namespace bathyal {

/// What there is to look at: a fit with everything but its warnings.
struct Case {
  const Measurement& measurement;
  const ArmSystem& system;
  const Arm& nominal;
  const ArmFit& fit;
  const Structure& structure;
  const OutlierSearch& search;
};

/// "joint 3 (elbow)".
std::string joint_words(const Arm& arm, Index coordinate);

/// A warning or more each: what it means and what to do next. The gravest first.
std::vector<std::string> find_doubts(const Case& seen);

/// Those that the fit gives: it belongs to another machine, its size rests on nothing measured, it
/// contradicts what was told, it leaves too much.
void doubt_fit(const Case& seen, std::vector<std::string>& warnings);

/// Those that the poses give: too few, too alike, joints that stand still, limits exceeded.
void doubt_data(const Case& seen, std::vector<std::string>& warnings);

}  // namespace bathyal
