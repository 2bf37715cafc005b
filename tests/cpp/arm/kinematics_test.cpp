// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/arm/internal/sincos.hpp"
#include "bathyal/arm/row_frames.hpp"
#include "bathyal/base/simd.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

std::span<const double> row_of(const JointMatrix& q, Index i) {
  return {q.row(i).data(), static_cast<std::size_t>(q.cols())};
}

std::vector<Arm> all_arms() {
  return {planar_arm(), ur10e(), panda(), irregular_arm(1), irregular_arm(2)};
}

TEST(Forward, TwoLinkArmIsTheTextbook) {
  const Arm arm = planar_arm();
  JointMatrix q(1, 2);
  q << 0.3, 0.9;
  const std::vector<double> pose = forward(arm, view_of(q));
  EXPECT_NEAR(pose[3], 0.5 * std::cos(0.3) + 0.4 * std::cos(1.2), 1e-15);
  EXPECT_NEAR(pose[7], 0.5 * std::sin(0.3) + 0.4 * std::sin(1.2), 1e-15);
  EXPECT_NEAR(pose[0], std::cos(1.2), 1e-15);
  const std::vector<double> columns = jacobian(arm, view_of(q));
  EXPECT_NEAR(columns[1], -0.4 * std::sin(1.2), 1e-15);
  EXPECT_NEAR(columns[3], 0.4 * std::cos(1.2), 1e-15);
  EXPECT_NEAR(columns[11], 1.0, 1e-15);
  const double area =
      manipulability(arm, view_of(q), Manipulability::kYoshikawa, JacobianPart::kLinear)[0];
  EXPECT_NEAR(area, 0.5 * 0.4 * std::sin(0.9), 1e-15);
}

TEST(Forward, AgreesWithOnePoseAtATime) {
  for (const Arm& arm : all_arms()) {
    const JointMatrix q = random_poses(arm, 21, 3);
    const std::vector<double> poses = forward(arm, view_of(q));
    const std::vector<double> links = forward_links(arm, view_of(q));
    for (Index i = 0; i < q.rows(); ++i) {
      const RowFrames frames = row_frames(arm, row_of(q, i));
      EXPECT_LT((Eigen::Map<const Matrix4>(poses.data() + 16 * i) - frames.world_from_tool.matrix())
                    .norm(),
                1e-13);
      for (std::size_t k = 0; k < arm.links().size(); ++k) {
        const Pose link = frames.world_from_row[k] * arm.links()[k].row_from_link;
        const double* at =
            links.data() + 16 * (static_cast<std::size_t>(i) * arm.links().size() + k);
        EXPECT_LT((Eigen::Map<const Matrix4>(at) - link.matrix()).norm(), 1e-13);
      }
    }
  }
}

TEST(Jacobian, IsTheDerivativeOfForward) {
  for (const Arm& arm : all_arms()) {
    const JointMatrix q = random_poses(arm, 9, 4);
    const std::vector<double> world = jacobian(arm, view_of(q));
    const std::vector<double> tool = jacobian(arm, view_of(q), TipFrame::kTool);
    for (Index i = 0; i < q.rows(); ++i) {
      const Pose pose = row_frames(arm, row_of(q, i)).world_from_tool;
      for (Index j = 0; j < arm.size(); ++j) {
        constexpr double kStep = 1e-6;
        JointMatrix shifted = q;
        shifted(i, j) += kStep;
        const Pose more = row_frames(arm, row_of(shifted, i)).world_from_tool;
        shifted(i, j) -= 2 * kStep;
        const Pose less = row_frames(arm, row_of(shifted, i)).world_from_tool;
        const Vec3 linear = (more.translation() - less.translation()) / (2 * kStep);
        const Eigen::Matrix3d spin =
            (more.linear() - less.linear()) / (2 * kStep) * pose.linear().transpose();
        const Vec3 angular(spin(2, 1), spin(0, 2), spin(1, 0));
        const JointView at(world.data() + 6 * arm.size() * i, 6, arm.size());
        const JointView in_tool(tool.data() + 6 * arm.size() * i, 6, arm.size());
        EXPECT_LT((at.col(j).head(3) - linear).norm(), 1e-8);
        EXPECT_LT((at.col(j).tail(3) - angular).norm(), 1e-8);
        EXPECT_LT((in_tool.col(j).head(3) - pose.linear().transpose() * linear).norm(), 1e-8);
        EXPECT_LT((in_tool.col(j).tail(3) - pose.linear().transpose() * angular).norm(), 1e-8);
      }
    }
  }
}

TEST(Jacobian, KeepsItsDigitsInSurveyCoordinates) {
  Arm arm = panda();
  const JointMatrix q = random_poses(arm, 5, 5);
  const std::vector<double> near = jacobian(arm, view_of(q));
  arm.set_base(Pose(Eigen::Translation3d(6e5, 7.2e6, -50.0)));
  EXPECT_EQ(jacobian(arm, view_of(q)), near);
}

TEST(Kinematics, SameBytesOnEveryInstructionSetAndAnyNumberOfThreads) {
  for (const Arm& arm : all_arms()) {
    JointMatrix q = random_poses(arm, 1500, 6);
    q.row(3) *= 1e4;
    q.row(4) *= 1e7;  // beyond the kernels' own reduction
    const auto results = [&](int num_threads) {
      const PosesAndJacobians both =
          forward_and_jacobian(arm, view_of(q), TipFrame::kWorld, num_threads);
      return std::vector{both.poses, both.jacobians, forward(arm, view_of(q), num_threads),
                         forward_links(arm, view_of(q), num_threads),
                         jacobian(arm, view_of(q), TipFrame::kTool, num_threads)};
    };
    const SimdLevel before = simd_level();
    const auto expected = results(1);
    EXPECT_EQ(expected[0], expected[2]);
    for (const SimdLevel level : available_simd_levels()) {
      set_simd_level(level);
      for (const int num_threads : {1, 2, 8}) {
        EXPECT_EQ(results(num_threads), expected) << to_text(level) << ", " << num_threads;
      }
    }
    set_simd_level(before);
  }
}

