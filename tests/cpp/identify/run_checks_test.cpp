// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/run_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/identify/identify_arm.hpp"
#include "support/simulated_touches.hpp"

namespace bathyal {
namespace {

constexpr double kNoise = 1e-4;

/// A UR10e with a probe: a tip on the last axis would not see that joint turn.
Arm probing() {
  Arm arm = ur10e();
  arm.set_tool(pose_of(0.06, 0.02, 0.1, 0.0, 0.0));
  return arm;
}

/// Poses of one whose second link is 1 mm longer than drawn, measured with noise; joint 2 is
/// off by `sag` times cos q2, which nobody recorded.
Tracked measured(Index count, double sag = 0.0) {
  Tracked tracked;
  tracked.q.resize(count, 6);
  tracked.position.resize(count, 3);
  const Arm drawn = probing();
  std::vector<Joint> joints = drawn.joints();
  joints[1].row.a += 1e-3;
  Arm built("built", joints, {}, drawn.root(), drawn.flange());
  built.set_tool(drawn.tool());
  for (Index i = 0; i < count; ++i) {
    RandomStream random(5, static_cast<std::uint64_t>(i));
    RowMatrix q(1, 6);
    for (Index j = 0; j < 6; ++j) q(0, j) = random.uniform(-1.5, 1.5);
    tracked.q.row(i) = q;
    q(0, 1) += sag * std::cos(q(0, 1));
    RowFrames frames;
    compute_row_frames(built, {q.data(), 6}, frames);
    tracked.position.row(i) = frames.world_from_tool.translation().transpose();
    for (Index axis = 0; axis < 3; ++axis) tracked.position(i, axis) += kNoise * random.normal();
  }
  return tracked;
}

bool any_says(const ArmFit& fit, const std::string& part) {
  return std::any_of(fit.warnings.begin(), fit.warnings.end(),
                     [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

TEST(FTail, WithTwoAboveItIsAPower) {
  for (const double below : {1.0, 3.0, 10.0, 150.0}) {
    for (const double f : {1e-6, 0.1, 1.0, 3.0, 40.0}) {
      const double exact = std::pow(1.0 + 2.0 * f / below, -below / 2.0);
      EXPECT_NEAR(f_tail(f, 2.0, below) / exact, 1.0, 1e-9) << f << " " << below;
    }
  }
}

TEST(FTail, TheReciprocalChangesSides) {
  for (const double f : {0.2, 0.9, 1.7, 6.0}) {
    EXPECT_NEAR(f_tail(f, 7.0, 31.0) + f_tail(1.0 / f, 31.0, 7.0), 1.0, 1e-12);
  }
}

TEST(FTail, Ends) {
  EXPECT_EQ(f_tail(0.0, 3.0, 5.0), 1.0);
  EXPECT_EQ(f_tail(-1.0, 3.0, 5.0), 1.0);
  EXPECT_EQ(f_tail(1e300, 36.0, 3000.0), 0.0);
}

TEST(FTest, IsOfTheMeanSquareOverThatOfTheRest) {
  const FTest test = f_test(30.0, 3.0, 50.0, 23.0);
  EXPECT_DOUBLE_EQ(test.p, f_tail(10.0, 3.0, 20.0));
  EXPECT_DOUBLE_EQ(test.explained, 27.0);
  EXPECT_DOUBLE_EQ(test.share, 0.54);
  EXPECT_EQ(f_test(1.0, 3.0, 50.0, 23.0).share, 0.0);
  EXPECT_EQ(f_test(50.0, 3.0, 50.0, 23.0).p, 1.0);
}

TEST(Examine, CleanPosesAreNotDoubted) {
  const ArmFit fit = identify_arm(probing(), measured(80));
  EXPECT_TRUE(fit.warnings.empty()) << fit.warnings.front();
  EXPECT_TRUE(fit.outliers.empty());
  EXPECT_GT(fit.structure_p, 1e-3);
}

TEST(Examine, ExactPosesAreNotDoubted) {
  Tracked tracked = measured(60);
  // The tips of the arm that was found: residuals are tip minus measured place.
  tracked.position += identify_arm(probing(), tracked).residuals.transpose();
  const ArmFit fit = identify_arm(probing(), tracked);
  EXPECT_LT(fit.rms_after, 1e-6);
  EXPECT_TRUE(fit.outliers.empty());
}

TEST(Examine, OutliersAreNamedHoweverManySmearTheFit) {
  Tracked tracked = measured(60);
  std::vector<int> rows;
  for (int row = 2; row < 60; row += 5) {
    tracked.position(row, row % 3) += 0.05;
    rows.push_back(row);
  }
  const ArmFit fit = identify_arm(probing(), tracked);
  ASSERT_EQ(fit.outliers.size(), rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(fit.outliers[k].row, rows[k]);
    EXPECT_NEAR(fit.outliers[k].distance, 0.05, 1e-3);
    EXPECT_FALSE(fit.outliers[k].fits.has_value());
  }
  EXPECT_TRUE(any_says(fit, "12 rows lie far"));
}

TEST(Examine, WhatFollowsAJointIsNamedWithIt) {
  const ArmFit fit = identify_arm(probing(), measured(80, 3e-3));
  EXPECT_LT(fit.structure_p, 1e-6);
  EXPECT_TRUE(any_says(fit, "Geometry is not enough"));
}

/// Travel and an arm that shrinks by as much leave tips where they are, but for the scatter: that
/// follows no joint.
TEST(Examine, ScatterOfSlidingTouchesFollowsNoJoint) {
  DhTable table;
  table.rows = {{0.1, -kPi / 2, 0.8, 0, 0}, {0, kPi / 2, 0.2, 0, 0},  {0.45, 0, 0.15, 0, 0},
                {0, kPi / 2, 0, 0, 0},      {0, -kPi / 2, 0.4, 0, 0}, {0.08, kPi / 2, 0, 0, 0}};
  table.types.assign(6, JointType::kRevolute);
  table.types[0] = JointType::kPrismatic;
  const Arm drawing = arm_from_dh(table);
  const Arm built = built_arm(drawing, 1e-3, 1);
  for (const double scatter : {1e-4, 1e-3, 3e-3}) {
    Touches touches = touch(built, {{0.3, 0.2, 1.0}, {0.1, -0.4, 0.8}, {-0.3, 0.1, 1.2}}, 30, 2);
    add_scatter(scatter, 3, touches);
    const ArmFit fit = identify_arm(drawing, touches);
    EXPECT_GT(fit.structure_p, 1e-2) << scatter;
    EXPECT_FALSE(any_says(fit, "Geometry is not enough"));
  }
}

TEST(Examine, ManyPosesAreThinnedAndStillSpeak) {
  EXPECT_LT(identify_arm(probing(), measured(2500, 1e-3)).structure_p, 1e-6);
}

TEST(Examine, SameForAnyNumberOfThreads) {
  Tracked tracked = measured(300);
  tracked.position(7, 0) += 0.05;
  IdentifyOptions one;
  one.num_threads = 1;
  IdentifyOptions eight;
  eight.num_threads = 8;
  const ArmFit first = identify_arm(probing(), tracked, one);
  const ArmFit second = identify_arm(probing(), tracked, eight);
  EXPECT_EQ(first.structure_p, second.structure_p);
  EXPECT_EQ(first.warnings, second.warnings);
  ASSERT_EQ(second.outliers.size(), 1U);
  EXPECT_EQ(first.outliers[0].distance, second.outliers[0].distance);
}

}  // namespace
}  // namespace bathyal
