// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/workspace/reach/internal/reach_grid.hpp"
#include "bathyal/workspace/reach/reach_map.hpp"

namespace bathyal::workspace {

/// Fills `map.free` and `map.clearance`: looks at the postures that were found for each voxel until
/// one is free, then, where none is, at what inverse kinematics makes of a free neighbour's
/// posture, until all that border on the free part have failed.
void find_free(const Workspace& workspace, const ReachArm& arm, const ReachGrid& grid,
               const ReachState& state, const ReachPostures& postures, int num_threads,
               ReachMap& map);

}  // namespace bathyal::workspace
