// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/effects/measurements.hpp"
#include "support/arms.hpp"

// Arms that differ from their drawing, and what they would record.

namespace bathyal {

/// Rows off by normal errors of `size` [m] and [rad], with the tool given.
inline Arm built_arm(const Arm& drawing, double size, std::uint64_t seed,
                     const Vec3& tip = Vec3(0.02, -0.01, 0.15)) {
  RandomStream random(seed);
  std::vector<Joint> joints = drawing.joints();
  for (Joint& joint : joints) {
    joint.row.theta += size * random.normal();
    joint.row.d += size * random.normal();
    joint.row.a += size * random.normal();
    joint.row.alpha += size * random.normal();
  }
  Arm arm("built", std::move(joints), drawing.links(), drawing.root(), drawing.flange());
  Pose tool = Pose::Identity();
  tool.translation() = tip;
  arm.set_tool(tool);
  return arm;
}

/// Joint values that bring the tip onto `point`, from a random start; false when the way is lost.
inline bool reach(const Arm& arm, const Vec3& point, RandomStream& random, Eigen::VectorXd& q) {
  q.resize(arm.size());
  for (Index j = 0; j < q.size(); ++j) q[j] = random.uniform(-2.5, 2.5);
  for (int step = 0; step < 80; ++step) {
    const RowFrames frames = row_frames(arm, {q.data(), static_cast<std::size_t>(q.size())});
    const Vec3 tip = frames.world_from_tool.translation();
    const Vec3 miss = point - tip;
    if (miss.norm() < 1e-14) return q.cwiseAbs().maxCoeff() < 6.0;
    Eigen::Matrix3Xd jacobian = Eigen::Matrix3Xd::Zero(3, arm.size());
    for (std::size_t k = 0; k < arm.joints().size(); ++k) {
      const Joint& joint = arm.joints()[k];
      if (joint.type == JointType::kFixed) continue;
      const Vec3 z = frames.world_from_row[k].linear().col(2);
      const Vec3 lever = tip - frames.world_from_row[k].translation();
      jacobian.col(joint.coordinate) +=
          joint.multiplier * (joint.type == JointType::kPrismatic ? z : Vec3(z.cross(lever)));
    }
    Eigen::Matrix3d square = jacobian * jacobian.transpose();
    square.diagonal().array() += 1e-12;
    Eigen::VectorXd change = jacobian.transpose() * square.ldlt().solve(miss);
    if (change.norm() > 0.3) change *= 0.3 / change.norm();
    q += change;
  }
  return false;
}

/// `count` touches of each point, exact.
inline Touches touch(const Arm& arm, const std::vector<Vec3>& points, int count,
                     std::uint64_t seed) {
  RandomStream random(seed);
  Touches touches;
  touches.q.resize(static_cast<Index>(points.size()) * count, arm.size());
  Eigen::VectorXd q;
  Index row = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (int i = 0; i < count; ++i) {
      while (!reach(arm, points[p], random, q)) {
      }
      touches.q.row(row++) = q.transpose();
      touches.point.push_back(static_cast<int>(p));
    }
  }
  return touches;
}

/// Touches of the size: three points, 21 poses each.
inline std::vector<Vec3> three_points() {
  return {{0.6, 0.2, 0.1}, {0.3, -0.6, 0.2}, {-0.5, 0.5, 0.3}};
}

/// Recorded joint values scatter by `std` [rad].
inline void add_scatter(double std, std::uint64_t seed, Touches& touches) {
  RandomStream random(seed);
  for (Index i = 0; i < touches.q.size(); ++i) touches.q.data()[i] += std * random.normal();
}

inline Tracked track(const Arm& arm, Index count, bool rotations, std::uint64_t seed) {
  const JointMatrix q = random_poses(arm, count, seed);
  Tracked tracked;
  tracked.q = q;
  tracked.position.resize(count, 3);
  for (Index i = 0; i < count; ++i) {
    const Pose pose =
        row_frames(arm, {q.row(i).data(), static_cast<std::size_t>(q.cols())}).world_from_tool;
    tracked.position.row(i) = pose.translation().transpose();
    if (rotations) tracked.pose.push_back(pose);
  }
  return tracked;
}

/// Measured positions, and turns where there are any, scatter by `std` [m] and [rad] per axis.
inline void add_noise(double std, std::uint64_t seed, Tracked& tracked) {
  RandomStream random(seed, 1);
  for (Index i = 0; i < tracked.position.size(); ++i) {
    tracked.position.data()[i] += std * random.normal();
  }
  for (std::size_t i = 0; i < tracked.pose.size(); ++i) {
    Pose& pose = tracked.pose[i];
    pose.translation() = tracked.position.row(static_cast<Index>(i)).transpose();
    for (int axis = 0; axis < 3; ++axis) {
      pose.linear() *= Eigen::AngleAxisd(std * random.normal(), Vec3::Unit(axis)).matrix();
    }
  }
}

}  // namespace bathyal
