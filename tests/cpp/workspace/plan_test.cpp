// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "scene/meshes.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Joints = std::vector<double>;

Joints row_of(const JointMatrix& q, Index i) {
  return {q.data() + i * q.cols(), q.data() + (i + 1) * q.cols()};
}

double least_distance(const Workspace& ws, const JointMatrix& q) {
  double least = std::numeric_limits<double>::infinity();
  for (const Clearance& clear : ws.clearance(view_of(q))) {
    least = std::min({least, clear.distance, clear.self_distance});
  }
  return least;
}

/// Rows no farther apart than `step` in any coordinate.
JointMatrix dense(const JointMatrix& q, double step) {
  std::vector<Eigen::RowVectorXd> rows{q.row(0)};
  for (Index i = 0; i + 1 < q.rows(); ++i) {
    const Eigen::RowVectorXd change = q.row(i + 1) - q.row(i);
    const int count = std::max(1, static_cast<int>(std::ceil(change.cwiseAbs().maxCoeff() / step)));
    for (int k = 1; k <= count; ++k) rows.push_back(q.row(i) + double(k) / count * change);
  }
  JointMatrix all(static_cast<Index>(rows.size()), q.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) all.row(static_cast<Index>(i)) = rows[i];
  return all;
}

/// From start to goal, at rest at both, rows within speed limits, free in between.
void expect_sound(const Workspace& ws, const Plan& plan, const Joints& start, const char* where) {
  ASSERT_EQ(to_text(plan.status), "solved") << where << ": " << plan.reason;
  EXPECT_TRUE(plan.reason.empty());
  ASSERT_EQ(static_cast<std::size_t>(plan.path.rows()), plan.time.size());
  EXPECT_EQ(row_of(plan.path, 0), start);
  EXPECT_EQ(plan.time.front(), 0.0);
  EXPECT_GE(least_distance(ws, dense(plan.path, 1e-3)), 0.0) << where;
  const auto inside = within_limits(ws.arm(), view_of(plan.path));
  EXPECT_TRUE(std::ranges::all_of(inside, [](bool yes) { return yes; })) << where;
  const MotionLimits limits = default_limits(ws.arm());
  for (Index i = 0; i + 1 < plan.path.rows(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    const double step = plan.time[row + 1] - plan.time[row];
    EXPECT_GT(step, 0.0);
    for (Index k = 0; k < plan.path.cols(); ++k) {
      EXPECT_LE(std::abs(plan.path(i + 1, k) - plan.path(i, k)),
                limits.velocity[static_cast<std::size_t>(k)] * step * (1.0 + 1e-9));
    }
  }
}

/// The planar arm and a post at a distance of 0.7 m: it passes only with its elbow bent.
Workspace behind_a_post() {
  const Arm arm = planar_arm();
  Surroundings around;
  around.capsules = capsules_of_rows(arm, std::vector<double>{0.03});
  around.keepouts.push_back(KeepOut::sphere(0.1, Vec3(0.7, 0.0, 0.0), {.name = "post"}));
  return Workspace(arm, around);
}

TEST(PlanMotion, AFreeStraightMotionIsTaken) {
  const Workspace ws(planar_arm(), {});
  const Joints start{0.0, 0.0}, goal{1.0, -0.5};
  const Plan plan = plan_motion(ws, start, goal);
  expect_sound(ws, plan, start, "free");
  EXPECT_EQ(row_of(plan.path, plan.path.rows() - 1), goal);
  for (Index i = 0; i < plan.path.rows(); ++i) {
    EXPECT_NEAR(plan.path(i, 1), -0.5 * plan.path(i, 0), 1e-12);
  }
  JointMatrix line(2, 2);
  line << 0.0, 0.0, 1.0, -0.5;
  EXPECT_EQ(plan.time, time_motion(ws.arm(), view_of(line)).time);
}

TEST(PlanMotion, APostIsPassedByBendingTheElbow) {
  const Workspace ws = behind_a_post();
  const Joints start{-0.6, 0.0}, goal{0.6, 0.0};
  JointMatrix line(2, 2);
  line << -0.6, 0.0, 0.6, 0.0;
  ASSERT_FALSE(ws.check_motion(view_of(line)).free);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Plan plan = plan_motion(ws, start, goal, {.seed = seed});
    expect_sound(ws, plan, start, "post");
    EXPECT_EQ(row_of(plan.path, plan.path.rows() - 1), goal);
    EXPECT_GT(plan.path.col(1).cwiseAbs().maxCoeff(), 1.5);
    EXPECT_LT(plan.time.back(), 20.0);
  }
}

TEST(PlanMotion, SameSeedSameBytes) {
  const Workspace ws = behind_a_post();
  const Joints start{-0.6, 0.0}, goal{0.6, 0.0};
  const Plan one = plan_motion(ws, start, goal, {.seed = 3});
  const Plan same = plan_motion(ws, start, goal, {.seed = 3});
  const Plan other = plan_motion(ws, start, goal, {.seed = 4});
  EXPECT_TRUE(one.path == same.path);
  EXPECT_EQ(one.time, same.time);
  EXPECT_EQ(one.checks, same.checks);
  EXPECT_FALSE(one.path.rows() == other.path.rows() && one.path == other.path);
}

