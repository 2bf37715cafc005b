// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/identify_arm.hpp"

#include "bathyal/base/check.hpp"
#include "bathyal/compensation/corrected_arm.hpp"
#include "bathyal/identify/checks/run_checks.hpp"
#include "bathyal/identify/fit/fit_results.hpp"

namespace bathyal {
namespace {

ArmFit identify(const Arm& arm, const Measurement& measurement, const IdentifyOptions& options,
                const std::vector<HeldEffect>& effects = {}) {
  ArmProblem problem(arm, measurement, options, effects);
  // What the data see is asked where the search starts: a direction that is dark there is held, for
  // the little light that it gets elsewhere is not to be trusted (plain DH beside parallel axes
  // runs off along such directions).
  Observability seen = observe(*problem.system, problem.start);
  if (problem.drop_size_prior(seen.unseen)) seen = observe(*problem.system, problem.start);
  const SearchResult found = search(problem, seen);
  ArmFit fit = report(problem, seen, found);
  examine(measurement, *problem.system, arm, fit);
  return fit;
}

template <class Data>
ArmFit identify_with_effects(const CorrectedArm& model, const Data& data,
                             const IdentifyOptions& options) {
  options.check();
  const Measurement measurement = to_measurement(model.arm(), data);
  const JointView q(data.q.data(), data.q.rows(), data.q.cols());
  return identify(model.arm(), measurement, options, model.held(q, data.covariates));
}

}  // namespace

void IdentifyOptions::check() const {
  check_range("nearly_parallel", nearly_parallel, 0.0, 0.5);
  LeastSquaresOptions{.max_iterations = max_iterations}.check();
  if (length_prior) check_positive("length_prior", *length_prior);
  if (angle_prior) check_positive("angle_prior", *angle_prior);
  for (const auto& [name, std] : priors) check_positive("priors " + name, std);
  check_positive("size_prior", size_prior);
  if (noise) check_positive("noise", *noise);
  if (rotation_noise) check_positive("rotation_noise", *rotation_noise);
  if (loss_width) check_positive("loss_width", *loss_width);
  if (prune_sigma) check_positive("prune_sigma", *prune_sigma);
}

ArmFit identify_arm(const Arm& arm, const Touches& touches, const IdentifyOptions& options) {
  options.check();
  return identify(arm, to_measurement(arm, touches), options);
}

ArmFit identify_arm(const Arm& arm, const Tracked& tracked, const IdentifyOptions& options) {
  options.check();
  return identify(arm, to_measurement(arm, tracked), options);
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
