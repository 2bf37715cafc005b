// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/stepping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/workspace/internal/bodies.hpp"
#include "bathyal/workspace/motion/internal/proximity.hpp"
#include "bathyal/workspace/motion/motion_timing.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

std::span<const double> row(const JointMatrix& q, Index i = 0) {
  return {q.data() + i * q.cols(), static_cast<std::size_t>(q.cols())};
}

Pose tip_of(const Arm& arm, const JointMatrix& q, Index i = 0) {
  return row_frames(arm, row(q, i)).world_from_tool;
}

Pose at(const Vec3& point) { return Pose(Eigen::Translation3d(point)); }

Surroundings with_radius(const Arm& arm, double radius) {
  Surroundings around;
  around.capsules = capsules_of_rows(arm, std::vector<double>{radius});
  return around;
}

/// Rates and their changes of rows by finite differences, over the limits: 1 or less.
double worst_rate(const Arm& arm, const Move& move) {
  const std::vector<double> velocity = default_limits(arm).velocity;
  const std::vector<double> acceleration = default_acceleration(arm);
  double worst = 0.0;
  const Index legs = move.path.rows() - 1;
  for (Index k = 0; k < move.path.cols(); ++k) {
    double rate = 0.0, duration = 0.0;
    const auto joint = static_cast<std::size_t>(k);
    for (Index i = 0; i <= legs; ++i) {
      const double next_duration = i < legs ? move.time[static_cast<std::size_t>(i) + 1] -
                                                  move.time[static_cast<std::size_t>(i)]
                                            : 0.0;
      const double next = i < legs ? (move.path(i + 1, k) - move.path(i, k)) / next_duration : 0.0;
      worst = std::max(worst, std::abs(next) / velocity[joint]);
      worst = std::max(
          worst, std::abs(next - rate) / (0.5 * (duration + next_duration)) / acceleration[joint]);
      rate = next, duration = next_duration;
    }
  }
  return worst;
}

double least_distance(const Workspace& ws, const Move& move) {
  double least = std::numeric_limits<double>::infinity();
  for (const Clearance& clear : ws.clearance(view_of(move.path))) {
    least = std::min(least, clear.distance);
  }
  return least;
}

TEST(Proximity, GradientsAreThoseOfFiniteDifferences) {
  for (const Arm& arm : {panda(), irregular_arm(4)}) {
    Surroundings around = with_radius(arm, 0.05);
    around.keepouts.push_back(KeepOut::sphere(0.2, Vec3(0.6, 0.3, 0.5), {.frame = "world"}));
    around.keepouts.push_back(KeepOut::half_space(Plane(Vec3::UnitZ(), -2.0)));
    around.world_from_vehicle = Pose(Eigen::Translation3d(0.1, -0.2, 0.3));
    const workspace::Bodies bodies = workspace::make_bodies(arm, around);
    workspace::Posture posture(bodies, around.world_from_vehicle);
    const JointMatrix q = random_poses(arm, 20, 5);
    const auto pairs_at = [&](const JointMatrix& one) {
      posture.set(row(one), 0.0);
      return workspace::near_pairs(bodies, posture, 10.0, TipContact::kForbidden);
    };
    int compared = 0;
    for (Index i = 0; i < q.rows(); ++i) {
      const auto pairs = pairs_at(q.row(i));
      for (Index k = 0; k < arm.size(); ++k) {
        constexpr double kStep = 1e-6;
        JointMatrix low = q.row(i), high = q.row(i);
        low(0, k) -= kStep;
        high(0, k) += kStep;
        const auto before = pairs_at(low), after = pairs_at(high);
        ASSERT_EQ(before.size(), pairs.size());
        for (std::size_t p = 0; p < pairs.size(); ++p) {
          if (pairs[p].distance < 0.0) continue;
          const double slope = (after[p].distance - before[p].distance) / (2.0 * kStep);
          // At a kink (the nearest point jumps) either slope is right.
          const double left = (pairs[p].distance - before[p].distance) / kStep;
          if (std::abs(left - slope) > 1e-4) continue;
          EXPECT_NEAR(pairs[p].gradient[k], slope, 1e-5);
          ++compared;
        }
      }
    }
    EXPECT_GT(compared, 500);
  }
}

