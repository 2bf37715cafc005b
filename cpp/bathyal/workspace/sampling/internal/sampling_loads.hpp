// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/workspace/sampling/internal/sampling_search.hpp"

namespace bathyal::workspace {

/// Puts the legs found one after the other: phases with their tips, then time, contact force and
/// wrench of all.
void add_phases(const SamplingSearch& search, const SamplingOptions& options, SamplingPlan& plan);

}  // namespace bathyal::workspace
