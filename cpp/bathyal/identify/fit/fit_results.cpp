// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/fit_results.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

/// A prior that the data sharpen by less than this is what holds the column.
constexpr double kHeldByPrior = 0.7;

double root_mean(double sum, double count) { return count > 0.0 ? std::sqrt(sum / count) : 0.0; }

/// How far tips lie from where they should be, in the ways that a report tells it.
struct Misses {
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

Misses misses_at(const ArmSystem& system, const Eigen::VectorXd& x) {
  const Measurement& m = system.measurement();
  const auto rows = static_cast<double>(m.rows());
  Misses out;
  out.residuals = system.deviations(x);
  out.rms = root_mean(out.residuals.squaredNorm(), rows);
  out.point_rms = group_rms(m, out.residuals);
  out.rotation_rms = root_mean(system.turns(x).squaredNorm(), rows);
  out.pairs = pair_sum(m, out.residuals);
  return out;
}

void report_arm(const ArmProblem& problem, const Eigen::VectorXd& x, ArmFit& fit) {
  const ArmState state = state_at(problem.columns, x);
  fit.arm = state.arm;
  fit.arm.set_base(state.bases[0]);
  fit.arm.set_tool(state.tools[0]);
  fit.bases = state.bases;
  fit.tools = state.tools;
  fit.columns = problem.columns;
  fit.values = x;
}

void report_misses(const ArmProblem& problem, const Eigen::VectorXd& x, ArmFit& fit) {
  ArmSystem plain = *problem.system;  // what the nominal arm does is no matter of a robust loss
  plain.set_trust(std::vector<double>(problem.measurement.weights.size(), 1.0));
  Misses before = misses_at(plain, problem.start);
  fit.rms_before = before.rms;
  fit.point_rms_before = std::move(before.point_rms);
  fit.rotation_rms_before = before.rotation_rms;
  fit.pairs_before = before.pairs;
  fit.residuals_before = std::move(before.residuals);
  Misses after = misses_at(*problem.system, x);
  fit.rms_after = after.rms;
  fit.point_rms_after = std::move(after.point_rms);
  fit.rotation_rms_after = after.rotation_rms;
  fit.pairs_after = after.pairs;
  fit.residuals = std::move(after.residuals);
}

void report_search(const SearchResult& found, ArmFit& fit) {
  fit.history = found.history;
  fit.iterations = static_cast<int>(found.history.size()) - 1;
  fit.converged = found.converged;
}

void report_rank(const ArmProblem& problem, const Observability& seen, ArmFit& fit) {
  fit.rank = seen.rank.rank;
  fit.singular_values = seen.rank.singular_values;
  for (const Eigen::VectorXd& direction : readable_directions(seen.rank.unseen())) {
    fit.unseen.push_back(in_words(direction, problem.columns.columns));
  }
  const ArmSystem& system = *problem.system;
  const Measurement& m = problem.measurement;
  fit.noise = system.noise().position;
  fit.rotation_noise = m.has_rotation() ? system.noise().rotation : 0.0;
  const auto taken = static_cast<double>(system.columns() - seen.unseen.cols());
  fit.degrees_of_freedom = free_position_rows(m) + static_cast<double>(system.known_rows()) - taken;
}

void report_points(const ArmProblem& problem, const Eigen::VectorXd& x, ArmFit& fit) {
  const std::vector<int>& labels = problem.measurement.labels;
  fit.point_labels = labels;
  fit.points = problem.system->centroids(x);
  for (const KnownDistance& known : problem.measurement.distances) {
    fit.distances.push_back({labels[known.first], labels[known.second], known.distance,
                             (fit.points.col(known.first) - fit.points.col(known.second)).norm()});
  }
}

void report_covariance(const ArmProblem& problem, const Observability& seen,
                       const Eigen::VectorXd& x, ArmFit& fit) {
  const std::vector<Column>& columns = problem.columns.columns;
  const auto count = static_cast<Index>(columns.size());
  const std::vector<int>& free = problem.system->free();
  const Eigen::MatrixXd known = free_covariance(*problem.system, x, seen.blind);
  fit.covariance.setZero(count, count);
  for (Index i = 0; i < known.rows(); ++i) {
    for (Index j = 0; j < known.cols(); ++j) {
      fit.covariance(free[i], free[j]) =
          known(i, j) * columns[free[i]].scale * columns[free[j]].scale;
    }
  }
  Eigen::VectorXd scales(count);
  for (Index i = 0; i < count; ++i) scales[i] = columns[i].scale;
  fit.blind = scales.asDiagonal() * seen.blind;
}

/// Of a column as if it were free.
FitParameter parameter_of(int c, const ArmProblem& problem, const Observability& seen, double value,
                          double std) {
  const std::vector<Column>& columns = problem.columns.columns;
  const Column& column = columns[c];
  FitParameter p{column.name,  column.words,        column.unit,
                 column.group, column.nominal,      value,
                 std,          Status::kIdentified, trades_of(c, seen.unseen, columns)};
  const bool has_prior = column.prior_std != Column::kNoPrior;
  if (takes_part(c, seen.blind)) {
    p.status = Status::kNotIdentifiable;
    p.std = std::numeric_limits<double>::infinity();
  } else if (takes_part(c, seen.unseen) || (has_prior && std > kHeldByPrior * column.prior_std)) {
    p.status = Status::kPrior;
  }
  return p;
}

void report_parameters(const ArmProblem& problem, const Observability& seen,
                       const SearchResult& found, ArmFit& fit) {
  for (int c = 0; c < static_cast<int>(problem.columns.columns.size()); ++c) {
    const double std = std::sqrt(fit.covariance(c, c));
    fit.parameters.push_back(parameter_of(c, problem, seen, found.x[c], std));
  }
  for (const GaugeColumn& gauge : problem.gauge) {
    fit.parameters[gauge.column].status = Status::kGauge;
    fit.parameters[gauge.column].trades = gauge.trades;
  }
  for (const int column : problem.fixed) fit.parameters[column].status = Status::kFixed;
  for (const int column : found.pruned) fit.parameters[column].status = Status::kPruned;
}

std::string scale_source(const ArmProblem& problem) {
  const Measurement& m = problem.measurement;
  if (m.tracked) return "measured positions";
  if (!m.known_points.empty()) return "known points";
  if (!m.distances.empty()) return m.distances.size() == 1 ? "known distance" : "known distances";
  if (problem.size_told) return "travel of sliding joints";
  return "prior on lengths (" + to_text(*problem.length_prior * 1e3) + " mm)";
}

void report_scale(const ArmProblem& problem, const Eigen::VectorXd& x, ArmFit& fit) {
  const Eigen::VectorXd derivative = size_derivative(problem.columns);
  fit.scale = 1.0 + derivative.dot(x - problem.columns.nominal());
  fit.scale_std = std::sqrt(std::max(0.0, derivative.dot(fit.covariance * derivative)));
  fit.scale_source = scale_source(problem);
  double sum = 0.0;
  double square = 0.0;
  for (const FoundDistance& distance : fit.distances) {
    sum += distance.told * distance.found;
    square += distance.found * distance.found;
  }
  double to_true_size = problem.size_told ? 1.0 : 1.0 / fit.scale;
  if (square > 0.0) to_true_size = sum / square;
  fit.rms_after_scaled = fit.rms_after * to_true_size;
}

}  // namespace

ArmFit report(const ArmProblem& problem, const Observability& seen, const SearchResult& found) {
  ArmFit fit(problem.arm);
  report_arm(problem, found.x, fit);
  report_misses(problem, found.x, fit);
  report_search(found, fit);
  report_rank(problem, seen, fit);
  report_points(problem, found.x, fit);
  report_covariance(problem, seen, found.x, fit);
  report_parameters(problem, seen, found, fit);
  report_scale(problem, found.x, fit);
  return fit;
}

}  // namespace bathyal