TEST(Kinematics, IntoMemoryOfTheCaller) {
  const Arm arm = panda();
  const JointMatrix q = random_poses(arm, 40, 8);
  std::vector<double> poses(640, NAN), links(640 * 8, NAN), jacobians(40 * 42, NAN);
  compute_kinematics(arm, view_of(q), {.jacobians = jacobians, .frame = TipFrame::kTool});
  EXPECT_EQ(jacobians, jacobian(arm, view_of(q), TipFrame::kTool));
  compute_kinematics(arm, view_of(q), {.poses = poses, .links = links});
  EXPECT_EQ(poses, forward(arm, view_of(q)));
  EXPECT_EQ(links, forward_links(arm, view_of(q)));
  compute_kinematics(arm, view_of(q), {});
  poses.pop_back();
  EXPECT_THROW(compute_kinematics(arm, view_of(q), {.poses = poses}), std::invalid_argument);
  EXPECT_THROW(compute_kinematics(arm, view_of(q), {.links = poses}), std::invalid_argument);
  EXPECT_THROW(compute_kinematics(arm, view_of(q), {.jacobians = poses}), std::invalid_argument);
}

TEST(Kinematics, APoseDoesNotDependOnItsNeighbours) {
  const Arm arm = irregular_arm(3);
  const JointMatrix q = random_poses(arm, 13, 7);
  const std::vector<double> all = forward(arm, view_of(q));
  for (Index i = 0; i < q.rows(); ++i) {
    const JointMatrix one = q.row(i);
    const std::vector<double> alone = forward(arm, view_of(one));
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(), all.begin() + 16 * i));
  }
  EXPECT_TRUE(forward(arm, JointView(nullptr, 0, arm.size())).empty());
}

struct Lanes {
  using D = double __attribute__((vector_size(16)));
  using I = std::int64_t __attribute__((vector_size(16)));
  static constexpr int kLanes = 2;
};

double error_in_ulps(double value, long double exact) {
  const double rounded = static_cast<double>(exact);
  const double ulp = std::abs(std::nextafter(rounded, 2.0) - rounded);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact)) / ulp;
}

TEST(SineCosine, WithinAnUlpAndAHalfOfTheTruth) {
  RandomStream random(8);
  double worst = 0.0;
  const auto check = [&](double x) {
    const arm::SineCosine<Lanes> both = arm::sincos<Lanes>(Lanes::D{x, -x});
    worst = std::max(worst, error_in_ulps(both.sine[0], std::sin(static_cast<long double>(x))));
    worst = std::max(worst, error_in_ulps(both.cosine[0], std::cos(static_cast<long double>(x))));
    EXPECT_EQ(both.sine[1], -both.sine[0]);
    EXPECT_EQ(both.cosine[1], both.cosine[0]);
  };
  for (int i = 0; i < 200000; ++i) check(random.uniform(0.0, 10.0));
  for (int i = 0; i < 200000; ++i) check(random.uniform(0.0, 1e5));
  for (int i = 0; i < 2000; ++i) check(std::pow(10.0, random.uniform(-300.0, 15.0)));
  for (int i = 0; i < 60000; ++i) check(i * (kPi / 2));  // where the reduction cancels most
  EXPECT_LT(worst, 1.5);
}

TEST(Kinematics, Refusals) {
  const Arm arm = ur10e();
  JointMatrix q = random_poses(arm, 3, 9);
  EXPECT_THROW(forward(arm, JointView(q.data(), 3, 5)), std::invalid_argument);
  EXPECT_THROW(jacobian(arm, JointView(q.data(), 3, 5)), std::invalid_argument);
  q(1, 2) = std::nan("");
  try {
    forward(arm, view_of(q));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "`q`: expected finite numbers, got nan in row 1");
  }
}

TEST(JointAngles, LimitsAreReported) {
  const Arm arm = panda();
  JointMatrix q = JointMatrix::Zero(2, 7);
  q.col(3).setConstant(-1.0);
  q(1, 0) = 2.9;
  EXPECT_EQ(within_limits(arm, view_of(q)), (std::vector<bool>{true, false}));
}

TEST(JointAngles, DegreesAreNoticed) {
  const Arm arm = panda();
  JointMatrix q = JointMatrix::Zero(2, 7);
  EXPECT_NO_THROW(check_joint_angles(arm, view_of(q)));
  q(1, 4) = -95.0;
  try {
    check_joint_angles(arm, view_of(q));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("q_deg"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("-95 in row 1"), std::string::npos);
  }
}

TEST(Manipulability, IsZeroWhereTheArmIsStretched) {
  const Arm arm = planar_arm();
  const JointMatrix q = JointMatrix::Zero(1, 2);
  for (const Manipulability kind :
       {Manipulability::kYoshikawa, Manipulability::kSmallest, Manipulability::kInverseCondition}) {
    EXPECT_NEAR(manipulability(arm, view_of(q), kind, JacobianPart::kLinear)[0], 0.0, 1e-15);
  }
  EXPECT_NEAR(manipulability(arm, view_of(q), Manipulability::kSmallest, JacobianPart::kAngular)[0],
              0.0, 1e-15);
}

}  // namespace
}  // namespace bathyal
