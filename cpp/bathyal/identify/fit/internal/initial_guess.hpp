// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/model/arm_parameters.hpp"

namespace bathyal::identify {

/// The starting point of the search.
struct InitialGuess {
  std::vector<Pose> bases;
  std::vector<Pose> tools;
  std::vector<PlaneGuess> planes;
};

/// Tools, bases and planes for the nominal rows. A tool is `arm.tool()` when `tool_given`, else it
/// is estimated by linear least squares: from touches as in Yukhimets, Gubankov 2023, eq 12-16;
/// from tracked poses together with the base, whose rotation is first estimated as any 3 × 3
/// matrix. A base that is not free is `arm.base()`; undetermined numbers stay small.
InitialGuess find_initial_guess(const Arm& arm, const Measurement& measurement, bool tool_given,
                                bool base_free);

}  // namespace bathyal::identify
