// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/compensation/corrected_arm.hpp"
#include "diagnosis/small_arms.hpp"

namespace bathyal::diagnosis {
namespace {

/// Poses in which joint 1 turns by a third of a turn only, with an error of two waves.
Tracked little_moved(double size) {
  const Arm arm = three_joints();
  Tracked out;
  out.q = RowMatrix(150, 3);
  out.position = RowMatrix(150, 3);
  for (Index i = 0; i < out.q.rows(); ++i) {
    RandomStream random(5, static_cast<std::uint64_t>(i));
    for (Index j = 0; j < 3; ++j) out.q(i, j) = random.uniform(-2.0, 2.0);
    out.q(i, 0) *= 0.5;
    Eigen::VectorXd q = out.q.row(i);
    q[0] += size * (std::cos(4.0 * q[0]) - std::sin(7.0 * q[0]));
    const RowFrames frames = row_frames(arm, {q.data(), 3});
    for (Index axis = 0; axis < 3; ++axis) {
      out.position(i, axis) = frames.world_from_tool.translation()[axis] + 1e-4 * random.normal();
    }
  }
  return out;
}

/// The largest value of a fitted curve of twelve waves along joint 1.
double largest_value(double size) {
  const Arm arm = three_joints();
  const IdentifyOptions options;
  const Measurement measurement = to_measurement(arm, little_moved(size));
  ArmModel arm_model(arm, measurement, {}, options, library_effects());
  for (int term = 0; term < static_cast<int>(arm_model.terms().size()); ++term) {
    const selection::Term& about = arm_model.terms()[term];
    if (about.effect != "joint_map" || about.joint != 0) continue;
    const EffectVariant& variant = arm_model.variant(term);
    if (variant.parameters.size() < 20) continue;
    arm_model.fit({term});
    return arm_model.found().front().values.cwiseAbs().maxCoeff();
  }
  ADD_FAILURE() << "no curve of twelve waves";
  return 0.0;
}

TEST(ArmModel, HardlyDeterminedValuesShrinkToTheScaleOfTheOthers) {
  // 2e-2 rad are plausible; without shrinkage, such waves over a third of a turn reach that.
  EXPECT_LT(largest_value(1e-3), 4e-3);
  EXPECT_LT(largest_value(1e-4), 1e-3);
}

int wave_of_joint_1(const ArmModel& arm_model) {
  for (int term = 0; term < static_cast<int>(arm_model.terms().size()); ++term) {
    if (arm_model.terms()[term].effect == "joint_harmonic" && arm_model.terms()[term].joint == 0) {
      return term;
    }
  }
  return -1;
}

TEST(ArmModel, RestoresACheckpoint) {
  const Arm arm = three_joints();
  const IdentifyOptions options;
  const Measurement measurement = to_measurement(arm, little_moved(1e-3));
  ArmModel arm_model(arm, measurement, {}, options, library_effects());
  const int term = wave_of_joint_1(arm_model);
  ASSERT_GE(term, 0);
  arm_model.fit({term});
  const selection::Linearization there = arm_model.linearization();
  const Eigen::VectorXd values = arm_model.found().front().values;
  const auto checkpoint = arm_model.save();
  arm_model.set_observation_weights(Eigen::VectorXd::Constant(measurement.rows(), 0.5));
  arm_model.fit({term, term + 3});
  ASSERT_EQ(arm_model.found().size(), 2u);
  arm_model.restore(*checkpoint);
  EXPECT_LT((arm_model.found().front().values - values).norm(), 1e-12);
  EXPECT_LT((arm_model.linearization().residual - there.residual).norm(),
            1e-8 * there.residual.norm());
  EXPECT_LT((arm_model.linearization().jacobian - there.jacobian).norm(),
            1e-8 * there.jacobian.norm());
}

/// The same poses, of an arm whose joints 2 and 3 give way under 20 kg behind each of them.
Tracked elastic() {
  const Arm arm = three_joints();
  const Tracked rigid = little_moved(0.0);
  Tracked out = rigid;
  for (Index i = 0; i < out.q.rows(); ++i) {
    RandomStream random(6, static_cast<std::uint64_t>(i));
    Eigen::VectorXd q = out.q.row(i);
    const double behind_2 = 0.5 * std::cos(q[1]), behind_3 = 0.4 * std::cos(q[1] + q[2]);
    q[1] -= 1e-5 * 20.0 * 9.80665 * (behind_2 + (behind_2 + behind_3));
    q[2] -= 2e-5 * 20.0 * 9.80665 * behind_3;
    const RowFrames frames = row_frames(arm, {q.data(), 3});
    for (Index axis = 0; axis < 3; ++axis) {
      out.position(i, axis) = frames.world_from_tool.translation()[axis] + 1e-5 * random.normal();
    }
  }
  return out;
}

/// Torques depend on the geometry: the fitted ones must be those that the fitted arm gives.
TEST(ArmModel, EffectsAreEvaluatedAtTheFittedArm) {
  const Arm arm = three_joints();
  const IdentifyOptions options;
  const Measurement measurement = to_measurement(arm, elastic());
  ArmModel arm_model(arm, measurement, {}, options, library_effects());
  std::vector<int> terms;
  for (int term = 0; term < static_cast<int>(arm_model.terms().size()); ++term) {
    const selection::Term& about = arm_model.terms()[term];
    if (about.effect == "joint_compliance" && about.joint > 0) terms.push_back(term);
  }
  ASSERT_EQ(terms.size(), 2u);
  arm_model.fit(terms);
  const CorrectedArm model(arm_model.arm(), arm_model.found(), support_of(measurement.q, {}));
  const std::vector<double> poses =
      model.forward({measurement.q.data(), measurement.q.rows(), measurement.q.cols()}).poses;
  Eigen::Matrix3Xd residuals(3, measurement.rows());
  for (Index i = 0; i < measurement.rows(); ++i) {
    for (Index axis = 0; axis < 3; ++axis) residuals(axis, i) = poses[16 * i + 4 * axis + 3];
  }
  residuals -= measurement.position;
  EXPECT_LT((residuals - arm_model.deviations()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size())), 1.05e-5);
  // A checkpoint restores the arm at which effects were evaluated, too.
  const auto checkpoint = arm_model.save();
  const Eigen::Matrix3Xd there = arm_model.deviations();
  arm_model.fit({});
  arm_model.restore(*checkpoint);
  EXPECT_EQ(arm_model.deviations(), there);
}

/// An effect that depends on neighbours in time (clocks out of step) is the same in a subset of
/// rows as in the whole record.
TEST(ArmModel, ASubsetEvaluatesEffectsAsTheWholeRecord) {
  const Arm arm = three_joints();
  const IdentifyOptions options;
  const Tracked tracked = little_moved(1e-3);
  const Measurement measurement = to_measurement(arm, tracked);
  RowMatrix time(measurement.rows(), 1);
  for (Index i = 0; i < measurement.rows(); ++i) time(i, 0) = 0.5 * static_cast<double>(i);
  ArmModel whole(arm, measurement, {{"time", time}}, options, library_effects());
  std::vector<int> rows;
  for (int i = 0; i < measurement.rows(); i += 2) rows.push_back(i);
  const ArmModel subset(whole, rows);
  ASSERT_EQ(subset.terms().size(), whole.terms().size());
  int asked = 0;
  for (int term = 0; term < static_cast<int>(whole.terms().size()); ++term) {
    const std::string& effect = whole.terms()[term].effect;
    if (effect != "clock_shift" && effect != "tool_slip" && effect != "joint_map") continue;
    const Eigen::MatrixXd all = whole.columns(std::vector<int>{term}).front();
    const Eigen::MatrixXd part = subset.columns(std::vector<int>{term}).front();
    ASSERT_EQ(part.cols(), all.cols());
    // In units of each one's noise, at geometries that differ a little.
    for (Index c = 0; c < all.cols(); ++c) {
      Eigen::VectorXd same(3 * static_cast<Index>(rows.size()));
      for (Index i = 0; i < same.size() / 3; ++i) {
        same.segment<3>(3 * i) = all.col(c).segment<3>(3 * rows[i]);
      }
      same *= whole.noise() / subset.noise();
      EXPECT_LT((part.col(c) - same).norm(), 0.05 * same.norm() + 1e-9) << effect << " " << c;
    }
    ++asked;
  }
  EXPECT_GT(asked, 3);
}

TEST(ArmModel, RowsAreOrderedByTime) {
  const Arm arm = three_joints();
  const IdentifyOptions options;
  const Measurement measurement = to_measurement(arm, little_moved(1e-3));
  RowMatrix time(measurement.rows(), 1);
  for (Index i = 0; i < measurement.rows(); ++i) {
    time(i, 0) = static_cast<double>((7 * i + 3) % measurement.rows());
  }
  const ArmModel arm_model(arm, measurement, {{"time", time}}, options, {});
  for (Index i = 0; i < measurement.rows(); ++i) {
    ASSERT_EQ(arm_model.observations().order[i], static_cast<int>(time(i, 0)));
  }
}

/// Mean squares of rows along the errors of rounded joints, and across them [noise²].
std::pair<double, double> along_and_across(const ArmModel& arm_model,
                                           const Eigen::MatrixXd& loads) {
  const selection::Linearization& at = arm_model.linearization();
  double along = 0.0, across = 0.0;
  const Index poses = loads.rows() / 3;
  for (Index i = 0; i < poses; ++i) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> own(loads.middleRows<3>(3 * i), Eigen::ComputeFullU);
    const Eigen::Vector3d row = at.residual.segment<3>(3 * i);
    along += std::pow(own.matrixU().col(0).dot(row), 2) / static_cast<double>(poses);
    across += std::pow(own.matrixU().col(2).dot(row), 2) / static_cast<double>(poses);
  }
  return {along, across};
}

