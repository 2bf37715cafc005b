// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/calibration_problem.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bathyal/base/check.hpp"
#include "bathyal/identify/fit/internal/initial_guess.hpp"
#include "bathyal/identify/model/effect_parameters.hpp"

namespace bathyal {
namespace {

bool is_angle(const Place& place) { return is_row(place) && !is_length(place); }

bool is_tool(const Place& place) {
  return place.part == Part::kToolShift || place.part == Part::kToolTurn;
}

int column_named(const ArmColumns& columns, const std::string& name, std::string_view argument) {
  const int column = find_column(columns.columns, name);
  if (column < 0) throw_argument(argument, "names of parameters, as \"d_1\"", name);
  return column;
}

bool holds(const std::vector<int>& columns, int column) {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

double root_mean_square(const Eigen::Matrix3Xd& errors) {
  return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size()));
}

}  // namespace

ArmProblem::ArmProblem(const Arm& known_arm, const Measurement& data, const IdentifyOptions& asked,
                       const std::vector<HeldEffect>& effects)
    : arm(known_arm),
      measurement(data),
      options(asked),
      base_free(asked.base == BaseChoice::kFree ||
                (asked.base == BaseChoice::kAuto && data.tracked)),
      columns{known_arm, {}, {}, {}, {}, {}},
      size_told(data.tells_scale()) {
  if (base_free && !measurement.in_world()) {
    throw_argument("base", "\"fixed\" or \"auto\" for touches of points that nobody told",
                   "\"free\"");
  }
  find_columns();
  hold(effects);
  gauge = find_gauge(columns, measurement, choice(), measurement.in_world() && !base_free, fixed);
  set_priors();
  system.emplace(columns, measurement, options.criterion, options.pair_weights,
                 options.num_threads);
  settle_frames();
  free_the_rest();
  set_first_noise();
}

ColumnChoice ArmProblem::choice() const {
  return {options.parametrization, options.nearly_parallel, base_free};
}

void ArmProblem::find_columns() {
  const bool tool_given =
      options.tool_start == ToolStart::kArm ||
      (options.tool_start == ToolStart::kAuto && arm.tool().translation() != Vec3::Zero());
  Start found = find_start(arm, measurement, tool_given, base_free);
  columns = make_columns(arm, measurement, std::move(found.bases), std::move(found.tools),
                         std::move(found.planes), choice());
  start = columns.nominal();
  for (const std::string& name : options.fixed) {
    fixed.push_back(column_named(columns, name, "fixed"));
  }
}

void ArmProblem::hold(const std::vector<HeldEffect>& effects) {
  for (const HeldEffect& held : effects) {
    const int first = add_effect(columns, held.variant, held.actions);
    for (Index p = 0; p < held.values.size(); ++p) {
      columns.columns[first + p].nominal = held.values[p];
      fixed.push_back(first + static_cast<int>(p));
    }
  }
  start = columns.nominal();
}

void ArmProblem::set_length_prior(double std) {
  for (std::size_t i = 0; i < columns.columns.size(); ++i) {
    Column& column = columns.columns[i];
    if (is_length(columns.places[i]) && !options.priors.contains(column.name)) {
      column.prior_std = std;
    }
  }
}

void ArmProblem::set_priors() {
  length_prior = options.length_prior;
  if (!length_prior && !size_told) length_prior = options.size_prior;
  if (length_prior) set_length_prior(*length_prior);
  for (std::size_t i = 0; options.angle_prior && i < columns.columns.size(); ++i) {
    if (is_angle(columns.places[i])) columns.columns[i].prior_std = *options.angle_prior;
  }
  for (const auto& [name, std] : options.priors) {
    columns.columns[column_named(columns, name, "priors")].prior_std = std;
  }
}

bool ArmProblem::drop_size_prior(const Eigen::MatrixXd& unseen) {
  // A length that the caller holds hides the change of size from what is unseen.
  const bool length_held =
      std::any_of(fixed.begin(), fixed.end(), [&](int c) { return is_length(columns.places[c]); });
  const bool slides = std::any_of(arm.joints().begin(), arm.joints().end(), [](const Joint& joint) {
    return joint.type == JointType::kPrismatic;
  });
  if (size_told || length_held || !slides) return false;
  Eigen::VectorXd size = size_derivative(columns);
  for (Index i = 0; i < size.size(); ++i) size[i] *= columns.columns[i].scale;
  if ((unseen.transpose() * size).norm() > kUnseenShare * size.norm()) return false;
  size_told = true;
  if (options.length_prior) return false;
  length_prior.reset();
  set_length_prior(Column::kNoPrior);
  return true;
}

/// Bases, tools of tracked poses and planes for the nominal rows: what a user who identifies
/// nothing would find, and the frames about which turns are then told.
void ArmProblem::settle_frames() {
  std::vector<int> frames;
  for (int i = 0; i < static_cast<int>(columns.places.size()); ++i) {
    const bool wanted =
        !is_row(columns.places[i]) && (measurement.tracked || !is_tool(columns.places[i]));
    if (wanted && !holds(fixed, i)) frames.push_back(i);
  }
  if (frames.empty()) return;
  system->set_free(frames);
  system->set_use_priors(false);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(system->columns());
  ArmState state = state_at(columns, system->values(solve_least_squares(*system, nothing).y));
  const ArmColumns settled =
      make_columns(arm, measurement, std::move(state.bases), std::move(state.tools),
                   std::move(state.planes), choice());
  for (std::size_t i = 0; i < settled.columns.size(); ++i) {
    columns.columns[i].nominal = settled.columns[i].nominal;
  }
  columns.bases = settled.bases;
  columns.tools = settled.tools;
  columns.planes = settled.planes;
  start = columns.nominal();
}

void ArmProblem::free_the_rest() {
  std::vector<int> free;
  for (int i = 0; i < static_cast<int>(columns.columns.size()); ++i) {
    const bool superfluous = std::any_of(gauge.begin(), gauge.end(),
                                         [i](const GaugeColumn& g) { return g.column == i; });
    if (!superfluous && !holds(fixed, i)) free.push_back(i);
  }
  system->set_free(std::move(free));
  system->set_use_priors(true);
}

/// As if all that the nominal arm misses were noise: priors then count, but not for too much.
void ArmProblem::set_first_noise() {
  Noise noise;
  noise.position =
      options.noise.value_or(std::max(root_mean_square(system->deviations(start)), kLeastNoise));
  if (measurement.has_rotation()) {
    noise.rotation = options.rotation_noise.value_or(
        std::max(root_mean_square(system->turns(start)), kLeastNoise));
  }
  system->set_noise(noise, start);
}

Eigen::VectorXd size_derivative(const ArmColumns& columns) {
  Eigen::VectorXd derivative = columns.nominal();
  for (Index i = 0; i < derivative.size(); ++i) {
    if (!is_length(columns.places[i])) derivative[i] = 0.0;
  }
  const double square = derivative.squaredNorm();
  return square > 0.0 ? Eigen::VectorXd(derivative / square) : derivative;
}

}  // namespace bathyal
