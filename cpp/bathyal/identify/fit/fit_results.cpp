// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/fit_results.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

/// Posterior std over prior std from which the prior determines the parameter.
constexpr double kHeldByPrior = 0.7;

double root_mean(double sum, double count) { return count > 0.0 ? std::sqrt(sum / count) : 0.0; }

/// Deviations of the tips, in all forms that are reported.
struct ErrorSummary {
  Eigen::Matrix3Xd residuals;
  double rms = 0.0;
  std::vector<double> point_rms;
  double rotation_rms = 0.0;
  double pairs = 0.0;
};

/// Of each point; of each station when tracked.
std::vector<double> group_rms(const Measurement& m, const Eigen::Matrix3Xd& residuals) {
  const std::vector<int>& group = m.tracked ? m.station : m.point;
  const auto groups = static_cast<std::size_t>(m.tracked ? m.stations : m.points());
  std::vector<double> sum(groups, 0.0);
  std::vector<double> count(groups, 0.0);
  for (Index i = 0; i < m.rows(); ++i) {
    if (group[i] < 0) continue;
    sum[group[i]] += residuals.col(i).squaredNorm();
    count[group[i]] += 1.0;
  }
  for (std::size_t g = 0; g < groups; ++g) sum[g] = root_mean(sum[g], count[g]);
  return sum;
}

ErrorSummary errors_at(const ArmResiduals& system, const Eigen::VectorXd& x) {
  const Measurement& m = system.measurement();
  const auto rows = static_cast<double>(m.rows());
  ErrorSummary out;
  out.residuals = system.deviations(x);
  out.rms = root_mean(out.residuals.squaredNorm(), rows);
  out.point_rms = group_rms(m, out.residuals);
  out.rotation_rms = root_mean(system.rotation_deviations(x).squaredNorm(), rows);
  out.pairs = pair_sum(m, out.residuals);
  return out;
}

void fill_arm(const CalibrationProblem& problem, const Eigen::VectorXd& x, ArmFit& fit) {
  const ArmState state = state_at(problem.parameters, x);
  fit.arm = state.arm;
  fit.arm.set_base(state.bases[0]);
  fit.arm.set_tool(state.tools[0]);
  fit.bases = state.bases;
  fit.tools = state.tools;
  fit.arm_parameters = problem.parameters;
  fit.values = x;
}

void fill_errors(const CalibrationProblem& problem, const Eigen::VectorXd& x, ArmFit& fit) {
  ArmResiduals plain = *problem.system;  // the nominal arm is evaluated without robust weights
  plain.set_observation_weights(std::vector<double>(problem.measurement.weights.size(), 1.0));
  ErrorSummary before = errors_at(plain, problem.start);
  fit.rms_before = before.rms;
  fit.point_rms_before = std::move(before.point_rms);
  fit.rotation_rms_before = before.rotation_rms;
  fit.pairs_before = before.pairs;
  fit.residuals_before = std::move(before.residuals);
  ErrorSummary after = errors_at(*problem.system, x);
  fit.rms_after = after.rms;
  fit.point_rms_after = std::move(after.point_rms);
  fit.rotation_rms_after = after.rotation_rms;
  fit.pairs_after = after.pairs;
  fit.residuals = std::move(after.residuals);
}

void fill_search(const CalibrationResult& found, ArmFit& fit) {
  fit.history = found.history;
  fit.iterations = static_cast<int>(found.history.size()) - 1;
  fit.converged = found.converged;
}

void fill_rank(const CalibrationProblem& problem, const Observability& observability, ArmFit& fit) {
  fit.rank = observability.rank.rank;
  fit.singular_values = observability.rank.singular_values;
  for (const Eigen::VectorXd& direction : readable_directions(observability.rank.null_space())) {
    fit.null_space.push_back(describe_direction(direction, problem.parameters.parameters));
  }
  const ArmResiduals& system = *problem.system;
  const Measurement& m = problem.measurement;
  fit.noise = system.noise().position;
  fit.rotation_noise = m.has_rotation() ? system.noise().rotation : 0.0;
  const auto determined = static_cast<double>(system.columns() - observability.null_space.cols());
  fit.degrees_of_freedom =
      free_position_rows(m) + static_cast<double>(system.known_rows()) - determined;
}

void fill_points(const CalibrationProblem& problem, const Eigen::VectorXd& x, ArmFit& fit) {
  const std::vector<int>& labels = problem.measurement.labels;
  fit.point_labels = labels;
  fit.points = problem.system->centroids(x);
  for (const KnownDistance& known : problem.measurement.distances) {
    fit.distances.push_back({labels[known.first], labels[known.second], known.distance,
                             (fit.points.col(known.first) - fit.points.col(known.second)).norm()});
  }
}

