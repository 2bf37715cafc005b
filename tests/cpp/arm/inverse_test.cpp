// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/inverse.hpp"

#include <gtest/gtest.h>

#include <array>

#include "bathyal/arm/internal/start_library.hpp"
#include "bathyal/arm/inverse_problem.hpp"
#include "bathyal/arm/row_frames.hpp"
#include "bathyal/arm/tip_state.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

const auto kReached = InverseStatus::kReached;

JointView no_start(const Arm& arm) { return {nullptr, 0, arm.size()}; }

std::size_t count(const InverseResult& result, InverseStatus status) {
  return static_cast<std::size_t>(std::count(result.status.begin(), result.status.end(), status));
}

/// Every row's errors are those of its q, and q keeps the limits.
void expect_honest(const Arm& arm, const std::vector<double>& targets,
                   const InverseResult& result) {
  const std::vector<double> poses = forward(arm, view_of(result.q));
  const std::vector<bool> within = within_limits(arm, view_of(result.q), 0.0);
  for (std::size_t i = 0; i < result.status.size(); ++i) {
    EXPECT_TRUE(within[i]);
    double squared = 0.0;
    for (const std::size_t k : {3, 7, 11}) {
      squared += std::pow(poses[16 * i + k] - targets[16 * i + k], 2);
    }
    EXPECT_NEAR(result.position_error[i], std::sqrt(squared), 1e-9);
    if (result.status[i] == kReached) {
      EXPECT_LE(result.position_error[i], 1.001e-6);
    }
  }
}

TEST(Inverse, ReachesEveryReachablePose) {
  for (const Arm& arm : {ur10e(), panda()}) {
    const JointMatrix q = random_poses(arm, 500, 21);
    const std::vector<double> targets = forward(arm, view_of(q));
    const InverseResult result = inverse(arm, targets, no_start(arm));
    EXPECT_EQ(count(result, kReached), 500U);
    expect_honest(arm, targets, result);
    for (const double angle : result.angle_error) EXPECT_LE(angle, 1.001e-6);
  }
}

TEST(Inverse, ComesBackToAStartNearby) {
  for (const Arm& arm : {ur10e(), irregular_arm(5)}) {
    JointMatrix q = random_poses(arm, 100, 22);
    if (arm.size() == 6) q *= 0.9;
    const std::vector<double> targets = forward(arm, view_of(q));
    const JointMatrix start = (q.array() + 0.02).matrix();
    const InverseResult result = inverse(arm, targets, view_of(start), {.max_starts = 1});
    std::size_t same = 0;
    for (Index i = 0; i < q.rows(); ++i) {
      same += (result.q.row(i) - q.row(i)).norm() < 1e-3 ? 1 : 0;
    }
    EXPECT_GE(same, 90U) << arm.name();  // the rest are near a singularity
  }
}

TEST(Inverse, WholeTurnsBringItNearTheStart) {
  const Arm arm = ur10e();
  JointMatrix q(1, 6), start(1, 6);
  q << 0.3, -1.2, 1.4, -0.5, 1.0, 0.2;
  start << 0.3 + 2 * kPi - 0.6, -1.2, 1.4, -0.5 - 2 * kPi + 0.7, 1.0, 0.2;
  const InverseResult result = inverse(arm, forward(arm, view_of(q)), view_of(start));
  ASSERT_EQ(result.status[0], kReached);
  EXPECT_NEAR(result.q(0, 0), 0.3, 2e-6);
  EXPECT_NEAR(result.q(0, 3), -0.5, 2e-6);
}

TEST(Inverse, OfSeveralCandidatesTheNearestToTheStartIsTaken) {
  const Arm arm = ur10e();
  const JointMatrix q = random_poses(arm, 60, 23);
  const std::vector<double> targets = forward(arm, view_of(q));
  const JointMatrix start = JointMatrix::Constant(1, 6, 0.4);
  const InverseResult one = inverse(arm, targets, view_of(start));
  const InverseResult many = inverse(arm, targets, view_of(start), {.candidates = 8});
  std::size_t nearer = 0;
  for (Index i = 0; i < q.rows(); ++i) {
    const double first = (one.q.row(i) - start).norm(), best = (many.q.row(i) - start).norm();
    EXPECT_LE(best, first + 1e-4);
    nearer += best < first - 0.1 ? 1 : 0;
  }
  EXPECT_GT(nearer, 10U);
}

