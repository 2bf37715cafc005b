// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/row_frames.hpp"

#include <cmath>

namespace bathyal {

Pose row_pose(const DhRow& row, JointType type, double value) {
  const double theta = type == JointType::kRevolute ? row.theta + value : row.theta;
  const double d = type == JointType::kPrismatic ? row.d + value : row.d;
  const double ct = std::cos(theta), st = std::sin(theta);
  const double ca = std::cos(row.alpha), sa = std::sin(row.alpha);
  Pose pose;
  pose.matrix() << ct, -st * ca, st * sa, row.a * ct,  //
      st, ct * ca, -ct * sa, row.a * st,               //
      0.0, sa, ca, d,                                  //
      0.0, 0.0, 0.0, 1.0;
  if (row.beta != 0.0) {
    const double cb = std::cos(row.beta), sb = std::sin(row.beta);
    const Vec3 x = pose.linear().col(0), z = pose.linear().col(2);
    pose.linear().col(0) = cb * x - sb * z;
    pose.linear().col(2) = sb * x + cb * z;
  }
  return pose;
}

double joint_value(const Joint& joint, std::span<const double> q) {
  if (joint.type == JointType::kFixed) return 0.0;
  return joint.multiplier * q[static_cast<std::size_t>(joint.coordinate)] + joint.offset;
}

void compute_row_frames(const Arm& arm, std::span<const double> q, RowFrames& frames) {
  const std::vector<Joint>& joints = arm.joints();
  frames.world_from_row.resize(joints.size() + 1);
  frames.world_from_row[0] = arm.base() * arm.root();
  for (std::size_t k = 0; k < joints.size(); ++k) {
    frames.world_from_row[k + 1] =
        frames.world_from_row[k] *
        row_pose(joints[k].row, joints[k].type, joint_value(joints[k], q));
  }
  frames.world_from_tool = frames.world_from_row.back() * arm.flange() * arm.tool();
}

RowFrames row_frames(const Arm& arm, std::span<const double> q) {
  RowFrames frames;
  compute_row_frames(arm, q, frames);
  return frames;
}

}  // namespace bathyal
