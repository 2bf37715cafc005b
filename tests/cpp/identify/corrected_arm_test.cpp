// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/corrected_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "../arm/arms.hpp"
#include "bathyal/identify/effects_library.hpp"
#include "bathyal/identify/rotation_vector.hpp"
#include "some_effects.hpp"

namespace bathyal {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

RowMatrix column(std::vector<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
}

/// Within ±1 of every joint, 10 … 30 °C, sessions 1 and 2, up to 200 s and 2 kg.
Support some_support(const Arm& arm) {
  RowMatrix q(2, arm.size());
  q.row(0).setConstant(-1.0);
  q.row(1).setConstant(1.0);
  return support_of(q, {{"temperature", column({10.0, 30.0})},
                        {"session", column({1.0, 2.0})},
                        {"time", column({0.0, 200.0})},
                        {"payload", column({0.0, 2.0})}});
}

JointMatrix poses_within(const Arm& arm, Index count, std::uint64_t seed) {
  RandomStream random(seed);
  JointMatrix q(count, arm.size());
  for (Index i = 0; i < q.size(); ++i) q.data()[i] = random.uniform(-0.99, 0.99);
  return q;
}

Covariates some_covariates() {
  return {{"temperature", column({26.0})},
          {"session", column({2.0})},
          {"time", column({150.0})},
          {"payload", column({1.5})}};
}

Pose pose_at(const std::vector<double>& poses, Index row) {
  Pose pose;
  pose.matrix() = Eigen::Map<const RowMajor4>(&poses[16 * static_cast<std::size_t>(row)]);
  return pose;
}

double difference(const std::vector<double>& one, const std::vector<double>& other) {
  const auto size = static_cast<Index>(one.size());
  return (Eigen::Map<const Eigen::VectorXd>(one.data(), size) -
          Eigen::Map<const Eigen::VectorXd>(other.data(), size))
      .lpNorm<Eigen::Infinity>();
}

Pose twist(const Eigen::Vector<double, 6>& numbers) {
  Pose pose;
  pose.matrix().setIdentity();
  pose.translation() = numbers.head(3);
  pose.linear() = rotation_of(numbers.tail(3));
  return pose;
}

TEST(CorrectedArm, ComposesTheChainAsItsHeaderSays) {
  const Arm arm = odd_arm(4);
  const std::vector<FoundEffect> effects{curve(2e-3), bending(3e-3), moved_base(1e-2),
                                         slip(4e-3),  growth(1e-3),  sag(1e-3)};
  const CorrectedArm model(arm, effects, some_support(arm));
  const JointMatrix q = poses_within(arm, 5, 1);
  const CorrectedPoses found = model.forward(view_of(q), some_covariates());
  EXPECT_TRUE(found.in_support.all());
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
  const Arm arm = odd_arm(2);
  const CorrectedArm model(arm, {}, some_support(arm));
  const JointMatrix q = random_poses(arm, 20, 3);
  EXPECT_EQ(model.forward(view_of(q)).poses, forward(arm, view_of(q)));
  EXPECT_EQ(model.forward_links(view_of(q)).poses, forward_links(arm, view_of(q)));
  EXPECT_LT(difference(model.jacobian(view_of(q)).jacobians, jacobian(arm, view_of(q))), 1e-13);
}

TEST(CorrectedArm, LinksStandOnTheChain) {
  const Arm arm = odd_arm(6);
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
  const Arm arm = odd_arm(9);
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
  const CorrectedJacobians told = model.jacobian(view_of(q), covariates, TipFrame::kTool);
  const JointView world(found.jacobians.data(), 6, arm.size());
  const JointView tool(told.jacobians.data(), 6, arm.size());
  const Eigen::Matrix3d turn = pose_at(poses.poses, 0).linear();
  EXPECT_LT((turn * tool.topRows(3) - world.topRows(3)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(CorrectedArm, SaysWhichEffectsCount) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {curve(2e-3), growth(1e-4), slip(1e-3), moved_base(1e-3)},
                           some_support(arm));
  JointMatrix q = JointMatrix::Constant(7, arm.size(), 0.3);
  q(1, 0) = 1.5;  // an argument of the curve and the growth
  q(2, 5) = 1.5;  // of nothing
  const Covariates covariates{
      {"temperature", column({15, 15, 15, 35, 15, 15, kNan})},
      {"time", column({50, 50, 50, 50, 900, 150, 150})},  // once slipped, it stays so
      {"session", column({1, 1, 1, 1, 1, 3, kNan})}};
  const CorrectedPoses found = model.forward(view_of(q), covariates);
  SupportMask expected = SupportMask::Constant(7, 4, true);
  expected(1, 0) = expected(1, 1) = expected(3, 1) = expected(6, 1) = false;
  expected(5, 3) = expected(6, 3) = false;
  EXPECT_TRUE((found.in_support == expected).all()) << found.in_support;
  EXPECT_TRUE((model.in_support(view_of(q), covariates) == expected).all());
}

TEST(CorrectedArm, HoldsWhatLiesBeyondAtTheNearestRow) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {curve(2e-3), growth(1e-4)}, some_support(arm));
  const JointMatrix q = JointMatrix::Constant(1, arm.size(), 0.3);
  const auto tip = [&](JointMatrix at, double temperature) {
    return pose_at(model.forward(view_of(at), {{"temperature", column({temperature})}}).poses, 0);
  };
  EXPECT_TRUE(tip(q, 45.0).isApprox(tip(q, 30.0), 0.0));
  EXPECT_TRUE(tip(q, -5.0).isApprox(tip(q, 10.0), 0.0));

