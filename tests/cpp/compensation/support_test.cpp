// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/compensation/support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "bathyal/effects/internal/library.hpp"
#include "support/corrected_arm_cases.hpp"
#include "support/example_effects.hpp"

namespace bathyal {
namespace {

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
  EXPECT_TRUE((within(found.uses) == expected).all()) << within(found.uses);
  EXPECT_TRUE((within(model.effect_uses(view_of(q), covariates)) == expected).all());
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

  // The curve alone, by its own formula: the arm is at 1.7, the curve at the nearest 1.
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

/// The only variant of an effect of the library along `joint`.
FoundEffect of_library(const std::shared_ptr<const Effect>& effect, const EffectData& data,
                       int joint, double value) {
  for (const EffectVariant& variant : effect->variants(data)) {
    if (variant.joint != joint) continue;
    return {effect, variant,
            Eigen::VectorXd::Constant(static_cast<Index>(variant.parameters.size()), value)};
  }
  throw std::logic_error("no such variant");
}

TEST(CorrectedArm, ExtrapolatesWhatFollowsFromKnownTorques) {
  Arm arm = irregular_arm(4);
  const RowMatrix training = 0.5 * RowMatrix::Random(60, arm.size());
  const EffectData data = make_effect_data(arm, training, {}, false);
  const FoundEffect sagging = of_library(effects::joint_compliance(), data, 2, 1e-5);
  const CorrectedArm model(arm, {sagging}, support_of(training, {}));
  const JointMatrix q = 1.5 * JointMatrix::Random(20, arm.size());
  const EffectData far = make_effect_data(arm, RowMatrix(q), {}, false);
  const CorrectedPoses found = model.forward(view_of(q));
  JointMatrix moved = q;
  moved.col(2) += 1e-5 * sagging.effect->perturbations(sagging.variant, far)[0][0].values.col(0);
  EXPECT_LT(difference(found.poses, forward(arm, view_of(moved))), 1e-14);
  EXPECT_GT((found.uses == EffectUse::kExtrapolated).count(), 15);
  EXPECT_EQ((found.uses == EffectUse::kHeld).count(), 0);

  // 3 kg at the tool, more than ever: the torque follows.
  const Covariates laden{{"payload", column({3.0})}};
  const JointMatrix home = JointMatrix::Zero(1, arm.size());
  EXPECT_EQ(model.effect_uses(view_of(home), laden)(0, 0), EffectUse::kExtrapolated);
  const Covariates unknown{{"payload", column({kNan})}};
  EXPECT_EQ(model.effect_uses(view_of(home), unknown)(0, 0), EffectUse::kOmitted);
}

TEST(CorrectedArm, HoldsAScaleThatWasFittedWithWaves) {
  const Arm arm = ur10e();
  const RowMatrix training = RowMatrix::Random(80, arm.size());
  const EffectData data = make_effect_data(arm, training, {}, false);
  const FoundEffect scale = of_library(effects::joint_scale(), data, 2, 1e-3);
  const FoundEffect wave = of_library(effects::joint_harmonic(), data, 2, 1e-3);
  const FoundEffect other = of_library(effects::joint_harmonic(), data, 3, 1e-3);
  const JointMatrix q = JointMatrix::Constant(1, arm.size(), 2.0);
  const auto use_in = [&](std::vector<FoundEffect> found) {
    return CorrectedArm(arm, std::move(found), support_of(training, {}))
        .effect_uses(view_of(q))(0, 0);
  };
  EXPECT_EQ(use_in({scale}), EffectUse::kExtrapolated);
  EXPECT_EQ(use_in({scale, other}), EffectUse::kExtrapolated);
  EXPECT_EQ(use_in({scale, wave}), EffectUse::kHeld);
}

TEST(CorrectedArm, GivesTheReasonsOfARow) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {curve(2e-3), growth(1e-4), moved_base(1e-3)}, some_support(arm));
  JointMatrix q = JointMatrix::Constant(5, arm.size(), 0.3);
  q(1, 0) = 1.5;  // an argument of the curve and the growth
  q(2, 5) = 1.5;  // of nothing
  const std::vector<std::string> reasons = model.support_reasons(
      view_of(q),
      {{"temperature", column({15, 15, 15, 35, kNan})}, {"session", column({1, 1, 1, 7, kNan})}});
  EXPECT_EQ(reasons[0], "");
  EXPECT_EQ(reasons[1], "joint 1 at 1.5 rad, data -1 to 1: curve of joint 2 held, growth held");
  EXPECT_EQ(reasons[2], "");
  EXPECT_EQ(reasons[3],
            "temperature at 35, data 10 to 30: growth held; session 7, not in the data: "
            "moved_base omitted");
  EXPECT_EQ(reasons[4], "temperature unknown: growth omitted; session unknown: moved_base omitted");
  EXPECT_EQ(model.support_reasons(view_of(q))[0],
            "temperature not given: growth omitted; session not given: moved_base omitted");
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
  return {of(effects::joint_harmonic(), 2, 3.0), of(effects::joint_harmonic(), 2, 9.0),
          of(effects::joint_map(), 3, 4.0)};
}