TEST(Inverse, RedundantArmsMoveTowardsTheMiddleOfTheirLimits) {
  const Arm arm = panda();
  const JointMatrix q = random_poses(arm, 100, 24);
  const std::vector<double> targets = forward(arm, view_of(q));
  const InverseResult plain = inverse(arm, targets, no_start(arm), {.centering_steps = 0});
  const InverseResult centered = inverse(arm, targets, no_start(arm));
  const Eigen::RowVectorXd middle = 0.5 * (arm.lower() + arm.upper()).transpose();
  double before = 0.0, after = 0.0;
  for (Index i = 0; i < q.rows(); ++i) {
    before += (plain.q.row(i) - middle).squaredNorm();
    after += (centered.q.row(i) - middle).squaredNorm();
  }
  EXPECT_LT(after, 0.9 * before);
  EXPECT_EQ(count(centered, kReached), 100U);
  expect_honest(arm, targets, centered);
}

TEST(Inverse, PositionAndAxisTasks) {
  const Arm arm = panda();
  const JointMatrix q = random_poses(arm, 100, 25);
  const std::vector<double> targets = forward(arm, view_of(q));
  const InverseResult place =
      inverse(arm, targets, no_start(arm), {.task = InverseTask::kPosition});
  EXPECT_EQ(count(place, kReached), 100U);
  expect_honest(arm, targets, place);

  const Vec3 axis(1.0, 2.0, -0.5);
  const InverseResult aimed =
      inverse(arm, targets, no_start(arm), {.task = InverseTask::kPositionAxis, .axis = axis});
  EXPECT_EQ(count(aimed, kReached), 100U);
  const std::vector<double> poses = forward(arm, view_of(aimed.q));
  using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  for (std::size_t i = 0; i < 100; ++i) {
    const Eigen::Map<const Matrix4> got(poses.data() + 16 * i), wanted(targets.data() + 16 * i);
    const Vec3 a = got.topLeftCorner<3, 3>() * axis.normalized();
    const Vec3 b = wanted.topLeftCorner<3, 3>() * axis.normalized();
    EXPECT_LT((a - b).norm(), 1.001e-6);
  }
}

TEST(Inverse, ReportsWhyNothingWasReached) {
  DhTable table{DhConvention::kStandard,
                {{0.5, 0, 0, 0, 0}, {0.4, 0, 0, 0, 0}},
                {JointType::kRevolute, JointType::kRevolute},
                Pose::Identity(),
                Pose::Identity()};
  const Arm arm = arm_from_dh(table, {.lower = {-1.0, -2.0}, .upper = {1.0, 2.0}});
  const auto target = [](double x, double y) {
    std::vector<double> pose{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, 0, 0, 0, 0, 1};
    return pose;
  };
  const InverseOptions options{.task = InverseTask::kPosition};
  const auto status = [&](double x, double y) {
    return inverse(arm, target(x, y), no_start(arm), options).status[0];
  };
  EXPECT_EQ(status(0.6, 0.3), kReached);
  EXPECT_EQ(status(0.9, 0.0), kReached);  // stretched out, at the very edge
  EXPECT_EQ(status(-0.7, 0.1), InverseStatus::kLimit);
  EXPECT_EQ(status(0.95, 0.0), InverseStatus::kOutOfReach);
  EXPECT_EQ(status(0.05, 0.0), InverseStatus::kOutOfReach);  // too near: within 0.1 m of the foot
  const InverseResult far = inverse(arm, target(3.0, 0.0), no_start(arm), options);
  EXPECT_NEAR(far.position_error[0], 2.1, 1e-3);  // it points there

  // Stretched along the line to the target no joint can move towards it.
  const JointMatrix stretched = JointMatrix::Zero(1, 2);
  InverseOptions once = options;
  once.max_starts = 1;
  EXPECT_EQ(inverse(arm, target(0.5, 0.0), view_of(stretched), once).status[0],
            InverseStatus::kSingular);
  EXPECT_EQ(inverse(arm, target(0.5, 0.0), view_of(stretched), options).status[0], kReached);
}

TEST(Inverse, SlidingAndMimicJoints) {
  const Arm arm = irregular_arm(6);
  const JointMatrix q = random_poses(arm, 50, 26);
  const std::vector<double> targets = forward(arm, view_of(q));
  const InverseResult result = inverse(arm, targets, no_start(arm));
  EXPECT_GE(count(result, kReached), 49U);
  expect_honest(arm, targets, result);
}

TEST(Inverse, JointsWithoutLimitsStayNearTheStart) {
  const Arm arm = planar_arm();
  const JointMatrix q = random_poses(arm, 20, 31);
  for (const double turns : {-3.0, 0.0, 40.0}) {
    const JointMatrix start = (q.array() + 0.3 + turns * 2.0 * kPi).matrix();
    const InverseResult result =
        inverse(arm, forward(arm, view_of(q)), view_of(start), {.task = InverseTask::kPosition});
    EXPECT_EQ(count(result, kReached), 20U);
    EXPECT_LE((result.q - start).cwiseAbs().maxCoeff(), kPi + 1e-9);
  }
}