  // The curve alone, by its own formula: the arm stands at 1.7, the curve at the nearest 1.
  const CorrectedArm curved(arm, {curve(2e-3)}, some_support(arm));
  JointMatrix far = q, moved = q;
  far(0, 0) = moved(0, 0) = 1.7;
  moved(0, 1) += 2e-3 * (std::sin(0.9) + std::cos(1.0));
  EXPECT_LT(difference(curved.forward(view_of(far)).poses, forward(arm, view_of(moved))), 1e-15);
  // What is held no longer changes with the joint that left the support.
  const CorrectedJacobians found = curved.jacobian(view_of(far));
  const std::vector<double> rigid = jacobian(arm, view_of(moved));
  const JointView one(found.jacobians.data(), 6, arm.size()), other(rigid.data(), 6, arm.size());
  EXPECT_LT((one.col(0) - other.col(0)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT((one.col(1) - other.col(1)).cwiseAbs().maxCoeff(), 1e-4);
}

/// Two waves along the third joint and a map along the fourth, of the library.
std::vector<FoundEffect> waves(const Arm& arm) {
  const auto of = [&](std::shared_ptr<const Effect> effect, int joint, double setting) {
    RowMatrix q = RowMatrix::Random(80, arm.size());
    const EffectData data = make_effect_data(arm, q, {}, false);
    for (EffectVariant& variant : effect->variants(data)) {
      if (variant.joint != joint || variant.settings.begin()->second != setting) continue;
      const auto size = static_cast<Index>(variant.parameters.size());
      return FoundEffect{effect, variant, Eigen::VectorXd::LinSpaced(size, 1e-3, 2e-3)};
    }
    throw std::logic_error("no such form");
  };
  return {of(joint_harmonic(), 2, 3.0), of(joint_harmonic(), 2, 9.0), of(joint_map(), 3, 4.0)};
}

TEST(CorrectedArm, HoldsWavesInGapsWiderThanTheirPeriod) {
  const Arm arm = ur10e();
  // Every 0.01 from -1 to 1, less a stretch of 0.8 (wider than the shorter wave, 2π / 9, and so for
  // both of joint 3; not than the map's 2π / 4), with one row that lies alone in it.
  RowMatrix taught(201, arm.size());
  for (Index i = 0; i < taught.rows(); ++i)
    taught.row(i).setConstant(-1.0 + 0.01 * static_cast<double>(i));
  for (Index i = 0; i < taught.rows(); ++i) {
    if (taught(i, 0) > -0.2 && taught(i, 0) < 0.6) taught.row(i).setConstant(-0.2);
  }
  const CorrectedArm model(arm, waves(arm), support_of(taught, {}));
  JointMatrix q = JointMatrix::Constant(3, arm.size(), -0.5);
  q.row(1).setConstant(0.1);
  q(2, 0) = q(2, 1) = 0.1;
  SupportMask expected = SupportMask::Constant(3, 3, true);
  expected(1, 0) = expected(1, 1) = false;
  const CorrectedPoses found = model.forward(view_of(q));
  EXPECT_TRUE((found.in_support == expected).all()) << found.in_support;

  // Held at the average of what was taught: here by a plain sum over both stretches.
  const auto wave = [](double at) {
    return 1e-3 * (std::cos(3 * at) + std::cos(9 * at)) +
           2e-3 * (std::sin(3 * at) + std::sin(9 * at));
  };
  double sum = 0.0;
  constexpr int kParts = 1200;
  for (int i = 0; i < kParts; ++i) {
    const double along = -1.0 + 1.2 * (i + 0.5) / kParts;
    sum += wave(along < -0.2 ? along : along + 0.8);
  }
  const CorrectedArm mapped(arm, {waves(arm)[2]}, support_of(taught, {}));
  JointMatrix moved = q.row(1);
  moved(0, 2) += sum / kParts;
  const Pose tip = pose_at(mapped.forward(view_of(moved)).poses, 0);
  EXPECT_LT((tip.translation() - pose_at(found.poses, 1).translation()).norm(), 1e-5);
  EXPECT_GT(std::abs(sum / kParts), 1e-4);
}

TEST(CorrectedArm, ALoneRowInAGapTeachesNothing) {
  const Arm arm = ur10e();
  RowMatrix taught(102, arm.size());
  for (Index i = 0; i < 51; ++i) {
    taught.row(i).setConstant(-2.0 + 0.02 * static_cast<double>(i));
    taught.row(i + 51).setConstant(1.0 + 0.02 * static_cast<double>(i));
  }
  const Support without = support_of(taught, {});
  RowMatrix more(103, arm.size());
  more << taught, RowMatrix::Constant(1, arm.size(), 0.1);
  const std::vector<FoundEffect> found{waves(arm)[0], waves(arm)[1]};
  const CorrectedArm one(arm, found, without), other(arm, found, support_of(more, {}));
  const JointMatrix q = JointMatrix::Constant(1, arm.size(), 0.2);
  EXPECT_FALSE(one.in_support(view_of(q))(0, 0));
  EXPECT_FALSE(other.in_support(view_of(q))(0, 0));
  EXPECT_LT(difference(one.forward(view_of(q)).poses, other.forward(view_of(q)).poses), 1e-12);
}

TEST(CorrectedArm, IsRigidWhereEverythingIsLeftOut) {
  const Arm arm = odd_arm(3);
  const CorrectedArm model(arm, {growth(1e-3), moved_base(1e-3)}, some_support(arm));
  const JointMatrix q = JointMatrix::Constant(4, arm.size(), 0.7);
  const CorrectedPoses found =
      model.forward(view_of(q), {{"temperature", column({kNan})}, {"session", column({7.0})}});
  EXPECT_FALSE(found.in_support.any());
  EXPECT_EQ(found.poses, forward(arm, view_of(q)));
}

TEST(CorrectedArm, CountsNoLoadWhereNoneIsTold) {
  const Arm arm = ur10e();
  const JointMatrix q = JointMatrix::Zero(1, arm.size());
  const CorrectedArm model(arm, {sag(1e-3)}, some_support(arm));
  EXPECT_EQ(model.forward(view_of(q)).poses, forward(arm, view_of(q)));
  const Support bare = support_of(RowMatrix(q), {});
  const CorrectedArm unladen(arm, {sag(1e-3)}, bare);
  EXPECT_TRUE(unladen.in_support(view_of(q)).all());
  EXPECT_FALSE(unladen.in_support(view_of(q), {{"payload", column({1.0})}}).any());
}

TEST(CorrectedArm, HasNoBoundsForDifferences) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {late(0.1)}, some_support(arm));
  const JointMatrix q = JointMatrix::Constant(3, arm.size(), 2.0);
  EXPECT_TRUE(model.in_support(view_of(q), {{"time", column({1e6})}}).all());
}