void fill_covariance(const CalibrationProblem& problem, const Observability& observability,
                     const Eigen::VectorXd& x, ArmFit& fit) {
  const std::vector<Parameter>& columns = problem.parameters.parameters;
  const auto count = static_cast<Index>(columns.size());
  const std::vector<int>& free = problem.system->free();
  const Eigen::MatrixXd known = free_covariance(*problem.system, x, observability.undetermined);
  fit.covariance.setZero(count, count);
  for (Index i = 0; i < known.rows(); ++i) {
    for (Index j = 0; j < known.cols(); ++j) {
      fit.covariance(free[i], free[j]) =
          known(i, j) * columns[free[i]].scale * columns[free[j]].scale;
    }
  }
  Eigen::VectorXd scales(count);
  for (Index i = 0; i < count; ++i) scales[i] = columns[i].scale;
  fit.undetermined = scales.asDiagonal() * observability.undetermined;
}

/// Result for a parameter as if it were free.
FitParameter parameter_of(int c, const CalibrationProblem& problem,
                          const Observability& observability, double value, double std) {
  const std::vector<Parameter>& columns = problem.parameters.parameters;
  const Parameter& column = columns[c];
  FitParameter p{
      column.name,  column.description,  column.unit,
      column.group, column.nominal,      value,
      std,          Status::kIdentified, null_space_partners(c, observability.null_space, columns)};
  const bool has_prior = column.prior_std != Parameter::kNoPrior;
  if (takes_part(c, observability.undetermined)) {
    p.status = Status::kNotIdentifiable;
    p.std = std::numeric_limits<double>::infinity();
  } else if (takes_part(c, observability.null_space) ||
             (has_prior && std > kHeldByPrior * column.prior_std)) {
    p.status = Status::kPrior;
  }
  return p;
}

void fill_parameters(const CalibrationProblem& problem, const Observability& observability,
                     const CalibrationResult& found, ArmFit& fit) {
  for (int c = 0; c < static_cast<int>(problem.parameters.parameters.size()); ++c) {
    const double std = std::sqrt(fit.covariance(c, c));
    fit.parameters.push_back(parameter_of(c, problem, observability, found.x[c], std));
  }
  for (const RedundantParameter& redundant : problem.redundant) {
    fit.parameters[redundant.column].status = Status::kGauge;
    fit.parameters[redundant.column].partners = redundant.partners;
  }
  for (const int column : problem.fixed) fit.parameters[column].status = Status::kFixed;
  for (const int column : found.pruned) fit.parameters[column].status = Status::kPruned;
}

std::string scale_source(const CalibrationProblem& problem) {
  const Measurement& m = problem.measurement;
  if (m.tracked) return "measured positions";
  if (!m.known_points.empty()) return "known points";
  if (!m.distances.empty()) return m.distances.size() == 1 ? "known distance" : "known distances";
  if (problem.scale_observed) return "travel of sliding joints";
  return "prior on lengths (" + to_text(*problem.length_prior * 1e3) + " mm)";
}

void fill_scale(const CalibrationProblem& problem, const Eigen::VectorXd& x, ArmFit& fit) {
  const Eigen::VectorXd derivative = scale_derivative(problem.parameters);
  fit.scale = 1.0 + derivative.dot(x - problem.parameters.nominal());
  fit.scale_std = std::sqrt(std::max(0.0, derivative.dot(fit.covariance * derivative)));
  fit.scale_source = scale_source(problem);
  double sum = 0.0;
  double square = 0.0;
  for (const DistanceComparison& distance : fit.distances) {
    sum += distance.given * distance.estimated;
    square += distance.estimated * distance.estimated;
  }
  double to_true_scale = problem.scale_observed ? 1.0 : 1.0 / fit.scale;
  if (square > 0.0) to_true_scale = sum / square;
  fit.rms_after_scaled = fit.rms_after * to_true_scale;
}

}  // namespace

ArmFit make_arm_fit(const CalibrationProblem& problem, const Observability& observability,
                    const CalibrationResult& found) {
  ArmFit fit(problem.arm);
  fill_arm(problem, found.x, fit);
  fill_errors(problem, found.x, fit);
  fill_search(found, fit);
  fill_rank(problem, observability, fit);
  fill_points(problem, found.x, fit);
  fill_covariance(problem, observability, found.x, fit);
  fill_parameters(problem, observability, found, fit);
  fill_scale(problem, found.x, fit);
  return fit;
}

}  // namespace bathyal