TEST(MoveTip, InOpenWaterTheTipComesThereStraightWithinLimitsAndRates) {
  const Arm arm = panda();
  const Workspace ws(arm, with_radius(arm, 0.05));
  JointMatrix start(1, 7), end(1, 7);
  start << 0.0, -0.4, 0.0, -2.0, 0.0, 1.8, 0.5;
  end << 0.5, 0.1, -0.2, -1.6, 0.2, 2.0, 0.1;
  const Pose goal = tip_of(arm, end), from = tip_of(arm, start);
  const Move move = move_tip(ws, row(start), goal);
  ASSERT_EQ(move.status, MoveStatus::kReached) << move.reason;
  EXPECT_LE(move.position_error, 1e-4);
  EXPECT_LE(move.angle_error, 1e-3);
  EXPECT_EQ(move.path.row(0), start.row(0));
  EXPECT_EQ(std::ssize(move.time), move.path.rows());
  EXPECT_LE(worst_rate(arm, move), 1.0 + 1e-9);
  const Vec3 line = (goal.translation() - from.translation()).normalized();
  for (Index i = 0; i < move.path.rows(); ++i) {
    const Vec3 offset = tip_of(arm, move.path, i).translation() - from.translation();
    EXPECT_LT((offset - line.dot(offset) * line).norm(), 2e-3);
    EXPECT_TRUE((move.path.row(i).transpose().array() >= arm.lower().array()).all());
    EXPECT_TRUE((move.path.row(i).transpose().array() <= arm.upper().array()).all());
  }
  EXPECT_TRUE(ws.check_motion(view_of(move.path)).free);
}

TEST(MoveTip, RandomPosesOfAPandaAreMostlyReached) {
  const Arm arm = panda();
  const Workspace ws(arm, with_radius(arm, 0.05));
  const JointMatrix q = random_poses(arm, 60, 8);
  int reached = 0;
  for (Index i = 0; i + 1 < q.rows(); i += 2) {
    MoveOptions options;
    options.task = InverseTask::kPosition;
    const Move move = move_tip(ws, row(q, i), tip_of(arm, q, i + 1), options);
    if (move.status == MoveStatus::kReached) ++reached;
    EXPECT_NE(move.status, MoveStatus::kUnreachable);
    EXPECT_LE(worst_rate(arm, move), 1.0 + 1e-9);
  }
  EXPECT_GE(reached, 20);
}

TEST(MoveTip, ThePapersStepsEndWhereTheArmsPseudoInverseEnds) {
  const Arm arm = panda();
  Surroundings around = with_radius(arm, 0.05);
  around.vehicle_from_base = pose_of(0.1, 0.2, 0.3, 0.4, 0.5);
  around.world_from_vehicle = pose_of(-1.0, 0.5, -2.0, 0.2, -0.3);
  const Workspace ws(arm, around);
  JointMatrix start(1, 7), end(1, 7);
  start << 0.0, -0.4, 0.0, -2.0, 0.0, 1.8, 0.5;
  end << 0.5, 0.1, -0.2, -1.6, 0.2, 2.0, 0.1;
  const Pose in_vehicle = tip_of(ws.arm(), end);
  for (const InverseTask task :
       {InverseTask::kPosition, InverseTask::kPositionAxis, InverseTask::kPose}) {
    MoveOptions options{.method = MoveMethod::kPseudoInverse, .task = task};
    const Move move =
        move_tip(ws, row(start), around.world_from_vehicle.at(0.0) * in_vehicle, options);
    ASSERT_EQ(move.status, MoveStatus::kReached) << move.reason;
    EXPECT_LE(move.position_error, 1e-2);
    InverseOptions plain{.task = task, .method = InverseMethod::kPseudoInverse};
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> target = in_vehicle.matrix();
    const InverseResult expected = inverse(ws.arm(), {target.data(), 16}, view_of(start), plain);
    EXPECT_EQ(move.path.rows(), expected.iterations[0] + 1);
    EXPECT_LT((move.path.bottomRows(1) - expected.q).norm(), 1e-9);
    EXPECT_LE(worst_rate(arm, move), 1.0 + 1e-9);
  }
}

