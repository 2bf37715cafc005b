// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/identify/fit/arm_fit.hpp"
#include "bathyal/identify/fit/calibration_search.hpp"

namespace bathyal {

/// All that is told of an identification but warnings and outliers. For use inside the room.
ArmFit report(const ArmProblem& problem, const Observability& seen, const SearchResult& found);

}  // namespace bathyal