TEST(CorrectedArm, AsksForCovariatesWhereSomeAreTold) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {growth(1e-4)}, some_support(arm));
  const JointMatrix q = JointMatrix::Zero(2, arm.size());
  const CorrectedPoses found = model.forward(view_of(q));
  EXPECT_FALSE(found.in_support.any());
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
  const auto of = [&](ToldEffect::Moves moves) {
    const JointMatrix q = JointMatrix::Zero(2, arm.size());
    CorrectedArm(arm, {found("broken", -1, 1.0, moves)}, some_support(arm)).forward(view_of(q));
  };
  EXPECT_THROW(of([](const EffectData&) {
                 return Action{Site::kJoint, 0, RowMatrix::Zero(1, 1)};
               }),
               std::invalid_argument);
  EXPECT_THROW(of([](const EffectData&) {
                 return Action{Site::kJoint, 6, RowMatrix::Zero(2, 1)};
               }),
               std::invalid_argument);
  EXPECT_THROW(of([](const EffectData&) {
                 return Action{Site::kFrame, 8, RowMatrix::Zero(2, 6)};
               }),
               std::invalid_argument);
  try {
    of([](const EffectData&) { return Action{Site::kJoint, 0, RowMatrix::Constant(2, 1, kNan)}; });
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

TEST(CorrectedArm, InverseHoldsBeyondTheSupport) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {curve(3e-3)}, some_support(arm));
  JointMatrix q = JointMatrix::Constant(1, arm.size(), 0.5);
  q(0, 1) = -1.8;
  const std::vector<double> targets = model.forward(view_of(q)).poses;
  const CorrectedInverse found = model.inverse(targets, view_of(q));
  EXPECT_EQ(found.result.status[0], InverseStatus::kReached);
  EXPECT_FALSE(found.in_support(0, 0));
  EXPECT_LT((found.result.q - q).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(CorrectedArm, IsTheSameForAnyNumberOfThreads) {
  const Arm arm = odd_arm(5);
  const CorrectedArm model(arm, {curve(2e-3), bending(3e-3), moved_base(1e-2)}, some_support(arm));
  const JointMatrix q = poses_within(arm, 1000, 4);
  const Covariates covariates = some_covariates();
  EXPECT_EQ(model.forward(view_of(q), covariates, 1).poses,
            model.forward(view_of(q), covariates, 5).poses);
  EXPECT_EQ(model.jacobian(view_of(q), covariates, TipFrame::kWorld, 1).jacobians,
            model.jacobian(view_of(q), covariates, TipFrame::kWorld, 5).jacobians);
}

TEST(Support, OfRowsLeavesOutWhatIsNotKnown) {
  RowMatrix q(3, 1);
  q << 0.5, -0.5, 0.1;
  const Support support = support_of(q, {{"temperature", column({kNan, 9.0, 21.0})},
                                         {"depth", column({kNan, kNan, kNan})},
                                         {"session", column({4.0, 2.0, 4.0})}});
  EXPECT_EQ(support.joints.low[0], -0.5);
  EXPECT_EQ(support.joints.high[0], 0.5);
  EXPECT_EQ(support.covariates.at("temperature").low[0], 9.0);
  EXPECT_FALSE(support.covariates.contains("depth"));
  EXPECT_EQ(support.sessions, (std::vector<double>{2.0, 4.0}));
  EXPECT_EQ(support.gravity.low[2], -9.80665);
  EXPECT_EQ(support.covariates.at("payload").high[0], 0.0);
}

TEST(Support, KnowsItsGaps) {
  RowMatrix q(5, 2);
  q << 0.0, 3.0, 1.0, 3.0, 0.004, 3.0, 0.6, 3.0, 0.6, 3.0;
  Support support = support_of(q, {});
  ASSERT_EQ(support.gaps.size(), 2u);
  ASSERT_EQ(support.gaps[0].size(), 2u);
  EXPECT_EQ(support.gaps[0][0].low, 0.004);
  EXPECT_EQ(support.gaps[0][1].high, 1.0);
  EXPECT_TRUE(support.gaps[1].empty());

  RowMatrix asked(6, 2);
  asked << 0.2, 3.0, 0.5, 3.0, 0.6, 3.0, 0.9, 3.0, -1.0, 3.0, 2.0, 3.0;
  RowMatrix near = asked;
  EXPECT_FALSE(support.leave_gaps(0.7, near));
  EXPECT_TRUE(support.leave_gaps(0.5, near));
  EXPECT_TRUE(near.col(0).isApprox(column({0.004, 0.6, 0.6, 0.9, -1.0, 2.0})));
  EXPECT_TRUE(support.taught(0, 0.5, 2).isApprox(column({0.101 + 0.596, 0.899}).col(0), 1e-12))
      << support.taught(0, 0.5, 2);
  EXPECT_NO_THROW(support.check(2));
  support.gaps[0][1].low = 0.5;
  EXPECT_THROW(support.check(2), std::invalid_argument);
  support.gaps.pop_back();
  EXPECT_THROW(support.check(2), std::invalid_argument);
}

TEST(Support, IsNotLeftByTheLastDigit) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {curve(1e-3)}, some_support(arm));
  JointMatrix q = JointMatrix::Constant(2, arm.size(), 1.0 + 1e-10);
  q.row(1).setConstant(1.0 + 1e-6);
  const SupportMask mask = model.in_support(view_of(q));
  EXPECT_TRUE(mask(0, 0));
  EXPECT_FALSE(mask(1, 0));
}

}  // namespace
}  // namespace bathyal
