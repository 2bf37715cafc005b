// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/workspace/reach/internal/reach_grid.hpp"

namespace bathyal::workspace {

/// Enters postures 0 … samples − 1, each swept through the range of the first joint, into `state`:
/// a voxel is reached, along the direction nearest to the tool's z axis and in any orientation,
/// where the first-order step from the posture to the voxel's middle, and onto the direction, stays
/// within the limits and is short. Of an arm without exact directions, the direction is that of the
/// posture, before the step.
void sweep_postures(const ReachArm& arm, const ReachGrid& grid, const std::vector<Vec3>& approach,
                    const PostureSequence& sequence, std::size_t samples, int num_threads,
                    ReachState& state);

/// Of the low corner and the high one of all tips of the first postures, swept.
Eigen::AlignedBox3d box_of_tips(const ReachArm& arm, const PostureSequence& sequence,
                                std::size_t samples, int num_threads);

}  // namespace bathyal::workspace
