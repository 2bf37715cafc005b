// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/calibration_problem.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bathyal/base/check.hpp"
#include "bathyal/identify/fit/internal/initial_guess.hpp"
#include "bathyal/identify/model/effect_parameters.hpp"

namespace bathyal {

using namespace identify;

namespace {

bool is_angle(const ParameterSlot& place) { return is_row(place) && !is_length(place); }

bool is_tool(const ParameterSlot& place) {
  return place.kind == ParameterKind::kToolShift || place.kind == ParameterKind::kToolTurn;
}

int parameter_named(const ArmParameters& parameters, const std::string& name,
                    std::string_view argument) {
  const int column = find_parameter(parameters.parameters, name);
  if (column < 0) throw_argument(argument, "names of parameters, as \"d_1\"", name);
  return column;
}

bool contains(const std::vector<int>& columns, int column) {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

double root_mean_square(const Eigen::Matrix3Xd& errors) {
  return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size()));
}

}  // namespace

CalibrationProblem::CalibrationProblem(const Arm& known_arm, const Measurement& data,
                                       const IdentifyOptions& given_options,
                                       const std::vector<FixedEffect>& effects)
    : arm(known_arm),
      measurement(data),
      options(given_options),
      base_free(given_options.base == BaseChoice::kFree ||
                (given_options.base == BaseChoice::kAuto && data.tracked)),
      parameters{known_arm, {}, {}, {}, {}, {}},
      scale_observed(data.observes_scale()) {
  if (base_free && !measurement.in_world()) {
    throw_argument("base", "\"fixed\" or \"auto\" for touches of points with unknown positions",
                   "\"free\"");
  }
  find_columns();
  fix_effects(effects);
  redundant = find_redundant(parameters, measurement, choice(),
                             measurement.in_world() && !base_free, fixed);
  set_priors();
  system.emplace(parameters, measurement, options.criterion, options.pair_weights,
                 options.num_threads);
  fit_frames();
  free_remaining();
  set_initial_noise();
}

ParameterChoice CalibrationProblem::choice() const {
  return {options.parametrization, options.nearly_parallel, base_free};
}

void CalibrationProblem::find_columns() {
  const bool tool_given =
      options.tool_start == ToolStart::kArm ||
      (options.tool_start == ToolStart::kAuto && arm.tool().translation() != Vec3::Zero());
  InitialGuess found = find_initial_guess(arm, measurement, tool_given, base_free);
  parameters = make_parameters(arm, measurement, std::move(found.bases), std::move(found.tools),
                               std::move(found.planes), choice());
  start = parameters.nominal();
  for (const std::string& name : options.fixed) {
    fixed.push_back(parameter_named(parameters, name, "fixed"));
  }
}

void CalibrationProblem::fix_effects(const std::vector<FixedEffect>& effects) {
  for (const FixedEffect& effect : effects) {
    const int first = add_effect(parameters, effect.variant, effect.perturbations);
    for (Index p = 0; p < effect.values.size(); ++p) {
      parameters.parameters[first + p].nominal = effect.values[p];
      fixed.push_back(first + static_cast<int>(p));
    }
  }
  start = parameters.nominal();
}

void CalibrationProblem::set_length_prior(double std) {
  for (std::size_t i = 0; i < parameters.parameters.size(); ++i) {
    Parameter& column = parameters.parameters[i];
    if (is_length(parameters.slots[i]) && !options.priors.contains(column.name)) {
      column.prior_std = std;
    }
  }
}

void CalibrationProblem::set_priors() {
  length_prior = options.length_prior;
  if (!length_prior && !scale_observed) length_prior = options.size_prior;
  if (length_prior) set_length_prior(*length_prior);
  for (std::size_t i = 0; options.angle_prior && i < parameters.parameters.size(); ++i) {
    if (is_angle(parameters.slots[i])) parameters.parameters[i].prior_std = *options.angle_prior;
  }
  for (const auto& [name, std] : options.priors) {
    parameters.parameters[parameter_named(parameters, name, "priors")].prior_std = std;
  }
}

bool CalibrationProblem::drop_scale_prior(const Eigen::MatrixXd& null_space) {
  // A length fixed by the caller removes the change of scale from the null space.
  const bool length_fixed = std::any_of(fixed.begin(), fixed.end(),
                                        [&](int c) { return is_length(parameters.slots[c]); });
  const bool has_prismatic =
      std::any_of(arm.joints().begin(), arm.joints().end(),
                  [](const Joint& joint) { return joint.type == JointType::kPrismatic; });
  if (scale_observed || length_fixed || !has_prismatic) return false;
  Eigen::VectorXd size = scale_derivative(parameters);
  for (Index i = 0; i < size.size(); ++i) size[i] *= parameters.parameters[i].scale;
  if ((null_space.transpose() * size).norm() > kNullSpaceShare * size.norm()) return false;
  scale_observed = true;
  if (options.length_prior) return false;
  length_prior.reset();
  set_length_prior(Parameter::kNoPrior);
  return true;
}

/// Bases, tools of tracked poses and planes for the nominal rows: the result without
/// identification, and the frames that rotations then refer to.
void CalibrationProblem::fit_frames() {
  std::vector<int> frames;
  for (int i = 0; i < static_cast<int>(parameters.slots.size()); ++i) {
    const bool wanted =
        !is_row(parameters.slots[i]) && (measurement.tracked || !is_tool(parameters.slots[i]));
    if (wanted && !contains(fixed, i)) frames.push_back(i);
  }
  if (frames.empty()) return;
  system->set_free(frames);
  system->set_use_priors(false);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(system->columns());
  ArmState state = state_at(parameters, system->values(solve_least_squares(*system, nothing).y));
  const ArmParameters fitted =
      make_parameters(arm, measurement, std::move(state.bases), std::move(state.tools),
                      std::move(state.planes), choice());
  for (std::size_t i = 0; i < fitted.parameters.size(); ++i) {
    parameters.parameters[i].nominal = fitted.parameters[i].nominal;
  }
  parameters.bases = fitted.bases;
  parameters.tools = fitted.tools;
  parameters.planes = fitted.planes;
  start = parameters.nominal();
}

void CalibrationProblem::free_remaining() {
  std::vector<int> free;
  for (int i = 0; i < static_cast<int>(parameters.parameters.size()); ++i) {
    const bool is_redundant =
        std::any_of(redundant.begin(), redundant.end(),
                    [i](const RedundantParameter& g) { return g.column == i; });
    if (!is_redundant && !contains(fixed, i)) free.push_back(i);
  }
  system->set_free(std::move(free));
  system->set_use_priors(true);
}

/// Initially all residuals of the nominal arm are taken as noise: priors then count, but not too
/// much.
void CalibrationProblem::set_initial_noise() {
  Noise noise;
  noise.position =
      options.noise.value_or(std::max(root_mean_square(system->deviations(start)), kLeastNoise));
  if (measurement.has_rotation()) {
    noise.rotation = options.rotation_noise.value_or(
        std::max(root_mean_square(system->rotation_deviations(start)), kLeastNoise));
  }
  system->set_noise(noise, start);
}

Eigen::VectorXd scale_derivative(const ArmParameters& parameters) {
  Eigen::VectorXd derivative = parameters.nominal();
  for (Index i = 0; i < derivative.size(); ++i) {
    if (!is_length(parameters.slots[i])) derivative[i] = 0.0;
  }
  const double square = derivative.squaredNorm();
  return square > 0.0 ? Eigen::VectorXd(derivative / square) : derivative;
}

}  // namespace bathyal
