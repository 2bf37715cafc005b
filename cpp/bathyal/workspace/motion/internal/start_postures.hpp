// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "bathyal/workspace/motion/internal/path_follower.hpp"

namespace bathyal::workspace {

/// Postures in which a stretch may begin, free of contact, none nearly the same as another: those
/// nearest to `near` first (without one: to the middle of the limits). None with `halt` set.
std::vector<Eigen::VectorXd> start_postures(const Workspace& ws, const PathFollower& follower,
                                            std::int32_t sample, std::span<const double> near,
                                            const FollowOptions& options, FollowCut& halt);

/// The first of samples from `first` on that inverse kinematics reaches; size() if there is none.
std::int32_t next_reachable(const Workspace& ws, const PathFollower& follower, std::int32_t first,
                            const FollowOptions& options);

}  // namespace bathyal::workspace