Surroundings random_world(const Arm& arm, std::uint64_t seed) {
  RandomStream random(seed);
  Surroundings around;
  around.capsules = capsules_of_rows(arm, std::vector<double>{0.05});
  around.hull = Hull(test::box(Vec3(0.6, 0.3, 0.2), Vec3(-0.4, 0.0, -0.25)));
  const Pose world_from_vehicle =
      pose_of(random.uniform(-1, 1), 2.0, -3.0, 0.1, random.uniform(-0.2, 0.2));
  around.world_from_vehicle = world_from_vehicle;
  std::vector<TriangleMesh> meshes;
  for (int i = 0; i < 9; ++i) {
    const double angle = random.uniform(-2.5, 2.5), out = random.uniform(0.35, 0.75);
    const Vec3 centre(out * std::cos(angle), out * std::sin(angle), random.uniform(0.0, 0.9));
    if (i % 2 == 0) {
      around.keepouts.push_back(KeepOut::sphere(random.uniform(0.05, 0.15), centre));
    } else {
      const TriangleMesh box = test::box(Vec3(0.05, 0.1, 0.2), centre);
      PointMatrix moved = box.vertices();
      for (Index k = 0; k < moved.rows(); ++k) {
        moved.row(k) = (world_from_vehicle * Vec3(moved.row(k).transpose())).transpose();
      }
      meshes.emplace_back(std::move(moved), TriangleMatrix(box.triangles()));
    }
  }
  around.scene = Scene(meshes);
  return around;
}

TEST(PlanMotion, PathsInRandomWorldsAreFreeWhereverTheyAreSampled) {
  const Arm arm = panda();
  int around_something = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Workspace ws(arm, random_world(arm, seed));
    const JointMatrix drawn = random_poses(arm, 200, seed);
    std::vector<Joints> ends;
    for (Index i = 0; i < drawn.rows() && ends.size() < 2; ++i) {
      const JointMatrix row = drawn.row(i);
      if (least_distance(ws, row) > 0.01) ends.push_back(row_of(drawn, i));
    }
    ASSERT_EQ(ends.size(), 2U);
    JointMatrix line(2, arm.size());
    for (Index i = 0; i < 2; ++i) {
      line.row(i) = Eigen::Map<const Eigen::RowVectorXd>(ends[std::size_t(i)].data(), arm.size());
    }
    around_something += ws.check_motion(view_of(line)).free ? 0 : 1;
    expect_sound(ws, plan_motion(ws, ends[0], ends[1]), ends[0], std::to_string(seed).c_str());
  }
  EXPECT_GE(around_something, 3);
}

TEST(PlanMotion, PosesAndPointsAreReachedInTheWorld) {
  const Arm arm = panda();
  const Workspace ws(arm, random_world(arm, 5));
  const Pose world_from_vehicle = ws.surroundings().world_from_vehicle.at(0.0);
  const JointMatrix drawn = random_poses(arm, 60, 9);
  Joints start;
  int planned = 0;
  for (Index i = 0; i < drawn.rows() && planned < 4; ++i) {
    const JointMatrix row = drawn.row(i);
    if (least_distance(ws, row) < 0.02) continue;
    if (start.empty()) {
      start = row_of(drawn, i);
      continue;
    }
    const std::vector<double> tip = forward(ws.arm(), view_of(row));
    const Pose vehicle_from_tool(
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(tip.data()).eval());
    const Pose goal = world_from_vehicle * vehicle_from_tool;
    for (const bool point : {false, true}) {
      const Plan plan = point ? plan_motion(ws, start, PlanGoal(Vec3(goal.translation())))
                              : plan_motion(ws, start, PlanGoal(goal));
      expect_sound(ws, plan, start, point ? "point" : "pose");
      if (plan.path.rows() == 0) continue;
      const JointMatrix end = plan.path.bottomRows(1);
      const std::vector<double> reached = forward(ws.arm(), view_of(end));
      const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(reached.data());
      const Eigen::Matrix4d expected = vehicle_from_tool.matrix();
      EXPECT_LT((matrix.col(3) - expected.col(3)).norm(), 1e-5);
      if (!point) {
        EXPECT_LT((matrix - expected).norm(), 1e-5);
      }
    }
    ++planned;
  }
  EXPECT_EQ(planned, 4);
}

