// SPDX-License-Identifier: BSD-3-Clause
// Jacobians and Hayati's and Craig's rows against automatic differentiation: the product of the
// rows' factors, written once more for dual numbers.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "bathyal/arm/row_frames.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

constexpr int kMost = 7;  ///< coordinates
using Jet = ceres::Jet<double, kMost>;
using JetMatrix = Eigen::Matrix<Jet, 4, 4>;

JetMatrix turn(const Jet& angle, int axis) {
  JetMatrix pose = JetMatrix::Identity();
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  pose(i, i) = pose(j, j) = cos(angle);
  pose(j, i) = sin(angle);
  pose(i, j) = -sin(angle);
  return pose;
}

JetMatrix shift(const Jet& length, int axis) {
  JetMatrix pose = JetMatrix::Identity();
  pose(axis, 3) = length;
  return pose;
}

JetMatrix constant(const Pose& pose) { return pose.matrix().cast<Jet>(); }

/// A row of a table, its joint at `value`.
JetMatrix row_product(const DhRow& row, JointType type, DhConvention convention, const Jet& value) {
  const Jet zero(0.0);
  const JetMatrix joint = turn(row.theta + (type == JointType::kRevolute ? value : zero), 2) *
                          shift(row.d + (type == JointType::kPrismatic ? value : zero), 2);
  const JetMatrix twist = shift(Jet(row.a), 0) * turn(Jet(row.alpha), 0) * turn(Jet(row.beta), 1);
  return convention == DhConvention::kStandard ? JetMatrix(joint * twist)
                                               : JetMatrix(twist * joint);
}

Jet coordinate(const JointMatrix& q, int j) { return Jet(q(0, j), j); }

/// Pose and Jacobian of a product of dual numbers, against the engine's.
void expect_same(const Arm& arm, const JointMatrix& q, const JetMatrix& product) {
  const PosesAndJacobians both = forward_and_jacobian(arm, view_of(q));
  const JointView columns(both.jacobians.data(), 6, arm.size());
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation(i, j) = product(i, j).a;
    for (int j = 0; j < 4; ++j) {
      EXPECT_NEAR(both.poses[static_cast<std::size_t>(4 * i + j)], product(i, j).a, 1e-13);
    }
  }
  for (int k = 0; k < arm.size(); ++k) {
    Eigen::Matrix3d slope;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) slope(i, j) = product(i, j).v[k];
      EXPECT_NEAR(columns(i, k), product(i, 3).v[k], 1e-12) << "coordinate " << k;
    }
    const Eigen::Matrix3d spin = slope * rotation.transpose();
    const Vec3 angular(spin(2, 1), spin(0, 2), spin(1, 0));
    EXPECT_LT((columns.col(k).tail(3) - angular).norm(), 1e-12) << "coordinate " << k;
  }
}

DhTable random_table(std::uint64_t seed, DhConvention convention) {
  RandomStream random(seed);
  const auto any = [&] { return random.uniform(-1.0, 1.0); };
  DhTable table;
  table.convention = convention;
  for (int k = 0; k < kMost; ++k) {
    table.rows.push_back({any(), 3 * any(), any(), 3 * any(), k % 2 == 0 ? any() : 0.0});
    table.types.push_back(random.next() % 4 == 0 ? JointType::kPrismatic : JointType::kRevolute);
  }
  table.root = pose_of(any(), any(), any(), any(), any());
  table.flange = pose_of(any(), any(), any(), any(), any());
  return table;
}

TEST(Derivatives, TablesOfEitherConventionAgreeWithDualNumbers) {
  for (const DhConvention convention : {DhConvention::kStandard, DhConvention::kModified}) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      SCOPED_TRACE(seed);
      const DhTable table = random_table(seed, convention);
      const Arm arm = arm_from_dh(table);
      const JointMatrix q = random_poses(arm, 1, seed);
      JetMatrix product = constant(table.root);
      for (int k = 0; k < kMost; ++k) {
        const auto row = static_cast<std::size_t>(k);
        product =
            product * row_product(table.rows[row], table.types[row], convention, coordinate(q, k));
      }
      expect_same(arm, q, product * constant(table.flange));
    }
  }
}

TEST(Derivatives, FollowersAddToTheirLeaders) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const Arm arm = irregular_arm(seed);
    const JointMatrix q = random_poses(arm, 1, seed);
    JetMatrix product = constant(arm.base() * arm.root());
    for (const Joint& joint : arm.joints()) {
      const Jet value = joint.type == JointType::kFixed
                            ? Jet(0.0)
                            : joint.multiplier * coordinate(q, joint.coordinate) + joint.offset;
      product = product * row_product(joint.row, joint.type, DhConvention::kStandard, value);
    }
    expect_same(arm, q, product * constant(arm.flange() * arm.tool()));
  }
}

}  // namespace
}  // namespace bathyal
