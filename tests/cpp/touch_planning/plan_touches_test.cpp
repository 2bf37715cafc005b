// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/touch_planning/plan_touches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bathyal/arm/kinematics.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/estimation/optimal_design.hpp"
#include "bathyal/identify/identify_arm.hpp"

namespace bathyal {
namespace {

constexpr double kPi = std::numbers::pi;

/// Six joints like those of a common arm, and a tool off the last axis.
Arm six_joints() {
  const std::vector<DhRow> rows{{0.0, kPi / 2, 0.18}, {-0.61, 0, 0},       {-0.57, 0, 0},
                                {0, kPi / 2, 0.17},   {0, -kPi / 2, 0.12}, {0, 0, 0.12}};
  std::vector<Joint> joints;
  for (int k = 0; k < 6; ++k) {
    Joint joint;
    joint.row = rows[static_cast<std::size_t>(k)];
    joint.coordinate = k;
    joint.lower = -kPi;
    joint.upper = kPi;
    joints.push_back(joint);
  }
  Arm arm("six", joints);
  arm.set_tool(Pose(Eigen::Translation3d(0.03, 0.02, 0.15)));
  return arm;
}

Eigen::Matrix3Xd two_points() {
  Eigen::Matrix3Xd points(3, 2);
  points << 0.6, 0.5, -0.2, 0.4, 0.2, 0.5;
  return points;
}

PlanTouchesOptions small() {
  PlanTouchesOptions options;
  options.points = two_points();
  options.known_distances = {{0, 1}};
  options.candidates = 150;
  options.forecast.workspace_poses = 100;
  return options;
}

// Choice ------------------------------------------------------------------------------------------

OptimalDesign random_design(int count, std::uint64_t seed, bool worst) {
  OptimalDesign design;
  RandomStream random(seed);
  const auto fill = [&](Index rows, Index columns) {
    Eigen::MatrixXd matrix(rows, columns);
    for (double& value : matrix.reshaped()) value = random.normal();
    return matrix;
  };
  design.touches = fill(3, 3 * count);
  design.point.assign(static_cast<std::size_t>(count), 0);
  design.points = 1;
  design.prior = 1e-3 * Eigen::MatrixXd::Identity(6, 6);
  if (worst) design.tips = fill(3, 3 * 20);
  return design;
}

/// What a choice is worth, by the definition: ln det, or the worst variance, of the columns.
double worth(const OptimalDesign& design, const std::vector<int>& chosen) {
  Eigen::MatrixXd information = design.prior;
  for (const int touch : chosen) {
    Eigen::MatrixXd rows(6, 3);
    rows << design.touches.middleCols(3 * touch, 3), -Eigen::Matrix3d::Identity();
    information += rows * rows.transpose();
  }
  const Eigen::MatrixXd known = information.inverse().topLeftCorner(3, 3);
  if (design.tips.cols() == 0) return std::log(known.determinant());
  double worst = 0.0;
  for (Index s = 0; s < design.tips.cols() / 3; ++s) {
    const Eigen::Matrix3d tip = design.tips.middleCols<3>(3 * s);
    worst = std::max(worst, (tip.transpose() * known * tip).trace());
  }
  return std::log(worst);
}

/// Every choice of five touches among twelve.
std::vector<double> all_worths(const OptimalDesign& design) {
  std::vector<double> out;
  for (int bits = 0; bits < 1 << 12; ++bits) {
    std::vector<int> chosen;
    for (int i = 0; i < 12; ++i) {
      if ((bits >> i & 1) != 0) chosen.push_back(i);
    }
    if (chosen.size() == 5) out.push_back(worth(design, chosen));
  }
  std::sort(out.begin(), out.end());
  return out;
}

class Choice : public testing::TestWithParam<bool> {};

TEST_P(Choice, IsAmongTheBestTwentiethOfAll) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const OptimalDesign design = random_design(12, seed, GetParam());
    const std::vector<double> all = all_worths(design);
    ASSERT_EQ(all.size(), 792U);
    const std::vector<int> chosen = exchange_select(design, 5, 10, 1);
    EXPECT_LE(worth(design, chosen), all[all.size() / 20]) << "seed " << seed;
  }
}

