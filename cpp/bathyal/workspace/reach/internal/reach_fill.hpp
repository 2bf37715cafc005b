// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/workspace/reach/internal/reach_grid.hpp"

namespace bathyal::workspace {

/// Solves again for what `state` holds, each pair of voxel and direction from its posture, and
/// takes out what fails. `all`: of every pair, in the direction where the tool then points, for
/// arms whose directions follow from the place; else of those that border on a voxel that is not
/// reached along the same direction, again and again until the border has been confirmed.
void confirm(const ReachArm& arm, const ReachGrid& grid, const std::vector<Vec3>& approach,
             bool all, int num_threads, ReachState& state, ReachPostures& postures);

/// Lets the reached part of each direction grow: inverse kinematics of every voxel that borders on
/// it, from the posture of the neighbour, until nothing is added. A pair of voxel and direction is
/// tried from at most `tries` of its neighbours.
void grow(const ReachArm& arm, const ReachGrid& grid, const std::vector<Vec3>& approach, int tries,
          int num_threads, ReachState& state, ReachPostures& postures);

}  // namespace bathyal::workspace
