// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/workspace/internal/bodies.hpp"
#include "bathyal/workspace/workspace.hpp"

namespace bathyal::workspace {

struct TargetQuery {
  double time = 0.0;
  std::uint64_t seed = 0;
  int num_threads = 0;
};

/// Workspace::check_target.
std::vector<TargetCheck> check_targets(const Workspace& workspace, const Bodies& bodies,
                                       PointView points, const TargetQuery& query);

}  // namespace bathyal::workspace
