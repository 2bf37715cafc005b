// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/internal/initial_guess.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "bathyal/arm/dh.hpp"
#include "support/simulated_touches.hpp"

namespace bathyal::identify {
namespace {

/// Eq 12-16 on an arm that is as drawn: exact.
TEST(FindStart, TheToolOfExactTouches) {
  const Arm arm = built_arm(ur10e(), 0.0, 1, Vec3(0.03, -0.02, 0.2));
  const Measurement m = to_measurement(ur10e(), touch(arm, three_points(), 7, 2));
  const InitialGuess start = find_initial_guess(ur10e(), m, false, false);
  EXPECT_LT((start.tools[0].translation() - Vec3(0.03, -0.02, 0.2)).norm(), 1e-12);
}

TEST(FindStart, TheArmsOwnToolWhenGiven) {
  Arm drawing = ur10e();
  Pose tool = Pose::Identity();
  tool.translation() = Vec3(1.0, 2.0, 3.0);
  drawing.set_tool(tool);
  const Measurement m =
      to_measurement(drawing, touch(built_arm(ur10e(), 0.0, 1), three_points(), 7, 2));
  EXPECT_EQ(find_initial_guess(drawing, m, true, false).tools[0].translation(), tool.translation());
}

TEST(FindStart, BaseAndToolOfTrackedPoses) {
  Arm truth = built_arm(ur10e(), 0.0, 1);
  truth.set_base(pose_of(1.0, -2.0, 0.3, 0.7, -0.2));
  for (const bool rotations : {false, true}) {
    const Measurement m = to_measurement(ur10e(), track(truth, 40, rotations, 3));
    const InitialGuess start = find_initial_guess(ur10e(), m, false, true);
    EXPECT_LT((start.bases[0].matrix() - truth.base().matrix()).norm(), 1e-10);
    EXPECT_LT((start.tools[0].matrix() - truth.tool().matrix()).norm(), 1e-10);
  }
}

/// Where the first joints meet in a point the flange moves as a lever of the tool does, and the
/// linear equations leave matrices to choose from that are no rotations.
TEST(FindStart, BaseAndToolOfArmsWhoseJointsMeet) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  for (const DhRow& last : {DhRow{0.3464, kQuarter, 0.0, 0.0}, DhRow{0.0, 0.0, 0.4139, 0.0}}) {
    DhTable table;
    table.rows = {{0.0, kQuarter, 0.2385, 0.0}, {0.0, 0.0, 0.1599, 0.0}, last};
    table.types.assign(3, JointType::kRevolute);
    const Arm drawing = arm_from_dh(table);
    Arm truth = built_arm(drawing, 1e-3, 1);
    truth.set_base(pose_of(1.0, -2.0, 0.3, 0.7, -0.2));
    const Tracked tracked = track(truth, 60, false, 3);
    const InitialGuess start =
        find_initial_guess(drawing, to_measurement(drawing, tracked), false, true);
    Arm found = drawing;
    found.set_base(start.bases[0]);
    found.set_tool(start.tools[0]);
    const RowMatrix reached = track(found, 60, false, 3).position;
    EXPECT_LT((reached - tracked.position).rowwise().norm().maxCoeff(), 0.02);
  }
}

TEST(FindStart, ThePlaneThatWasTouched) {
  const Arm arm = built_arm(ur10e(), 0.0, 1);
  Touches touches =
      touch(arm, {{0.5, 0.5, 0.2}, {-0.5, 0.5, 0.2}, {0.3, -0.6, 0.2}, {0.7, 0.1, 0.2}}, 6, 4);
  TouchedPlane deck{"deck", {}};
  for (int i = 0; i < 24; i += 2) deck.rows.push_back(i);
  touches.planes = {deck};
  const InitialGuess start =
      find_initial_guess(ur10e(), to_measurement(ur10e(), touches), false, false);
  ASSERT_EQ(start.planes.size(), 1u);
  EXPECT_NEAR(std::abs(start.planes[0].normal.z()), 1.0, 1e-12);
  EXPECT_NEAR(start.planes[0].center.z(), 0.2, 1e-12);
}

/// The first joint never moves, nor does the tool turn: what poses do not determine stays small.
TEST(FindStart, NothingRunsAwayWhenPosesTellNothing) {
  Tracked tracked = track(built_arm(ur10e(), 0.0, 1), 3, false, 3);
  const InitialGuess start =
      find_initial_guess(ur10e(), to_measurement(ur10e(), tracked), false, true);
  EXPECT_LT(start.tools[0].translation().norm(), 10.0);
  EXPECT_LT(start.bases[0].translation().norm(), 10.0);
}

}  // namespace
}  // namespace bathyal::identify
