// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/touch_planning/forecast.hpp"

#include <gtest/gtest.h>

#include "bathyal/touch_planning/internal/candidates.hpp"
#include "bathyal/touch_planning/internal/plan_warnings.hpp"
#include "bathyal/touch_planning/internal/tip_model.hpp"
#include "support/simulated_touches.hpp"

namespace bathyal::touch_planning {
namespace {

Arm probing() { return built_arm(ur10e(), 0.0, 1); }

TEST(ForecastTouches, AKnownDistanceImprovesThePredictedTip) {
  const Arm arm = probing();
  Touches touches = touch(arm, three_points(), 10, 3);
  ForecastOptions options;
  options.workspace_poses = 50;
  const TouchForecast alone = forecast_touches(arm, touches, options);
  EXPECT_EQ(alone.tip_std.size(), 50U);
  EXPECT_EQ(alone.null_space.size(), 1U) << "the scale";
  ASSERT_EQ(alone.null_space_leading.size(), 1U);
  EXPECT_EQ(alone.null_space[0].find(alone.null_space_leading[0] + " "), 0U);
  EXPECT_EQ(alone.rank, alone.free - 1);
  touches.known_distances = {{0, 1, (three_points()[0] - three_points()[1]).norm()}};
  const TouchForecast with = forecast_touches(arm, touches, options);
  EXPECT_EQ(with.rank, with.free);
  EXPECT_LT(with.worst_tip_std, alone.worst_tip_std);
}

TEST(TipModel, TipsAreThoseOfTheArmAndJointsGoToTheirTargets) {
  const Arm arm = probing();
  const TouchModel model = make_touch_model(arm, Measurement{}, {});
  const RowMatrix q = touch_planning::random_poses(arm, 20, 5);
  EXPECT_TRUE((q.array() >= -2 * kPi).all() && (q.array() <= 2 * kPi).all());
  const Eigen::Matrix3Xd tips = tips_of(model, q, 1);
  for (Index i = 0; i < q.rows(); ++i) {
    const Pose pose = row_frames(arm, {q.row(i).data(), 6}).world_from_tool;
    EXPECT_LT((tips.col(i) - pose.translation()).norm(), 1e-12);
  }
  const Eigen::Matrix3Xd targets = tips.array() + 1e-3;
  const RowMatrix moved = joints_on_targets(model, q, targets, 2);
  EXPECT_LT((tips_of(model, moved, 1) - targets).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Candidates, TouchTheirPointAboveTheFloor) {
  const Arm arm = probing();
  const TouchModel model = make_touch_model(arm, Measurement{}, {});
  PlanTouchesOptions options;
  options.candidates = 40;
  options.floor = -0.05;
  const Vec3 point(0.6, 0.2, 0.3);
  const RowMatrix q = poses_on_point(arm, model, point, 0, options);
  ASSERT_GT(q.rows(), 1);
  EXPECT_LT((tips_of(model, q, 1).colwise() - point).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(allowed_rows(arm, q, options), q);
  options.floor = 1.0;
  EXPECT_EQ(allowed_rows(arm, q, options).rows(), 0);
}

TEST(PlanWarnings, NameTheLeadingParameterOfEachUndeterminedDirection) {
  TouchPlan plan(probing());
  plan.q = touch_planning::random_poses(plan.arm, 3, 1);
  plan.point = {0, 0, 0};
  plan.points = Eigen::Matrix3Xd::Zero(3, 1);
  plan.forecast.null_space = {"theta of row 1 +1, d of row 2 -0.5", "a of row 3 -1"};
  plan.forecast.null_space_leading = {"theta of row 1", "a of row 3"};
  PlanTouchesOptions options;
  options.points = plan.points;
  const auto texts = warnings_of(plan.arm, plan, 3, options, {});
  EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [](const std::string& text) {
    return text.find("the priors determine theta of row 1, a of row 3, each") != std::string::npos;
  }));
}

TEST(PlanWarnings, SayWhatDeterminesTheScaleAndWhichDistanceToMeasure) {
  TouchPlan plan(probing());
  plan.q = touch_planning::random_poses(plan.arm, 6, 1);
  plan.point = {0, 0, 0, 1, 1, 1};
  plan.points = Eigen::Matrix3Xd::Zero(3, 2);
  plan.points(0, 1) = 0.5;
  PlanTouchesOptions options;
  options.points = plan.points;
  const auto any_says = [&](const std::vector<std::string>& texts, const std::string& part) {
    return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
      return text.find(part) != std::string::npos;
    });
  };
  const auto texts = warnings_of(plan.arm, plan, 6, options, DistanceAdvice{0, 1, 2e-4});
  EXPECT_TRUE(any_says(texts, "do not determine the scale of the arm"));
  EXPECT_TRUE(any_says(texts, "between points 0 and 1 (0.5 m)"));
  options.known_distances = {{0, 1}};
  EXPECT_FALSE(any_says(warnings_of(plan.arm, plan, 6, options, {}), "scale of the arm"));
}

}  // namespace
}  // namespace bathyal::touch_planning