TEST(ArmModel, RoundedJointsAreWhitened) {
  const Arm arm = three_joints();
  const IdentifyOptions options;
  constexpr double kStep = 2e-3;
  Tracked tracked = little_moved(0.0);
  tracked.q = (tracked.q / kStep).array().round() * kStep;
  const Measurement measurement = to_measurement(arm, tracked);
  ArmModel arm_model(arm, measurement, {}, options, library_effects());
  ASSERT_EQ(arm_model.variance_components().back().effect, "quantisation");
  const Eigen::MatrixXd& loads = arm_model.variance_components().back().loads;
  arm_model.fit({});
  const auto [along, across] = along_and_across(arm_model, loads);
  EXPECT_GT(along, 4.0 * across);

  Eigen::VectorXd ratios =
      Eigen::VectorXd::Zero(static_cast<Index>(arm_model.variance_components().size()));
  ratios.tail(1).setConstant(std::pow(kStep / 1e-4, 2));
  arm_model.set_variance_ratios(ratios);
  arm_model.fit({});
  const auto [along_then, across_then] = along_and_across(arm_model, loads);
  EXPECT_NEAR(along_then, 1.0, 0.35);
  EXPECT_NEAR(across_then, 1.0, 0.35);
  EXPECT_NEAR(arm_model.noise(), 1e-4, 1.5e-5);
  // Whitened residuals are converted back to metres.
  const Eigen::Matrix3Xd metres = arm_model.in_metres(arm_model.linearization().residual);
  EXPECT_LT((metres + arm_model.deviations()).norm(), 1e-6 * metres.norm());
  const double rms = std::sqrt(metres.squaredNorm() / static_cast<double>(metres.size()));
  EXPECT_NEAR(arm_model.mean_noise(), rms, 0.1 * rms);
  EXPECT_LT(arm_model.mean_unit(), 0.7 * rms);
}

}  // namespace
}  // namespace bathyal::diagnosis