/// The tip at (0.5, 0.4), to (0.5, −0.4), and a ball between that reaches over the straight way.
struct BallBetween {
  Arm arm = panda();
  JointMatrix start = JointMatrix::Zero(1, 7);
  Surroundings around = with_radius(arm, 0.03);
  Pose goal;

  explicit BallBetween(double above) {
    start << 0.6, 0.3, 0.0, -2.0, 0.0, 2.3, 0.5;
    const Pose tip = tip_of(arm, start);
    goal = at(Vec3(tip.translation().x(), -tip.translation().y(), tip.translation().z()));
    const Vec3 middle(tip.translation().x(), 0.0, tip.translation().z() + above);
    around.keepouts.push_back(KeepOut::sphere(0.12, middle, {.name = "ball"}));
  }
};

TEST(MoveTip, SlidesAlongAKeepOutAtWhichThePapersStepsEnd) {
  const BallBetween scene(-0.08);
  const Workspace ws(scene.arm, scene.around);
  MoveOptions options{.task = InverseTask::kPosition};
  const Move damped = move_tip(ws, row(scene.start), scene.goal, options);
  EXPECT_EQ(damped.status, MoveStatus::kReached) << damped.reason;
  EXPECT_GT(least_distance(ws, damped), 0.0);
  EXPECT_LT(least_distance(ws, damped), 0.02);  // it was in the way
  EXPECT_LE(worst_rate(scene.arm, damped), 1.0 + 1e-9);
  options.method = MoveMethod::kPseudoInverse;
  const Move stepped = move_tip(ws, row(scene.start), scene.goal, options);
  EXPECT_EQ(stepped.status, MoveStatus::kBlocked);
  ASSERT_EQ(stepped.obstacle, 0);
  EXPECT_EQ(ws.obstacles()[0], "ball");
  EXPECT_GT(stepped.link, 0);
  EXPECT_TRUE(ws.check_motion(view_of(stepped.path)).free);
  EXPECT_GT(stepped.path.rows(), 5);
}

TEST(MoveTip, AlongAHalfSpaceRedundancyReachesWhatThePapersStepsDoNot) {
  const Arm arm = panda();
  const JointMatrix q = random_poses(arm, 200, 21);
  int blocked = 0, reached = 0;
  for (Index i = 0; i + 1 < q.rows(); i += 2) {
    Surroundings around = with_radius(arm, 0.04);
    // The way of the tip lies outside: only the rest of the arm can touch it.
    const Vec3 from = tip_of(arm, q, i).translation(), to = tip_of(arm, q, i + 1).translation();
    around.keepouts.push_back(KeepOut::half_space(
        Plane(Vec3::UnitY(), std::min({from.y() - 0.06, to.y() - 0.06, -0.12})), {.name = "wall"}));
    const Workspace ws(arm, around);
    if (!ws.check_motion(JointView(q.row(i).data(), 1, 7)).free) continue;
    MoveOptions options{.method = MoveMethod::kPseudoInverse, .task = InverseTask::kPosition};
    const Move paper = move_tip(ws, row(q, i), at(to), options);
    if (paper.status != MoveStatus::kBlocked || paper.obstacle != 0) continue;
    ++blocked;
    options.method = MoveMethod::kDamped;
    const Move move = move_tip(ws, row(q, i), at(to), options);
    EXPECT_NE(move.status, MoveStatus::kBlocked) << i;
    EXPECT_TRUE(ws.check_motion(view_of(move.path)).free);
    if (move.status == MoveStatus::kReached) ++reached;
  }
  EXPECT_GT(blocked, 2);
  EXPECT_GT(2 * reached, blocked);
}