TEST(Inverse, LimitsOfFollowersAreKept) {
  // Two turns from one coordinate: the second joint stops it at half of what the first allows.
  std::vector<Joint> joints(3);
  for (Joint& joint : joints) joint.row.a = 0.4;
  joints[0].coordinate = joints[1].coordinate = 0;
  joints[0].lower = -2.0;
  joints[0].upper = 2.0;
  joints[1].follows = joints[0].name = "leader";
  joints[1].lower = -1.0;
  joints[1].upper = 1.0;
  joints[2].coordinate = 1;
  const Arm arm("follower", joints);
  JointMatrix q(2, 2);
  q << 0.9, 0.3, 1.4, 0.3;
  const InverseResult result =
      inverse(arm, forward(arm, view_of(q)), no_start(arm), {.candidates = 4});
  EXPECT_EQ(result.status[0], kReached);
  EXPECT_NEAR(result.q(0, 0), 0.9, 1e-5);
  EXPECT_EQ(result.status[1], InverseStatus::kLimit);
  EXPECT_LE(result.q(1, 0), 1.0);
}

TEST(Inverse, LongChains) {
  DhTable table;
  for (int i = 0; i < 12; ++i) {
    table.rows.push_back({0.1, i % 2 == 0 ? kPi / 2 : -kPi / 2, 0.02, 0, 0});
    table.types.push_back(JointType::kRevolute);
  }
  const Arm arm = arm_from_dh(table);
  const std::vector<double> targets = forward(arm, view_of(random_poses(arm, 20, 27)));
  EXPECT_EQ(count(inverse(arm, targets, no_start(arm)), kReached), 20U);
}

TEST(Inverse, HalfATurnAway) {
  const Arm arm = ur10e();
  JointMatrix q(1, 6), start(1, 6);
  q << 0.3, -1.2, 1.4, -0.5, 1.0, 0.2;
  start << 0.3, -1.2, 1.4, -0.5, 1.0, 0.2 + kPi;
  const std::vector<double> targets = forward(arm, view_of(q));
  for (const InverseTask task : {InverseTask::kPose, InverseTask::kPositionAxis}) {
    EXPECT_EQ(
        inverse(arm, targets, view_of(start), {.task = task, .axis = Vec3::UnitX()}).status[0],
        kReached);
  }
}

TEST(Inverse, SameForAnyThreadsAndNeighbours) {
  const Arm arm = panda();
  const JointMatrix q = random_poses(arm, 80, 28);
  const std::vector<double> targets = forward(arm, view_of(q));
  const InverseResult one = inverse(arm, targets, no_start(arm), {.num_threads = 1});
  const InverseResult eight = inverse(arm, targets, no_start(arm), {.num_threads = 8});
  EXPECT_EQ(one.q, eight.q);
  EXPECT_EQ(one.iterations, eight.iterations);
  const std::span<const double> last(targets.data() + 79 * 16, 16);
  EXPECT_EQ(inverse(arm, last, no_start(arm)).q, one.q.row(79));
  const InverseResult seeded = inverse(arm, targets, no_start(arm), {.seed = 1});
  EXPECT_NE(seeded.q, one.q);
  EXPECT_EQ(inverse(arm, {}, no_start(arm)).q.rows(), 0);
}

TEST(Inverse, TheSteppingOfThePaper) {
  // The arm of Maevskiy and Zanin (2020), from its start pose to a place before it.
  const Arm arm = arm_from_dh(
      {DhConvention::kStandard,
       {{0.193, kPi / 2, -0.117, 0, 0}, {0.552, 0, 0, 0, 0}, {0.596, 0, 0, 0, 0}},
       {3, JointType::kRevolute},
       Pose::Identity(),
       Pose::Identity()},
      {.lower = {-kPi / 2, -kPi / 2, -0.75 * kPi}, .upper = {kPi / 2, kPi, 0.75 * kPi}});
  JointMatrix start(1, 3), goal(1, 3);
  start << 0.0, -kPi / 4, 50.0 * kPi / 180.0;
  goal << 0.4, -0.9, 0.5;
  const std::vector<double> targets = forward(arm, view_of(goal));
  InverseOptions options{.task = InverseTask::kPosition, .method = InverseMethod::kPseudoInverse};
  const InverseResult found = inverse(arm, targets, view_of(start), options);
  EXPECT_EQ(found.status[0], kReached);
  EXPECT_LE(found.position_error[0], 1e-2);
  EXPECT_GE(found.iterations[0], options.steps - 1);
  options.position_tolerance = 1e-9;
  EXPECT_EQ(inverse(arm, targets, view_of(start), options).status[0], kReached);
  const JointMatrix stretched = JointMatrix::Zero(1, 3);
  EXPECT_EQ(inverse(arm, targets, view_of(stretched), options).status[0], InverseStatus::kSingular);
}

