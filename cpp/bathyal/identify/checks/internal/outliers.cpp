// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/internal/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bathyal/estimation/rank.hpp"
#include "bathyal/identify/model/arm_linearization.hpp"
#include "bathyal/selection/outlier_test.hpp"

namespace bathyal::identify {
namespace {

constexpr int kMaxSearchRounds = 10;

/// Each row against its prediction from the others.
struct DeletionResiduals {
  std::vector<selection::ObservationTest> tests;
  double variance = 1.0;  ///< of the rows kept, in units of the system's noise
  double dof = 0.0;       ///< of the rows kept
};

DeletionResiduals deletion_residuals(const ArmResiduals& system, const Eigen::VectorXd& x) {
  Eigen::VectorXd residuals(system.rows());
  Eigen::MatrixXd jacobian(system.rows(), system.columns());
  system.evaluate(system.scaled(x).data(), residuals.data(), jacobian.data());
  selection::Linearization at = to_linearization(system, std::move(residuals), jacobian);
  Eigen::MatrixXd basis = column_space(at.jacobian, kRankTolerance);
  // Positions alone, with the leverage that all rows give them.
  const Index positions = system.position_rows(), rotations = system.rotation_rows();
  const Index others = system.rows() - positions - rotations;
  const auto drop_rotations = [&](auto& rows) {
    rows.middleRows(positions, others) = rows.bottomRows(others).eval();
    rows.conservativeResize(positions + others, Eigen::NoChange);
  };
  if (rotations > 0) {
    drop_rotations(at.residual);
    drop_rotations(at.jacobian);
    drop_rotations(basis);
    at.observation.erase(at.observation.begin() + positions,
                         at.observation.begin() + positions + rotations);
  }
  Eigen::VectorXd weights(system.measurement().rows());
  for (Index i = 0; i < weights.size(); ++i) weights[i] = system.is_excluded(i) ? 0.0 : 1.0;
  DeletionResiduals out;
  out.dof = system.free_rows()[0] +
            static_cast<double>(3 * system.measurement().points() + others) - basis.squaredNorm();
  out.tests = selection::test_observations(at, basis, weights, out.dof);
  const double squares =
      at.residual.squaredNorm() - (basis.transpose() * at.residual).squaredNorm();
  const double unit = kLeastNoise / system.noise().position;
  out.variance = std::max(out.dof > 0.0 ? squares / out.dof : 0.0, unit * unit);
  return out;
}

/// From the position predicted by the others [m].
double distance(const DeletionResiduals& residuals, const ArmResiduals& system, Index i) {
  return residuals.tests[i].error * system.noise().position /
         std::sqrt(system.measurement().weights[i]);
}

/// Whether the residual of row i is beyond chance.
bool is_outlier(const DeletionResiduals& residuals, const ArmResiduals& system, Index i) {
  const selection::ObservationTest& test = residuals.tests[i];
  return distance(residuals, system, i) >= Limits::kMinDistance &&
         test.distance * test.rows >= Limits::kMinSigma * Limits::kMinSigma &&
         test.p < Limits::kFalseAlarm / static_cast<double>(residuals.tests.size());
}

/// Residuals without outliers are normal: none is an outlier, and the median agrees with the mean.
bool looks_normal(const DeletionResiduals& residuals, const ArmResiduals& system) {
  std::vector<double> scaled;
  double sum = 0.0;
  for (Index i = 0; i < system.measurement().rows(); ++i) {
    if (is_outlier(residuals, system, i)) return false;
    if (system.axes(i) != 3) continue;
    scaled.push_back(residuals.tests[i].square);
    sum += scaled.back();
  }
  if (scaled.empty()) return true;
  const auto middle = scaled.begin() + static_cast<std::ptrdiff_t>(scaled.size() / 2);
  std::nth_element(scaled.begin(), middle, scaled.end());
  const double mean = sum / (3.0 * static_cast<double>(scaled.size()));
  return mean < Limits::kMaxMeanRatio * *middle / (kMedianOfNorm * kMedianOfNorm);
}

Eigen::VectorXd weighted_norms(const ArmResiduals& system, const Eigen::VectorXd& x) {
  Eigen::VectorXd norms = system.deviations(x).colwise().norm();
  for (Index i = 0; i < norms.size(); ++i) norms[i] *= std::sqrt(system.measurement().weights[i]);
  return norms;
}

void solve(const ArmResiduals& system, int steps, Eigen::VectorXd& x) {
  const LeastSquaresOptions options{.max_iterations = steps};
  x = system.values(solve_least_squares(system, system.scaled(x), options).y);
}

/// Of touches only: measured positions determine the arm.
bool has_strayed(const ArmResiduals& system, const Eigen::VectorXd& x) {
  if (system.measurement().tracked) return false;
  const ArmParameters& parameters = system.arm_parameters();
  for (const int c : system.free()) {
    const ParameterSlot& slot = parameters.slots[c];
    if (!is_row(slot)) continue;
    const double change = std::abs(x[c] - parameters.parameters[c].nominal);
    if (change > (is_length(slot) ? Limits::kFarLength : Limits::kFarAngle)) return true;
  }
  return false;
}

/// The same problem with loose priors on the rows of the arm and very loose ones on the frames.
ArmResiduals near_nominal(const ArmResiduals& fitted, const Measurement& without_known) {
  constexpr double kFrame = 10.0;   // [m] or [rad]
  constexpr double kLength = 2e-3;  // [m] the scale is otherwise undetermined
  const ArmParameters& parameters = fitted.arm_parameters();
  ArmResiduals system(parameters, without_known, Criterion::kCentroid, false, 1);
  system.set_free(fitted.free());
  std::vector<LinearConstraint> rows;
  for (const int c : fitted.free()) {
    const ParameterSlot& slot = parameters.slots[c];
    const double std = !is_row(slot) ? kFrame : is_length(slot) ? kLength : Limits::kFarAngle;
    rows.push_back({Eigen::VectorXd::Unit(parameters.nominal().size(), c), std});
  }
  system.set_linear_constraints(std::move(rows));
  system.set_noise(fitted.noise(), parameters.nominal());
  return system;
}

double huber(double ratio) {
  constexpr double kWidth = 1.345;
  return std::min(1.0, kWidth / std::max(ratio, kWidth));
}

double tukey(double ratio) {
  constexpr double kWidth = 4.685;
  const double bell = 1.0 - ratio * ratio / (kWidth * kWidth);
  return std::max(bell > 0.0 ? bell * bell : 0.0, selection::kExcludedWeight);
}

/// Iteratively reweighted least squares, with weights by the distance in units of the noise.
void reweigh(ArmResiduals& system, double (*weight_of)(double), int most_rounds,
             Eigen::VectorXd& x) {
  constexpr double kSettled = 0.02;
  std::vector<double> observation_weights = system.observation_weights();
  for (int round = 0; round < most_rounds; ++round) {
    const Eigen::VectorXd norms = weighted_norms(system, x);
    const double noise =
        std::max(median_noise(system, norms), Limits::kMinDistance / Limits::kMinSigma);
    double change = 0.0;
    for (Index i = 0; i < norms.size(); ++i) {
      const double next = weight_of(norms[i] / noise);
      change = std::max(change, std::abs(next - observation_weights[i]));
      observation_weights[i] = next;
    }
    if (change < kSettled) return;
    system.set_observation_weights(observation_weights);
    system.set_noise({noise, system.noise().rotation}, x);
    solve(system, 2, x);
  }
}

/// Least squares of the rows that pass the test, until they stay the same.
DeletionResiduals trimmed_fit(ArmResiduals& system, Eigen::VectorXd& x) {
  const Eigen::VectorXd norms = weighted_norms(system, x);
  const double noise =
      std::max(median_noise(system, norms), Limits::kMinDistance / Limits::kMinSigma);
  std::vector<double> observation_weights(system.observation_weights().size(), 1.0);
  for (Index i = 0; i < norms.size(); ++i) {
    if (norms[i] > Limits::kMinSigma * noise) observation_weights[i] = selection::kExcludedWeight;
  }
  DeletionResiduals found;
  for (int round = 0; round < kMaxSearchRounds; ++round) {
    system.set_observation_weights(observation_weights);
    solve(system, 5, x);
    found = deletion_residuals(system, x);
    const double now = system.noise().position * std::sqrt(found.variance);
    system.set_noise({now, system.noise().rotation}, x);
    found = deletion_residuals(system, x);
    std::vector<double> next(observation_weights.size(), 1.0);
    for (Index i = 0; i < norms.size(); ++i) {
      if (is_outlier(found, system, i)) next[i] = selection::kExcludedWeight;
    }
    if (next == observation_weights) break;
    observation_weights = std::move(next);
  }
  return found;
}

/// The other point that row i agrees with, if any.
std::optional<int> point_that_fits(const ArmResiduals& system, const DeletionResiduals& residuals,
                                   Index i, const Vec3& tip, const Eigen::Matrix3Xd& centers) {
  const Measurement& m = system.measurement();
  const selection::ObservationTest& test = residuals.tests[i];
  const double from = distance(residuals, system, i);
  const double std = from / std::sqrt(test.distance * test.rows);
  for (int p = 0; p < m.points(); ++p) {
    const double away = (tip - centers.col(p)).norm();
    if (p != m.point[i] && away < Limits::kMinSigma * std && away < Limits::kDistanceRatio * from) {
      return m.labels[p];
    }
  }
  return std::nullopt;
}

}  // namespace

OutlierSearch find_outliers(const ArmResiduals& fitted, const Eigen::VectorXd& x) {
  const Measurement& m = fitted.measurement();
  OutlierSearch out{
      {}, false, false, x, std::vector<double>(static_cast<std::size_t>(m.rows()), 1.0), {}};
  if (fitted.columns() == 0) return out;  // nothing was estimated
  {
    ArmResiduals system = fitted;
    system.set_criterion(Criterion::kCentroid, false);
    system.set_observation_weights(out.observation_weights);
    const DeletionResiduals found = deletion_residuals(system, x);
    if (!has_strayed(system, x) && (found.dof < 1.0 || looks_normal(found, system))) return out;
  }

  out.refitted = true;
  Measurement without_known = m;
  without_known.distances.clear();
  without_known.known_points.clear();
  ArmResiduals system = near_nominal(fitted, without_known);
  Eigen::VectorXd found_x = fitted.arm_parameters().nominal();
  reweigh(system, huber, 15, found_x);
  reweigh(system, tukey, 10, found_x);
  const DeletionResiduals found = trimmed_fit(system, found_x);
  out.points = system.centroids(found_x);
  const Eigen::Matrix3Xd deviations = system.deviations(found_x);
  Index unexplained = 0;
  for (Index i = 0; i < m.rows(); ++i) {
    if (!system.is_excluded(i)) continue;
    Outlier outlier{static_cast<int>(i), m.point[i] < 0 ? -1 : m.labels[m.point[i]],
                    distance(found, system, i), std::nullopt};
    if (m.point[i] >= 0) {
      const Vec3 tip = out.points.col(m.point[i]) + deviations.col(i);
      outlier.fits = point_that_fits(system, found, i, tip, out.points);
    }
    if (!outlier.fits) ++unexplained;
    out.outliers.push_back(outlier);
  }
  const double rms = std::sqrt(3.0 * found.variance) * system.noise().position;
  if (3 * unexplained > m.rows() ||
      rms > Limits::kWrongArmShare * chain_length(system.arm_parameters().arm)) {
    out.no_consensus = true;
    out.outliers.clear();
    return out;
  }
  out.x = found_x;
  out.observation_weights = system.observation_weights();
  return out;
}

}  // namespace bathyal::identify
