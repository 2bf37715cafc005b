// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "bathyal/arm/arm.hpp"

// One pose at a time, for those who need every frame of it (identification, inverse kinematics,
// statics). Many poses at once: kinematics.hpp.

namespace bathyal {

/// previous_from_this of a row whose joint has `value` ([rad], [m]; a fixed joint ignores
/// it).
Pose row_pose(const DhRow& row, JointType type, double value);

/// The value of a joint at the coordinates `q`: multiplier * q[coordinate] + offset; 0 when fixed.
double joint_value(const Joint& joint, std::span<const double> q);

/// Where the frames of an arm are, in the world.
struct RowFrames {
  /// joints + 1 of them: [0] is base * root, [k] comes after row k - 1. Joint k turns about, or
  /// slides along, the z axis of [k].
  std::vector<Pose> world_from_row;
  Pose world_from_tool = Pose::Identity();
};

/// Fills `frames`, whose memory is used again, for one q of arm.size() numbers. Values beyond the
/// limits are taken as they are.
void compute_row_frames(const Arm& arm, std::span<const double> q, RowFrames& frames);

RowFrames row_frames(const Arm& arm, std::span<const double> q);

}  // namespace bathyal