TEST(CorrectedArm, HoldsWavesInGapsWiderThanTheirPeriod) {
  const Arm arm = ur10e();
  // Every 0.01 from -1 to 1, less a stretch of 0.8 (wider than the shorter wave, 2π / 9, and so for
  // both of joint 3; not than the map's 2π / 4), with one row that lies alone in it.
  RowMatrix training_q(201, arm.size());
  for (Index i = 0; i < training_q.rows(); ++i)
    training_q.row(i).setConstant(-1.0 + 0.01 * static_cast<double>(i));
  for (Index i = 0; i < training_q.rows(); ++i) {
    if (training_q(i, 0) > -0.2 && training_q(i, 0) < 0.6) training_q.row(i).setConstant(-0.2);
  }
  const CorrectedArm model(arm, waves(arm), support_of(training_q, {}));
  JointMatrix q = JointMatrix::Constant(3, arm.size(), -0.5);
  q.row(1).setConstant(0.21);
  q(2, 0) = q(2, 1) = 0.21;
  SupportMask expected = SupportMask::Constant(3, 3, true);
  expected(1, 0) = expected(1, 1) = false;
  const CorrectedPoses found = model.forward(view_of(q));
  EXPECT_TRUE((within(found.uses) == expected).all()) << within(found.uses);

  // Far from both edges at the average over the support: here by a plain sum over both stretches.
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
  const CorrectedArm mapped(arm, {waves(arm)[2]}, support_of(training_q, {}));
  JointMatrix moved = q.row(1);
  moved(0, 2) += sum / kParts;
  const Pose tip = pose_at(mapped.forward(view_of(moved)).poses, 0);
  EXPECT_LT((tip.translation() - pose_at(found.poses, 1).translation()).norm(), 1e-5);
  EXPECT_GT(std::abs(sum / kParts), 1e-4);

  EXPECT_EQ(model.support_reasons(view_of(q))[1],
            "joint 3 at 0.21 rad, in the gap of the data from -0.2 to 0.6: joint_harmonic of joint "
            "3 held");
  const std::vector<std::vector<Support::Gap>> gaps = model.gaps();
  ASSERT_EQ(gaps.size(), 6u);
  for (std::size_t j = 0; j < gaps.size(); ++j) EXPECT_EQ(gaps[j].size(), j == 2 ? 1u : 0u);
  EXPECT_NEAR(gaps[2][0].low, -0.2, 1e-12);
  EXPECT_NEAR(gaps[2][0].high, 0.6, 1e-12);
}

TEST(CorrectedArm, GoesOverFromTheEdgeToTheAverageWithoutAJump) {
  const Arm arm = ur10e();
  RowMatrix training_q(101, arm.size());
  for (Index i = 0; i < training_q.rows(); ++i)
    training_q.row(i).setConstant(-1.0 + 0.02 * static_cast<double>(i));
  const CorrectedArm model(arm, {waves(arm)[1]}, support_of(training_q, {}));
  // Half a period of order 9 beyond the edge, and farther.
  constexpr double kHalf = 0.5 * 2.0 * 3.14159265358979 / 9.0;
  const std::vector<double> beyond{0.0, 1e-9, 0.5 * kHalf, kHalf, 2.0 * kHalf, 1.0};
  JointMatrix q = JointMatrix::Zero(static_cast<Index>(beyond.size()), arm.size());
  for (std::size_t i = 0; i < beyond.size(); ++i) q(static_cast<Index>(i), 2) = 1.0 + beyond[i];
  const RowMatrix moved =
      model.fixed_effects(view_of(q), {})[0].perturbations[0][0].values.array() * 1e-3;
  EXPECT_NEAR(moved(0, 0), moved(1, 0), 1e-10);
  EXPECT_NEAR(moved(2, 0), 0.5 * (moved(0, 0) + moved(4, 0)), 1e-12);
  EXPECT_NEAR(moved(3, 0), moved(4, 0), 1e-12);
  EXPECT_EQ(moved(4, 0), moved(5, 0));
  EXPECT_GT(std::abs(moved(0, 0) - moved(4, 0)), 1e-4);
}

TEST(CorrectedArm, ALoneRowInAGapTeachesNothingNearIt) {
  const Arm arm = ur10e();
  RowMatrix training_q(102, arm.size());
  for (Index i = 0; i < 51; ++i) {
    training_q.row(i).setConstant(-2.0 + 0.02 * static_cast<double>(i));
    training_q.row(i + 51).setConstant(1.0 + 0.02 * static_cast<double>(i));
  }
  const Support without = support_of(training_q, {});
  RowMatrix more(103, arm.size());
  more << training_q, RowMatrix::Constant(1, arm.size(), 0.1);
  const std::vector<FoundEffect> found{waves(arm)[0], waves(arm)[1]};
  const CorrectedArm one(arm, found, without), other(arm, found, support_of(more, {}));
  for (const double near : {0.101, 0.15, 0.55}) {
    const JointMatrix q = JointMatrix::Constant(1, arm.size(), near);
    EXPECT_FALSE(within(one.effect_uses(view_of(q)))(0, 0));
    EXPECT_FALSE(within(other.effect_uses(view_of(q)))(0, 0));
    EXPECT_LT(difference(one.forward(view_of(q)).poses, other.forward(view_of(q)).poses), 1e-12)
        << near;
  }
}