TEST(MoveTip, WhatCannotBePassedIsReported) {
  const Arm arm = panda();
  JointMatrix start(1, 7);
  start << 0.0, 0.8, 0.0, -1.9, 0.0, 2.7, 0.5;
  const Vec3 tip = tip_of(arm, start).translation();
  Surroundings around = with_radius(arm, 0.03);
  ASSERT_LT(tip.z(), 0.08);
  around.keepouts.push_back(KeepOut::half_space(Plane(Vec3::UnitZ(), tip.z() - 0.12),
                                                {.frame = "world", .name = "floor"}));
  const Workspace ws(arm, around);
  const MoveOptions options{.task = InverseTask::kPosition};
  const Move down = move_tip(ws, row(start), at(tip - Vec3(0.0, 0.0, 0.2)), options);
  EXPECT_EQ(down.status, MoveStatus::kStuck);
  ASSERT_EQ(down.obstacle, 0);
  EXPECT_EQ(down.link, static_cast<int>(arm.links().size()) - 1);
  EXPECT_GT(least_distance(ws, down), 0.0049);
  EXPECT_LT(least_distance(ws, down), 0.007);  // it went as far as it may
  // Beyond reach.
  const Move far = move_tip(ws, row(start), at(Vec3(3.0, 0.0, 0.5)), options);
  EXPECT_EQ(far.status, MoveStatus::kUnreachable);
  EXPECT_GT(far.path.rows(), 10);
}

TEST(MoveTip, AStartThatTouchesOrLiesOutsideIsGivenBack) {
  const Arm arm = panda();
  JointMatrix start(1, 7);
  start << 0.0, 0.1, 0.0, -2.0, 0.0, 2.1, 0.5;
  const Vec3 tip = tip_of(arm, start).translation();
  Surroundings around = with_radius(arm, 0.03);
  around.keepouts.push_back(KeepOut::sphere(0.1, tip, {.name = "ball"}));
  const Workspace ws(arm, around);
  const Move held = move_tip(ws, row(start), at(tip + Vec3(0.0, 0.0, 0.3)));
  EXPECT_EQ(held.status, MoveStatus::kBlocked);
  EXPECT_EQ(held.path.rows(), 1);
  EXPECT_NE(held.reason.find("start"), std::string::npos);
  start(0, 3) = 0.5;
  const Move outside = move_tip(ws, row(start), at(tip));
  EXPECT_EQ(outside.status, MoveStatus::kAtLimit);
  EXPECT_EQ(outside.coordinate, 3);
}

TEST(MoveTip, AStretchedArmIsMovedOutOfItsSingularPosture) {
  const Arm arm = planar_arm();
  const Workspace ws(arm, {});
  const JointMatrix start = JointMatrix::Zero(1, 2);
  const MoveOptions options{.task = InverseTask::kPosition};
  const Move in = move_tip(ws, row(start), at(Vec3(0.5, 0.0, 0.0)), options);
  EXPECT_EQ(in.status, MoveStatus::kReached) << in.reason;
  MoveOptions paper = options;
  paper.method = MoveMethod::kPseudoInverse;
  EXPECT_NE(move_tip(ws, row(start), at(Vec3(0.5, 0.0, 0.0)), paper).status, MoveStatus::kReached);
}

TEST(MoveTip, Refusals) {
  const Arm arm = panda();
  const Workspace ws(arm, {});
  JointMatrix start = JointMatrix::Zero(1, 7);
  start(0, 3) = -1.0;
  EXPECT_THROW(move_tip(ws, row(start), at(Vec3(NAN, 0, 0))), std::invalid_argument);
  EXPECT_THROW(move_tip(ws, row(start).first(6), at(Vec3(1, 0, 0))), std::invalid_argument);
  for (const auto& change : std::vector<void (*)(MoveOptions&)>{
           [](MoveOptions& o) { o.period = 0.0; }, [](MoveOptions& o) { o.speed = -1.0; },
           [](MoveOptions& o) { o.steps = 0; }, [](MoveOptions& o) { o.influence = 0.001; },
           [](MoveOptions& o) { o.velocity = {1.0}; },
           [](MoveOptions& o) { o.velocity.assign(7, 0.0); },
           [](MoveOptions& o) { o.time = INFINITY; }, [](MoveOptions& o) { o.axis.setZero(); }}) {
    MoveOptions options;
    change(options);
    EXPECT_THROW(move_tip(ws, row(start), at(Vec3(0.5, 0, 0.5)), options), std::invalid_argument);
  }
}

}  // namespace
}  // namespace bathyal
