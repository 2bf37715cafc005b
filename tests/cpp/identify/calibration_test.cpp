// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "bathyal/identify/fit/arm_fit.hpp"
#include "bathyal/identify/fit/calibration_problem.hpp"
#include "bathyal/identify/fit/calibration_search.hpp"
#include "bathyal/identify/fit/fit_results.hpp"
#include "bathyal/identify/fit/observability.hpp"
#include "bathyal/identify/identify_arm.hpp"
#include "support/simulated_touches.hpp"

// The steps of an identification, one by one.

namespace bathyal {
namespace {

Touches scattered_touches() {
  Touches touches = touch(built_arm(ur10e(), 1e-3, 5), three_points(), 15, 7);
  add_scatter(1e-4, 3, touches);
  return touches;
}

TEST(Calibration, ItsStepsGiveWhatIdentifyArmGives) {
  const Arm arm = ur10e();
  const Touches touches = scattered_touches();
  const Measurement measurement = to_measurement(arm, touches);
  const IdentifyOptions options;
  CalibrationProblem problem(arm, measurement, options);
  EXPECT_FALSE(problem.scale_observed);
  EXPECT_EQ(*problem.length_prior, options.size_prior);
  const Observability observability = observe(*problem.system, problem.start);
  EXPECT_EQ(observability.null_space.cols(), 1) << "the scale alone";
  EXPECT_EQ(observability.undetermined.cols(), 0) << "which the prior determines";
  const CalibrationResult found = search(problem, observability);
  EXPECT_TRUE(found.converged);
  const ArmFit fit = make_arm_fit(problem, observability, found);
  const ArmFit whole = identify_arm(arm, touches);
  EXPECT_EQ(fit.values, whole.values);
  EXPECT_EQ(fit.rms_after, whole.rms_after);
  EXPECT_LT(fit.rms_after, 0.2 * fit.rms_before);
}

TEST(Calibration, ConsistentJointsBringEveryTipOntoItsPoint) {
  const Arm arm = built_arm(ur10e(), 0.0, 1);
  const Measurement measurement = to_measurement(arm, scattered_touches());
  const IdentifyOptions options;
  CalibrationProblem problem(arm, measurement, options);
  EXPECT_GT(problem.system->deviations(problem.start).norm(), 1e-3);
  ArmResiduals consistent = *problem.system;
  const Eigen::Matrix3Xd before = problem.system->centroids(problem.start);
  consistent.set_joints(consistent_joints(*problem.system, problem.start));
  EXPECT_LT(consistent.deviations(problem.start).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((consistent.centroids(problem.start) - before).norm(), 1e-10);
}

TEST(Calibration, EffectsAreFixedAtTheirValues) {
  const Arm arm = ur10e();
  const Measurement measurement = to_measurement(arm, scattered_touches());
  const FixedEffect effect{
      {"sag", 1, {}, {{"sine", "rad", 1e-3}}, "sag"},
      Eigen::VectorXd::Constant(1, 2e-3),
      {{{PerturbationSite::kJoint, 1, RowMatrix::Ones(measurement.rows(), 1)}}}};
  const IdentifyOptions options;
  const CalibrationProblem problem(arm, measurement, options, {effect});
  const auto last = static_cast<int>(problem.parameters.parameters.size()) - 1;
  EXPECT_EQ(problem.parameters.parameters[last].nominal, 2e-3);
  EXPECT_EQ(problem.fixed, std::vector<int>{last});
  for (const int free : problem.system->free()) EXPECT_NE(free, last);
}

TEST(TipCovariance, IsFiniteAndSmallWhereTheScaleIsKnownAndRefusesOtherWidths) {
  Tracked tracked = track(built_arm(ur10e(), 1e-3, 5), 60, false, 3);
  add_noise(1e-4, 3, tracked);
  const ArmFit fit = identify_arm(ur10e(), tracked);
  for (const Eigen::Matrix3d& c : tip_covariance(fit, tracked.q)) {
    EXPECT_GT(c.trace(), 0.0);
    EXPECT_LT(std::sqrt(c.trace()), 1e-3);
    EXPECT_LT((c - c.transpose()).norm(), 1e-12 * c.norm());
  }
  EXPECT_THROW(tip_covariance(fit, RowMatrix::Zero(1, 5)), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
