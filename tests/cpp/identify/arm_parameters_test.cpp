// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/arm_parameters.hpp"

#include <gtest/gtest.h>

#include "bathyal/identify/model/nearest_pose.hpp"
#include "support/simulated_touches.hpp"

namespace bathyal {
namespace {

ArmParameters of_touches(const Arm& arm) {
  Measurement measurement;
  return make_parameters(arm, measurement, {Pose::Identity()}, {arm.tool()}, {}, {});
}

TEST(ArmParameters, ParallelAxesHaveBetaInPlaceOfD) {
  const ArmParameters parameters = of_touches(ur10e());
  EXPECT_EQ(parameters.parameters.size(), 27U);  // four a row, three of the tool
  EXPECT_GE(find_parameter(parameters.parameters, "beta_2"), 0);
  EXPECT_EQ(find_parameter(parameters.parameters, "d_2"), -1);
  EXPECT_GE(find_parameter(parameters.parameters, "d_1"), 0);
}

TEST(ArmParameters, StateAtNominalIsTheArmAndEachParameterChangesItsOwnNumber) {
  const Arm arm = ur10e();
  const ArmParameters parameters = of_touches(arm);
  Eigen::VectorXd x = parameters.nominal();
  EXPECT_EQ(state_at(parameters, x).arm.joints()[1].row.a, arm.joints()[1].row.a);
  x[find_parameter(parameters.parameters, "a_2")] += 0.01;
  x[find_parameter(parameters.parameters, "tool_z")] += 0.02;
  const ArmState state = state_at(parameters, x);
  EXPECT_EQ(state.arm.joints()[1].row.a, arm.joints()[1].row.a + 0.01);
  EXPECT_EQ(state.arm.joints()[2].row.a, arm.joints()[2].row.a);
  EXPECT_NEAR(state.tools[0].translation().z(), arm.tool().translation().z() + 0.02, 1e-15);
}

TEST(NearestPose, BringsTheTipOntoItsTargetByASmallMotion) {
  const Arm arm = built_arm(ur10e(), 0.0, 1);
  const ArmParameters parameters = of_touches(arm);
  const ChainDerivatives chain(parameters, parameters.nominal(), {});
  Eigen::VectorXd q(6);
  q << 0.3, -1.0, 1.2, 0.4, 0.9, -0.2;
  ChainFrames frames;
  Vec3 tip;
  chain.joint_jacobian(q.data(), kNoRow, 0, 0, frames, tip);
  const Vec3 target = tip + Vec3(2e-3, -1e-3, 1e-3);
  const auto miss = [&](const Vec3& at) { return Vec3(target - at); };
  const Eigen::VectorXd moved = nearest_pose(chain, q, kNoRow, 0, 0, frames, miss);
  chain.joint_jacobian(moved.data(), kNoRow, 0, 0, frames, tip);
  EXPECT_LT((tip - target).norm(), 1e-11);
  EXPECT_LT((moved - q).norm(), 0.02);

  const auto out_of_reach = [&](const Vec3& at) { return Vec3(Vec3(9.0, 0.0, 0.0) - at); };
  EXPECT_EQ(nearest_pose(chain, q, kNoRow, 0, 0, frames, out_of_reach), q);
}

}  // namespace
}  // namespace bathyal
