// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/compensation/corrected_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "support/corrected_arm_cases.hpp"
#include "support/example_effects.hpp"

namespace bathyal {
namespace {

TEST(CorrectedArm, ComposesTheChainAsItsHeaderSays) {
  const Arm arm = irregular_arm(4);
  const std::vector<FoundEffect> effects{curve(2e-3), bending(3e-3), moved_base(1e-2),
                                         slip(4e-3),  growth(1e-3),  sag(1e-3)};
  const CorrectedArm model(arm, effects, some_support(arm));
  const JointMatrix q = poses_within(arm, 5, 1);
  const CorrectedPoses found = model.forward(view_of(q), some_covariates());
  EXPECT_TRUE(within(found.uses).all());
  for (Index i = 0; i < q.rows(); ++i) {
    Eigen::VectorXd moved = q.row(i).transpose();
    moved[1] += 2e-3 * (std::sin(3.0 * q(i, 1)) + std::cos(q(i, 0))) + 1e-3 * 1.5 * -9.80665;
    const double grown = 1.0 + 1e-3 * 6.0 * (1.0 + 0.1 * q(i, 0));
    const double reach = std::cos(q(i, 1));
    Eigen::Vector<double, 6> bent, base, slipped;
    bent << 0.1 * reach, -0.2, reach * reach, reach, -2.0 * reach, 0.5;
    base << 1.0, 2.0, 3.0, 0.1, 0.2, 0.3;
    slipped << 0.0, 1.0, 0.0, 0.0, 0.0, 0.0;
    Pose pose = arm.base() * twist(1e-2 * base) * arm.root();
    for (std::size_t k = 0; k < arm.joints().size(); ++k) {
      DhRow row = arm.joints()[k].row;
      row.a *= grown;
      row.d *= grown;
      const std::span<const double> values(moved.data(), static_cast<std::size_t>(moved.size()));
      pose = pose * row_pose(row, arm.joints()[k].type, joint_value(arm.joints()[k], values));
      if (k == 0) pose = pose * twist(3e-3 * bent);
    }
    pose = pose * arm.flange() * twist(4e-3 * slipped) * arm.tool();
    EXPECT_LT((pose.matrix() - pose_at(found.poses, i).matrix()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(CorrectedArm, IsTheRigidArmWithoutEffects) {
  const Arm arm = irregular_arm(2);
  const CorrectedArm model(arm, {}, some_support(arm));
  const JointMatrix q = random_poses(arm, 20, 3);
  EXPECT_EQ(model.forward(view_of(q)).poses, forward(arm, view_of(q)));
  EXPECT_EQ(model.forward_links(view_of(q)).poses, forward_links(arm, view_of(q)));
  EXPECT_LT(difference(model.jacobian(view_of(q)).jacobians, jacobian(arm, view_of(q))), 1e-13);
}

TEST(CorrectedArm, LinksStandOnTheChain) {
  const Arm arm = irregular_arm(6);
  const CorrectedArm model(arm, {curve(2e-3), moved_base(1e-2)}, some_support(arm));
  const JointMatrix q = poses_within(arm, 3, 5);
  const CorrectedPoses links = model.forward_links(view_of(q), some_covariates());
  const CorrectedPoses tips = model.forward(view_of(q), some_covariates());
  const auto count = static_cast<Index>(arm.links().size());
  for (Index i = 0; i < q.rows(); ++i) {
    const Pose last =
        pose_at(links.poses, count * i + count - 1) * arm.links().back().row_from_link.inverse();
    const Pose tip = last * arm.flange() * arm.tool();
    EXPECT_LT((tip.matrix() - pose_at(tips.poses, i).matrix()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(CorrectedArm, JacobianIsTheDerivativeOfForward) {
  const Arm arm = irregular_arm(9);
  const CorrectedArm model(arm,
                           {curve(0.02), bending(0.03), moved_base(0.1), slip(0.01), growth(1e-3)},
                           some_support(arm));
  const JointMatrix q = poses_within(arm, 6, 8);
  const Covariates covariates = some_covariates();
  const CorrectedJacobians found = model.jacobian(view_of(q), covariates);
  const CorrectedPoses poses = model.forward(view_of(q), covariates);
  constexpr double kStep = 2e-6;
  for (Index j = 0; j < arm.size(); ++j) {
    JointMatrix up = q, down = q;
    up.col(j).array() += kStep;
    down.col(j).array() -= kStep;
    const CorrectedPoses above = model.forward(view_of(up), covariates);
    const CorrectedPoses below = model.forward(view_of(down), covariates);
    for (Index i = 0; i < q.rows(); ++i) {
      const Pose a = pose_at(above.poses, i), b = pose_at(below.poses, i);
      Eigen::Vector<double, 6> numeric;
      numeric << (a.translation() - b.translation()) / (2.0 * kStep),
          vector_of(a.linear() * b.linear().transpose()) / (2.0 * kStep);
      const JointView jacobian(&found.jacobians[6 * arm.size() * i], 6, arm.size());
      EXPECT_LT((numeric - jacobian.col(j)).cwiseAbs().maxCoeff(), 1e-7) << i << " " << j;
    }
  }
  const CorrectedJacobians in_tool = model.jacobian(view_of(q), covariates, TipFrame::kTool);
  const JointView world(found.jacobians.data(), 6, arm.size());
  const JointView tool(in_tool.jacobians.data(), 6, arm.size());
  const Eigen::Matrix3d turn = pose_at(poses.poses, 0).linear();
  EXPECT_LT((turn * tool.topRows(3) - world.topRows(3)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(CorrectedArm, AsksForCovariatesWhereSomeAreTold) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {growth(1e-4)}, some_support(arm));
  const JointMatrix q = JointMatrix::Zero(2, arm.size());
  const CorrectedPoses found = model.forward(view_of(q));
  EXPECT_FALSE(within(found.uses).any());
  EXPECT_EQ(found.poses, forward(arm, view_of(q)));
  try {
    model.forward(view_of(q), {{"payload", column({1.0})}});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "`covariates`: expected temperature, which growth needs, got payload");
  }
}

TEST(CorrectedArm, RefusesWhatDoesNotFit) {
  const Arm arm = ur10e();
  const Support support = some_support(arm);
  const JointMatrix q = JointMatrix::Zero(2, arm.size());
  const CorrectedArm model(arm, {growth(1e-4)}, support);
  EXPECT_THROW(model.forward(view_of(q), {{"temperature", RowMatrix::Zero(3, 1)}}),
               std::invalid_argument);
  EXPECT_THROW(model.forward(view_of(q), {{"temperature", RowMatrix::Zero(2, 2)}}),
               std::invalid_argument);
  EXPECT_THROW(model.forward(view_of(q), {{"temperature", RowMatrix::Constant(1, 1, 1.0 / 0.0)}}),
               std::invalid_argument);
  FoundEffect wrong = curve(1e-3);
  wrong.values.resize(2);
  wrong.values.setZero();
  EXPECT_THROW(CorrectedArm(arm, {wrong}, support), std::invalid_argument);
  wrong = curve(kNan);
  EXPECT_THROW(CorrectedArm(arm, {wrong}, support), std::invalid_argument);
  wrong = curve(1e-3);
  wrong.variant.joint = 6;
  EXPECT_THROW(CorrectedArm(arm, {wrong}, support), std::invalid_argument);
  EXPECT_THROW(CorrectedArm(planar_arm(), {}, support), std::invalid_argument);
}

TEST(CorrectedArm, NamesAnEffectWhoseActionsDoNotFit) {
  const Arm arm = ur10e();
  const auto of = [&](FunctionEffect::Moves moves) {
    const JointMatrix q = JointMatrix::Zero(2, arm.size());
    CorrectedArm(arm, {found("broken", -1, 1.0, moves)}, some_support(arm)).forward(view_of(q));
  };
  EXPECT_THROW(of([](const EffectData&) {
                 return Perturbation{PerturbationSite::kJoint, 0, RowMatrix::Zero(1, 1)};
               }),
               std::invalid_argument);
  EXPECT_THROW(of([](const EffectData&) {
                 return Perturbation{PerturbationSite::kJoint, 6, RowMatrix::Zero(2, 1)};
               }),
               std::invalid_argument);
  EXPECT_THROW(of([](const EffectData&) {
                 return Perturbation{PerturbationSite::kFrame, 8, RowMatrix::Zero(2, 6)};
               }),
               std::invalid_argument);
  try {
    of([](const EffectData&) {
      return Perturbation{PerturbationSite::kJoint, 0, RowMatrix::Constant(2, 1, kNan)};
    });
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("broken"), std::string::npos) << error.what();
  }
}

TEST(CorrectedArm, InverseComesBackToANanometre) {
  Arm arm = ur10e();
  arm.set_tool(pose_of(0.01, 0.02, 0.2, 0.3, 0.1));
  const CorrectedArm model(arm, {curve(3e-3), bending(2e-3), moved_base(1e-2), growth(1e-4)},
                           some_support(arm));
  JointMatrix q = poses_within(arm, 40, 2);
  q.col(2).array() = 0.2 + 0.7 * q.col(2).array().abs();  // an elbow that is bent
  const Covariates covariates = some_covariates();
  const std::vector<double> targets = model.forward(view_of(q), covariates).poses;
  for (const InverseTask task :
       {InverseTask::kPose, InverseTask::kPosition, InverseTask::kPositionAxis}) {
    InverseOptions options;
    options.task = task;
    const CorrectedInverse found = model.inverse(targets, view_of(q), covariates, options);
    const CorrectedPoses back = model.forward(view_of(found.result.q), covariates);
    for (Index i = 0; i < q.rows(); ++i) {
      EXPECT_EQ(found.result.status[i], InverseStatus::kReached);
      const Pose target = pose_at(targets, i), tip = pose_at(back.poses, i);
      EXPECT_LE((target.translation() - tip.translation()).norm(), 1e-9);
      EXPECT_LE(found.result.position_error[i], 1e-9);
      if (task == InverseTask::kPose) {
        EXPECT_LE(vector_of(target.linear() * tip.linear().transpose()).norm(), 1e-9);
      } else if (task == InverseTask::kPositionAxis) {
        EXPECT_LE((target.linear().col(2) - tip.linear().col(2)).norm(), 1e-9);
      }
    }
  }
}

TEST(CorrectedArm, InverseSaysWhatItDoesNotReach) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {curve(3e-3)}, some_support(arm));
  Pose far = Pose::Identity();
  far.translation() = Vec3(3.0, 0.0, 0.0);
  const RowMajor4 numbers = far.matrix();
  const CorrectedInverse found = model.inverse({numbers.data(), 16}, JointView(nullptr, 0, 6));
  EXPECT_EQ(found.result.status[0], InverseStatus::kOutOfReach);
  const CorrectedPoses tip = model.forward(view_of(found.result.q));
  EXPECT_NEAR(found.result.position_error[0],
              (far.translation() - pose_at(tip.poses, 0).translation()).norm(), 1e-12);
  InverseOptions options;
  options.method = InverseMethod::kPseudoInverse;
  EXPECT_THROW(model.inverse({numbers.data(), 16}, JointView(nullptr, 0, 6), {}, options),
               std::invalid_argument);
}

TEST(CorrectedArm, IsTheSameForAnyNumberOfThreads) {
  const Arm arm = irregular_arm(5);
  const CorrectedArm model(arm, {curve(2e-3), bending(3e-3), moved_base(1e-2)}, some_support(arm));
  const JointMatrix q = poses_within(arm, 1000, 4);
  const Covariates covariates = some_covariates();
  EXPECT_EQ(model.forward(view_of(q), covariates, 1).poses,
            model.forward(view_of(q), covariates, 5).poses);
  EXPECT_EQ(model.jacobian(view_of(q), covariates, TipFrame::kWorld, 1).jacobians,
            model.jacobian(view_of(q), covariates, TipFrame::kWorld, 5).jacobians);
}

}  // namespace
}  // namespace bathyal
