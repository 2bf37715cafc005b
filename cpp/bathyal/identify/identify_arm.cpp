// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/identify_arm.hpp"

#include "bathyal/compensation/corrected_arm.hpp"
#include "bathyal/identify/checks/run_checks.hpp"
#include "bathyal/identify/fit/fit_results.hpp"

namespace bathyal {
namespace {

ArmFit run(const Arm& arm, const Measurement& measurement, const IdentifyOptions& options,
           const std::vector<FixedEffect>& effects = {}) {
  CalibrationProblem problem(arm, measurement, options, effects);
  // Observability is evaluated where the search starts: a direction that is unobservable there is
  // held, because the weak information on it elsewhere is unreliable (plain DH of nearly parallel
  // axes diverges along such directions).
  Observability observability = observe(*problem.system, problem.start);
  if (problem.drop_scale_prior(observability.null_space))
    observability = observe(*problem.system, problem.start);
  const CalibrationResult found = search(problem, observability);
  ArmFit fit = make_arm_fit(problem, observability, found);
  run_checks(measurement, *problem.system, arm, fit);
  return fit;
}

template <class Data>
ArmFit identify_with_effects(const CorrectedArm& model, const Data& data,
                             const IdentifyOptions& options) {
  options.check();
  const Measurement measurement = to_measurement(model.arm(), data);
  const JointView q(data.q.data(), data.q.rows(), data.q.cols());
  return run(model.arm(), measurement, options, model.fixed_effects(q, data.covariates));
}

}  // namespace

ArmFit identify_arm(const Arm& arm, const Touches& touches, const IdentifyOptions& options) {
  options.check();
  return run(arm, to_measurement(arm, touches), options);
}

ArmFit identify_arm(const Arm& arm, const Tracked& tracked, const IdentifyOptions& options) {
  options.check();
  return run(arm, to_measurement(arm, tracked), options);
}

ArmFit identify_arm(const CorrectedArm& model, const Touches& touches,
                    const IdentifyOptions& options) {
  return identify_with_effects(model, touches, options);
}

ArmFit identify_arm(const CorrectedArm& model, const Tracked& tracked,
                    const IdentifyOptions& options) {
  return identify_with_effects(model, tracked, options);
}

}  // namespace bathyal