TEST_P(Choice, TakesNoTouchTwiceAndAllWhereThereAreNoMore) {
  std::vector<int> chosen = exchange_select(random_design(9, 1, GetParam()), 12, 3, 1);
  std::sort(chosen.begin(), chosen.end());
  EXPECT_EQ(chosen, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

INSTANTIATE_TEST_SUITE_P(Of, Choice, testing::Bool());

TEST(Choice, LeavesNoPointWithOneTouch) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    OptimalDesign design = random_design(30, seed, false);
    for (std::size_t i = 0; i < 30; ++i) design.point[i] = static_cast<int>(i) % 3;
    design.points = 3;
    design.prior = 1e-3 * Eigen::MatrixXd::Identity(12, 12);
    const auto touched = [&](int count) {
      std::vector<int> by_point(3, 0);
      for (const int touch : exchange_select(design, count, 10, 1)) ++by_point[design.point[touch]];
      return by_point;
    };
    for (const int count : touched(6)) EXPECT_GE(count, 2) << "seed " << seed;
    for (const int count : touched(8)) EXPECT_GE(count, 2) << "seed " << seed;
    EXPECT_EQ(touched(3), (std::vector<int>{3, 0, 0}));
  }
}

// Forecast ----------------------------------------------------------------------------------------

TEST(ForecastTouches, IsWhatIdentifyArmReports) {
  const Arm arm = six_joints();
  const PlanTouchesOptions options = small();
  const TouchPlan plan = plan_touches(arm, 30, options);
  Touches touches;
  touches.q = plan.q;
  touches.point = plan.point;
  touches.known_distances = {{0, 1, (plan.points.col(0) - plan.points.col(1)).norm()}};
  IdentifyOptions identify;
  identify.noise = options.forecast.noise;
  identify.length_prior = options.forecast.length_prior;
  identify.angle_prior = options.forecast.angle_prior;
  for (const char* name : {"tool_x", "tool_y", "tool_z"}) {
    identify.priors[name] = options.forecast.tool_prior;
  }
  const ArmFit fit = identify_arm(arm, touches, identify);
  EXPECT_EQ(fit.rank, plan.forecast.rank);
  EXPECT_EQ(static_cast<int>(fit.parameters.size()), plan.forecast.parameters);
  const auto covariance = tip_covariance(fit, plan.forecast.workspace);
  for (std::size_t i = 0; i < covariance.size(); ++i) {
    EXPECT_NEAR(std::sqrt(covariance[i].trace()), plan.forecast.tip_std[i],
                1e-4 * plan.forecast.tip_std[i]);
  }
}

TEST(ForecastTouches, ScatterTellsNothingOfTheSize) {
  const Arm arm = six_joints();
  PlanTouchesOptions options = small();
  options.known_distances.clear();
  const TouchPlan plan = plan_touches(arm, 30, options);
  ASSERT_EQ(plan.forecast.rank, plan.forecast.free - 1);
  Touches touches;
  touches.q = plan.q;
  touches.point = plan.point;
  RandomStream random(5);
  for (double& value : touches.q.reshaped()) value += 1e-3 * random.normal();
  const TouchForecast scattered = forecast_touches(arm, touches, options.forecast);
  EXPECT_EQ(scattered.rank, plan.forecast.rank);
}

TEST(ForecastTouches, Refuses) {
  const Arm arm = six_joints();
  Touches touches;
  touches.q = RowMatrix::Random(6, 6);
  touches.point = {0, 0, 0, 1, 1, 1};
  ForecastOptions options;
  options.workspace = RowMatrix::Zero(2, 5);
  EXPECT_THROW(forecast_touches(arm, touches, options), std::invalid_argument);
  options.workspace = RowMatrix::Constant(2, 6, NAN);
  EXPECT_THROW(forecast_touches(arm, touches, options), std::invalid_argument);
  touches.tool = {0, 0, 0, 1, 1, 1};
  EXPECT_THROW(forecast_touches(arm, touches), std::invalid_argument);
}

// Plan --------------------------------------------------------------------------------------------

