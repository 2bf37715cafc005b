// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/workspace/reach/internal/reach_grid.hpp"

namespace bathyal::workspace {

/// Where the tip should be.
struct ReachTarget {
  Vec3 middle = Vec3::Zero();
  Vec3 direction = Vec3::Zero();  ///< of the tool's z axis; zero: any
};

struct ReachSolutions {
  std::vector<std::uint8_t> reached;
  std::vector<Vec3> z_axis;  ///< of the tool, at q
};

/// Damped least squares from each row of q, which it moves, within the limits: many targets step by
/// step together, so that their kinematics are computed in one call. Serial. A target counts as
/// reached when a last step is so short that it ends within some 10⁻⁴ m, and is given up once its
/// error has nearly ceased to fall.
ReachSolutions solve_targets(const ReachArm& arm, std::span<const ReachTarget> targets,
                             JointMatrix& q);

}  // namespace bathyal::workspace