TEST(CorrectedArm, IsRigidWhereEverythingIsLeftOut) {
  const Arm arm = irregular_arm(3);
  const CorrectedArm model(arm, {growth(1e-3), moved_base(1e-3)}, some_support(arm));
  const JointMatrix q = JointMatrix::Constant(4, arm.size(), 0.7);
  const CorrectedPoses found =
      model.forward(view_of(q), {{"temperature", column({kNan})}, {"session", column({7.0})}});
  EXPECT_FALSE(within(found.uses).any());
  EXPECT_EQ(found.poses, forward(arm, view_of(q)));
}

TEST(CorrectedArm, CountsNoLoadWhereNoneIsTold) {
  const Arm arm = ur10e();
  const JointMatrix q = JointMatrix::Zero(1, arm.size());
  const CorrectedArm model(arm, {sag(1e-3)}, some_support(arm));
  EXPECT_EQ(model.forward(view_of(q)).poses, forward(arm, view_of(q)));
  const Support bare = support_of(RowMatrix(q), {});
  const CorrectedArm unladen(arm, {sag(1e-3)}, bare);
  EXPECT_TRUE(within(unladen.effect_uses(view_of(q))).all());
  EXPECT_FALSE(within(unladen.effect_uses(view_of(q), {{"payload", column({1.0})}})).any());
}

TEST(CorrectedArm, HasNoBoundsForDifferences) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {late(0.1)}, some_support(arm));
  const JointMatrix q = JointMatrix::Constant(3, arm.size(), 2.0);
  EXPECT_TRUE(within(model.effect_uses(view_of(q), {{"time", column({1e6})}})).all());
}

TEST(CorrectedArm, InverseHoldsBeyondTheSupport) {
  const Arm arm = ur10e();
  const CorrectedArm model(arm, {curve(3e-3)}, some_support(arm));
  JointMatrix q = JointMatrix::Constant(1, arm.size(), 0.5);
  q(0, 1) = -1.8;
  const std::vector<double> targets = model.forward(view_of(q)).poses;
  const CorrectedInverse found = model.inverse(targets, view_of(q));
  EXPECT_EQ(found.result.status[0], InverseStatus::kReached);
  EXPECT_FALSE(within(found.uses)(0, 0));
  EXPECT_LT((found.result.q - q).cwiseAbs().maxCoeff(), 1e-8);
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

  RowMatrix query(6, 2);
  query << 0.2, 3.0, 0.5, 3.0, 0.6, 3.0, 0.9, 3.0, -1.0, 3.0, 2.0, 3.0;
  RowMatrix near = query;
  EXPECT_FALSE(support.leave_gaps(0.7, near));
  EXPECT_TRUE(support.leave_gaps(0.5, near));
  EXPECT_TRUE(near.col(0).isApprox(column({0.004, 0.6, 0.6, 0.9, -1.0, 2.0})));
  EXPECT_TRUE(
      support.training_values(0, 0.5, 2).isApprox(column({0.101 + 0.596, 0.899}).col(0), 1e-12))
      << support.training_values(0, 0.5, 2);
  const auto weight = [&support](double value, double edge, double period) {
    return support.edge_weights(Eigen::ArrayXd::Constant(1, value),
                                Eigen::ArrayXd::Constant(1, edge), period, 0)[0];
  };
  EXPECT_EQ(weight(0.6, 0.6, 0.3), 1.0);  // a lone pose
  EXPECT_EQ(weight(0.601, 0.6, 0.3), 0.0);
  EXPECT_EQ(weight(0.599, 0.6, 0.3), 0.0);
  EXPECT_NEAR(weight(0.005, 0.004, 0.5), 0.75, 1e-12);  // 0 to 0.004
  EXPECT_EQ(weight(0.009, 0.004, 0.5), 0.0);
  EXPECT_NEAR(weight(0.5, 0.6, 0.5), 0.6, 1e-12);  // 0.6 to 1
  EXPECT_NEAR(weight(1.1, 1.0, 0.5), 0.6, 1e-12);
  EXPECT_NEAR(weight(1.175, 1.0, 0.7), 0.5, 1e-12);  // no such gap
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
  const SupportMask mask = within(model.effect_uses(view_of(q)));
  EXPECT_TRUE(mask(0, 0));
  EXPECT_FALSE(mask(1, 0));
}

}  // namespace
}  // namespace bathyal
