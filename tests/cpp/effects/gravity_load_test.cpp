// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/effects/gravity_load.hpp"

#include <gtest/gtest.h>

#include "support/arms.hpp"

namespace bathyal {
namespace {

constexpr double kPayload = 2.5;  // [kg]

/// Work of gravity on links and payload, from the base at the origin.
double work(const Arm& arm, const Eigen::VectorXd& q) {
  Arm at_origin = arm;
  at_origin.set_base(Pose::Identity());
  const RowFrames frames = row_frames(at_origin, {q.data(), static_cast<std::size_t>(q.size())});
  double sum = kPayload * kGravity.dot(frames.world_from_tool.translation());
  for (std::size_t k = 0; k < arm.links().size(); ++k) {
    const Link& link = arm.links()[k];
    sum += link.body.mass *
           kGravity.dot(frames.world_from_row[k] * (link.row_from_link * link.body.center_of_mass));
  }
  return sum;
}

TEST(GravityLoads, TorquesAreDerivativesOfTheWork) {
  const Arm arm = irregular_arm(3);
  const JointMatrix q = random_poses(arm, 5, 1);
  const EffectData data =
      make_effect_data(arm, q, {{"payload", RowMatrix::Constant(5, 1, kPayload)}}, false);
  EXPECT_EQ(payload_of(data), Eigen::VectorXd::Constant(5, kPayload));
  const GravityLoads loads(data, GravityLoads::Bodies::kArm, payload_of(data));
  constexpr double kStep = 1e-6;
  for (int j = 0; j < static_cast<int>(arm.size()); ++j) {
    const Eigen::VectorXd torque = loads.torque(j);
    for (Index i = 0; i < q.rows(); ++i) {
      Eigen::VectorXd up = q.row(i).transpose(), down = up;
      up[j] += kStep;
      down[j] -= kStep;
      EXPECT_NEAR(torque[i], (work(arm, up) - work(arm, down)) / (2.0 * kStep), 1e-6)
          << "joint " << j << ", row " << i;
    }
  }
}

TEST(GravityLoads, WithoutMassesOnlyThePayloadWeighs) {
  const Arm arm = ur10e();
  const JointMatrix q = random_poses(arm, 2, 1);
  const EffectData data = make_effect_data(arm, q, {}, false);
  EXPECT_FALSE(masses_known(arm));
  EXPECT_TRUE(masses_known(irregular_arm(1)));
  const GravityLoads loads(data, GravityLoads::Bodies::kArm, Eigen::VectorXd::Ones(2));
  EXPECT_EQ(loads.beyond(1, 0, Vec3::Zero()).force, kGravity);
  EXPECT_TRUE(payload_of(data).isZero(0.0));
}

}  // namespace
}  // namespace bathyal
