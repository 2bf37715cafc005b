// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/model/arm_parameters.hpp"

namespace bathyal {

/// Where the search starts. For use inside the room.
struct Start {
  std::vector<Pose> bases;
  std::vector<Pose> tools;
  std::vector<PlaneGuess> planes;
};

/// Tools, bases and planes for the arm as it is. A tool is `arm.tool()` when `tool_given`, else it
/// is found by linear least squares: from touches as in Yukhimets, Gubankov 2023, eq 12-16; from
/// tracked poses together with the base, whose rotation is first taken as any 3 × 3 matrix. A base
/// that is not free is `arm.base()`; where poses tell nothing of a number, it stays small.
Start find_start(const Arm& arm, const Measurement& measurement, bool tool_given, bool base_free);

}  // namespace bathyal
