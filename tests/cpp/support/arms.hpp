// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "bathyal/arm/dh.hpp"
#include "bathyal/arm/kinematics.hpp"
#include "bathyal/base/random.hpp"

// Arms and poses to try things on.

namespace bathyal {

inline constexpr double kPi = std::numbers::pi;

inline Pose pose_of(double x, double y, double z, double about_x, double about_y) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(about_x, Vec3::UnitX()) *
         Eigen::AngleAxisd(about_y, Vec3::UnitY());
}

/// Links of 0.5 and 0.4 m in the plane z = 0.
inline Arm planar_arm() {
  return arm_from_dh({DhConvention::kStandard,
                      {{0.5, 0.0, 0.0, 0.0, 0.0}, {0.4, 0.0, 0.0, 0.0, 0.0}},
                      {JointType::kRevolute, JointType::kRevolute},
                      Pose::Identity(),
                      Pose::Identity()});
}

inline Arm ur10e() {
  DhTable table;
  const double a[] = {0, -0.6127, -0.5715, 0, 0, 0};
  const double alpha[] = {kPi / 2, 0, 0, kPi / 2, -kPi / 2, 0};
  const double d[] = {0.1807, 0, 0, 0.1741, 0.1198, 0.1165};
  DhArmOptions options;
  options.upper = {2 * kPi, 2 * kPi, kPi, 2 * kPi, 2 * kPi, 2 * kPi};
  for (int i = 0; i < 6; ++i) {
    table.rows.push_back({a[i], alpha[i], d[i], 0, 0});
    table.types.push_back(JointType::kRevolute);
    options.lower.push_back(-options.upper[i]);
  }
  return arm_from_dh(table, options);
}

inline Arm panda() {
  DhTable table;
  table.convention = DhConvention::kModified;
  const double a[] = {0, 0, 0, 0.0825, -0.0825, 0, 0.088};
  const double alpha[] = {0, -kPi / 2, kPi / 2, kPi / 2, -kPi / 2, kPi / 2, kPi / 2};
  const double d[] = {0.333, 0, 0.316, 0, 0.384, 0, 0};
  for (int i = 0; i < 7; ++i) {
    table.rows.push_back({a[i], alpha[i], d[i], 0, 0});
    table.types.push_back(JointType::kRevolute);
  }
  table.flange.translation().z() = 0.107;
  DhArmOptions options;
  options.lower = {-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973};
  options.upper = {2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973};
  return arm_from_dh(table, options);
}

/// Maevskiy, Zanin (2020).
inline Arm three_joints() {
  DhTable table;
  table.rows = {
      {0.193, kPi / 2, -0.117, 0.0, 0.0}, {0.552, 0.0, 0.0, 0.0, 0.0}, {0.596, 0.0, 0.0, 0.0, 0.0}};
  table.types.assign(3, JointType::kRevolute);
  return arm_from_dh(
      table, {.lower = {-kPi / 2, -kPi / 2, -0.75 * kPi}, .upper = {kPi / 2, kPi, 0.75 * kPi}});
}

/// Turning, sliding, fixed and mimic joints, every row with beta; links with frames of their own,
/// masses and volumes; base, root, flange and tool.
inline Arm irregular_arm(std::uint64_t seed) {
  RandomStream random(seed);
  const auto any = [&] { return random.uniform(-1.0, 1.0); };
  std::vector<Joint> joints(7);
  std::vector<Link> links(8);
  for (Joint& joint : joints) joint.row = {any(), 2 * any(), any(), 3 * any(), any()};
  joints[0].coordinate = 0;
  joints[1].type = JointType::kPrismatic;
  joints[1].coordinate = 1;
  joints[2].type = JointType::kFixed;
  joints[3].coordinate = 2;
  joints[4].coordinate = 0;  // follows the first
  joints[4].multiplier = -0.7;
  joints[4].offset = 0.3;
  joints[5].type = JointType::kPrismatic;  // and so does this, though it slides
  joints[5].coordinate = 0;
  joints[5].multiplier = 0.2;
  joints[6].coordinate = 3;
  for (Link& link : links) {
    link.row_from_link = pose_of(any(), any(), any(), any(), any());
    link.body.mass = 1.0 + any();
    link.body.volume = 1e-3 * (1.0 + any());
    link.body.center_of_mass = Vec3(any(), any(), any());
    link.body.center_of_buoyancy = Vec3(any(), any(), any());
  }
  Arm arm("irregular", joints, links, pose_of(any(), any(), any(), any(), any()),
          pose_of(any(), any(), any(), any(), any()));
  arm.set_base(pose_of(any(), any(), any(), any(), any()));
  arm.set_tool(pose_of(any(), any(), any(), any(), any()));
  return arm;
}

/// Poses within the limits, at most a turn wide, and within ±1 without them.
inline JointMatrix random_poses(const Arm& arm, Index count, std::uint64_t seed) {
  RandomStream random(seed);
  JointMatrix q(count, arm.size());
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < arm.size(); ++j) {
      const bool limited = std::isfinite(arm.upper()[j] - arm.lower()[j]);
      q(i, j) = limited ? random.uniform(arm.lower()[j], arm.upper()[j]) : random.uniform(-1, 1);
    }
  }
  return q;
}

}  // namespace bathyal