TEST(PlanMotion, SaysWhyThereIsNoPath) {
  const Workspace ws = behind_a_post();
  const Joints start{-0.6, 0.0}, at_post{0.0, 0.0}, free{0.6, 0.0};
  const auto status = [&](const Joints& from, const PlanGoal& goal,
                          const PlanOptions& options = {}) {
    const Plan plan = plan_motion(ws, from, goal, options);
    EXPECT_EQ(plan.path.rows(), 0);
    EXPECT_TRUE(plan.time.empty());
    EXPECT_FALSE(plan.reason.empty());
    return plan.status;
  };
  EXPECT_EQ(status(at_post, free), PlanStatus::kStartInCollision);
  EXPECT_EQ(status(start, at_post), PlanStatus::kGoalInCollision);
  EXPECT_EQ(status(start, Vec3(0.7, 0.0, 0.0)), PlanStatus::kGoalInCollision);
  EXPECT_EQ(status(start, Vec3(2.0, 0.0, 0.0)), PlanStatus::kUnreachable);
  EXPECT_EQ(status(start, Vec3(1e200, 0.0, 0.0)), PlanStatus::kUnreachable);
  EXPECT_EQ(status(start, Vec3(0.5, 0.0, 0.1)), PlanStatus::kUnreachable);
  EXPECT_EQ(status(start, free, {.max_checks = 3}), PlanStatus::kNoPath);
  EXPECT_EQ(status(start, free, {.max_seconds = 1e-9}), PlanStatus::kTimeLimit);
  EXPECT_NE(plan_motion(ws, at_post, free).reason.find("post"), std::string::npos);
}

TEST(PlanMotion, LimitsOfStartAndGoal) {
  const Arm limited = ur10e();
  const Workspace ws(limited, {});
  const Joints inside(6, 0.1);
  Joints outside = inside;
  outside[0] = 6.5;
  const Plan start = plan_motion(ws, outside, inside);
  EXPECT_EQ(start.status, PlanStatus::kStartOutsideLimits);
  ASSERT_EQ(start.way_out.rows(), 2);
  EXPECT_EQ(row_of(start.way_out, 0), outside);
  outside[0] = limited.upper()[0];
  EXPECT_EQ(row_of(start.way_out, 1), outside);
  outside[0] = 6.5;
  EXPECT_EQ(plan_motion(ws, inside, outside).status, PlanStatus::kGoalOutsideLimits);
}

TEST(PlanMotion, TheWayOutOfAContactLeadsOut) {
  const Workspace ws = behind_a_post();
  const Joints start{0.16, 0.0}, goal{0.6, 0.0};
  const Plan plan = plan_motion(ws, start, goal);
  EXPECT_EQ(plan.status, PlanStatus::kStartInCollision);
  ASSERT_EQ(plan.way_out.rows(), 2);
  EXPECT_EQ(row_of(plan.way_out, 0), start);
  const JointMatrix end = plan.way_out.bottomRows(1);
  EXPECT_GT(least_distance(ws, end), 0.0);
  EXPECT_EQ(plan_motion(ws, row_of(plan.way_out, 1), goal).status, PlanStatus::kSolved);
}

TEST(PlanMotion, AJointWithoutLimitsTakesTheShortWay) {
  const Workspace ws(planar_arm(), {});
  const Joints start{3.0, 0.3};
  // The tip where q = (−3, 0.3) has it: 0.28 rad on, not 6 back.
  const double x = 0.5 * std::cos(-3.0) + 0.4 * std::cos(-2.7);
  const double y = 0.5 * std::sin(-3.0) + 0.4 * std::sin(-2.7);
  const Plan plan = plan_motion(ws, start, Vec3(x, y, 0.0));
  ASSERT_EQ(plan.status, PlanStatus::kSolved);
  EXPECT_LT((plan.path.col(0).array() - 3.0).abs().maxCoeff(), 1.0);
  // Joint values are taken as they are.
  const Joints far{-3.0, 0.3};
  const Plan back = plan_motion(ws, start, far);
  EXPECT_EQ(row_of(back.path, back.path.rows() - 1), far);
}

TEST(PlanMotion, StartIsGoal) {
  const Workspace ws = behind_a_post();
  const Joints start{-0.6, 0.0};
  const Plan plan = plan_motion(ws, start, start);
  EXPECT_EQ(plan.status, PlanStatus::kSolved);
  EXPECT_EQ(plan.path.rows(), 1);
}

TEST(PlanMotion, Refusals) {
  const Workspace ws = behind_a_post();
  const Joints start{-0.6, 0.0}, goal{0.6, 0.0};
  const auto refused = [&](const Joints& from, const PlanGoal& to,
                           const PlanOptions& options = {}) {
    EXPECT_THROW(plan_motion(ws, from, to, options), std::invalid_argument);
  };
  refused({0.0}, goal);
  refused({0.0, kNaN}, goal);
  refused(start, Joints{0.0, kNaN});
  refused(start, Joints{0.0, 0.0, 0.0});
  refused(start, Vec3(kNaN, 0.0, 0.0));
  refused(start, Vec3(INFINITY, 0.0, 0.0));
  Pose sheared = Pose::Identity();
  sheared.linear()(0, 1) = 0.5;
  refused(start, sheared);
  refused(start, goal, {.max_checks = 0});
  refused(start, goal, {.max_seconds = 0.0});
  refused(start, goal, {.limits = {{0.0, 1.0}, {}, {}}});
  refused(start, goal, {.time = kNaN});
  refused(start, goal, {.goal_postures = 0});
}

}  // namespace
}  // namespace bathyal