TEST(Inverse, TheSteppingOfThePaperTakesOffWholeTurns) {
  const Arm arm = ur10e();
  JointMatrix start(1, 6), goal(1, 6);
  start << 6.0, -1.2, 1.4, -0.5, 1.0, 0.2;
  goal << 6.0 - 2 * kPi + 0.7, -1.2, 1.4, -0.5, 1.0, 0.2;  // the straight way leads beyond 2 pi
  const InverseResult found = inverse(arm, forward(arm, view_of(goal)), view_of(start),
                                      {.method = InverseMethod::kPseudoInverse});
  EXPECT_EQ(found.status[0], kReached);
  EXPECT_NEAR(found.q(0, 0), goal(0, 0), 0.02);
}

TEST(Inverse, Refusals) {
  const Arm arm = panda();
  JointMatrix q = random_poses(arm, 2, 29);
  std::vector<double> targets = forward(arm, view_of(q));
  EXPECT_THROW(inverse(arm, targets, view_of(random_poses(arm, 3, 1))), std::invalid_argument);
  q(1, 0) = 3.0;
  EXPECT_THROW(inverse(arm, targets, view_of(q)), std::invalid_argument);
  EXPECT_THROW(inverse(arm, targets, no_start(arm), {.max_starts = 0}), std::invalid_argument);
  EXPECT_THROW(inverse(arm, targets, no_start(arm), {.axis = Vec3::Zero()}), std::invalid_argument);
  EXPECT_THROW(inverse(arm, targets, no_start(arm), {.position_tolerance = 0.0}),
               std::invalid_argument);
  targets[16] += 0.1;
  EXPECT_THROW(inverse(arm, targets, no_start(arm)), std::invalid_argument);
  targets[16] = NAN;
  EXPECT_THROW(inverse(arm, targets, no_start(arm)), std::invalid_argument);
}

TEST(TipState, ItsJacobianIsTheDerivativeOfTheResidual) {
  const Arm ur = ur10e();
  const arm::InverseProblem problem(ur, {});
  arm::TipState state(problem.program.view, problem.task);
  const JointMatrix q = random_poses(ur, 2, 5);
  const arm::PlainPose target =
      problem.relative(arm::plain(row_frames(ur, {q.data(), problem.size()}).world_from_tool));
  state.evaluate(target, q.row(0).data());
  EXPECT_LT(state.error(), 1e-12);
  // Near the target, where the residual is first order in the step.
  constexpr double kStep = 1e-6;
  const std::vector<double> jacobian(state.jacobian(), state.jacobian() + 6 * ur.size());
  for (Index j = 0; j < ur.size(); ++j) {
    JointMatrix moved = q.row(0);
    moved(0, j) += kStep;
    state.evaluate(target, moved.data());
    for (Index i = 0; i < 6; ++i) {
      EXPECT_NEAR(-state.residual()[i] / kStep,
                  jacobian[static_cast<std::size_t>(i * ur.size() + j)], 1e-5);
    }
  }
}

TEST(InverseProblem, UnwindsByWholeTurnsWithinTheLimits) {
  const Arm ur = ur10e();
  const arm::InverseProblem problem(ur, {});
  std::array<double, 6> q{}, reference{};
  q.fill(3.0);
  reference.fill(-3.0);
  problem.unwind(reference, q.data());
  for (std::size_t j = 0; j < q.size(); ++j) {
    const double turned = 3.0 - 2.0 * std::numbers::pi;
    EXPECT_NEAR(q[j], turned >= problem.lower[j] ? turned : 3.0, 1e-12);
  }
  EXPECT_NE(q[0], 3.0);
  EXPECT_EQ(q[2], 3.0) << "the elbow turns by half a turn each way";
  EXPECT_TRUE(problem.within_limits(q.data()));
  q[0] = problem.upper[0] + 0.1;
  EXPECT_FALSE(problem.within_limits(q.data()));
}

TEST(StartLibrary, StartsLieWithinTheLimitsAndTheirOwnPoseScoresBest) {
  const Arm franka = panda();
  const arm::InverseProblem problem(franka, {});
  const arm::StartLibrary library(franka, problem, 3);
  const JointMatrix q = Eigen::Map<const JointMatrix>(library.start(11), 1, franka.size());
  EXPECT_TRUE(problem.within_limits(library.start(11)));
  std::vector<double> scores;
  library.score(
      problem.relative(arm::plain(row_frames(franka, {q.data(), problem.size()}).world_from_tool)),
      scores);
  const auto best = std::min_element(scores.begin(), scores.end()) - scores.begin();
  EXPECT_LE(scores[static_cast<std::size_t>(best)], scores[11]);
  EXPECT_LT(scores[11], *std::max_element(scores.begin(), scores.end()) / 4);
}

}  // namespace
}  // namespace bathyal