TEST(PlanTouches, TouchesWhatItSaysWithinTheLimits) {
  const Arm arm = six_joints();
  PlanTouchesOptions options = small();
  options.floor = 0.0;
  options.feasible = [](const RowMatrix& q) {
    std::vector<bool> answers;
    for (Index i = 0; i < q.rows(); ++i) answers.push_back(q(i, 0) > -2.0);
    return answers;
  };
  const TouchPlan plan = plan_touches(arm, 20, options);
  ASSERT_EQ(plan.q.rows(), 20);
  const std::vector<double> links =
      forward_links(arm, JointView(plan.q.data(), plan.q.rows(), plan.q.cols()));
  const std::vector<double> tips =
      forward(arm, JointView(plan.q.data(), plan.q.rows(), plan.q.cols()));
  for (int i = 0; i < 20; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(tips[static_cast<std::size_t>(16 * i + 4 * axis + 3)],
                  plan.points(axis, plan.point[static_cast<std::size_t>(i)]), 1e-12);
    }
    for (int link = 0; link < 7; ++link) {
      EXPECT_GE(links[static_cast<std::size_t>(16 * (7 * i + link) + 11)], -1e-12);
    }
    EXPECT_GT(plan.q(i, 0), -2.0);
    EXPECT_LE(plan.q.row(i).cwiseAbs().maxCoeff(), kPi);
    EXPECT_GE(plan.point[i], plan.point[std::max(i - 1, 0)]);
  }
}

TEST(PlanTouches, SameBytesForAnyNumberOfThreads) {
  PlanTouchesOptions options = small();
  const auto planned = [&](int threads) {
    options.forecast.num_threads = threads;
    return plan_touches(six_joints(), 12, options);
  };
  const TouchPlan one = planned(1);
  const TouchPlan three = planned(3);
  EXPECT_EQ(one.q, three.q);
  EXPECT_EQ(one.forecast.tip_std, three.forecast.tip_std);
}

TEST(PlanTouches, EachCriterionIsBestAtItsOwn) {
  const auto planned = [](TouchCriterion criterion) {
    PlanTouchesOptions options = small();
    options.criterion = criterion;
    return plan_touches(six_joints(), 24, options).forecast;
  };
  const TouchForecast worst = planned(TouchCriterion::kWorstTip);
  const TouchForecast determinant = planned(TouchCriterion::kDOptimal);
  const TouchForecast index = planned(TouchCriterion::kO1);
  EXPECT_LT(worst.worst_tip_std, determinant.worst_tip_std);
  EXPECT_LT(worst.worst_tip_std, index.worst_tip_std);
  EXPECT_GT(determinant.log_det, worst.log_det);
  EXPECT_GT(index.o1, worst.o1);
}

TEST(PlanTouches, Refuses) {
  const Arm arm = six_joints();
  EXPECT_THROW(plan_touches(arm, 1, small()), std::invalid_argument);
  const auto refused = [&](auto change) {
    PlanTouchesOptions options = small();
    change(options);
    EXPECT_THROW(plan_touches(arm, 10, options), std::invalid_argument);
  };
  refused([](auto& o) { o.points(0, 1) = 9.0; });
  refused([](auto& o) { o.points(0, 1) = NAN; });
  refused([](auto& o) { o.known_distances = {{0, 2}}; });
  refused([](auto& o) { o.known_distances = {{1, 1}}; });
  refused([](auto& o) { o.known_points = {-1}; });
  refused([](auto& o) { o.forecast.noise = 0.0; });
  refused([](auto& o) { o.forecast.angle_prior = NAN; });
  refused([](auto& o) { o.floor = 3.0; });
  refused([](auto& o) { o.candidates = 1; });
  refused([](auto& o) { o.passes = -1; });
  refused([](auto& o) { o.feasible = [](const RowMatrix&) { return std::vector<bool>{true}; }; });
  refused([](auto& o) {
    o.feasible = [](const RowMatrix& q) {
      return std::vector<bool>(static_cast<std::size_t>(q.rows()), false);
    };
  });
}

}  // namespace
}  // namespace bathyal
