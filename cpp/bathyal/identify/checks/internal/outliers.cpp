// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/internal/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bathyal/estimation/f_distribution.hpp"

namespace bathyal {
namespace {

constexpr double kFalseAlarm = 0.01;  ///< of a whole fit without outliers
constexpr double kLeastSigma = 6.0;   ///< below it a long tail of honest noise may lie
/// Weight of a row that is left out. Not 0: its residual is read off the same evaluation, and a
/// point all of whose touches are doubted keeps a centre.
constexpr double kWhisper = 1e-20;
constexpr double kLeastDistance = 5e-5;  ///< [m] no touch is told apart from its point by less
constexpr int kMaxSearchRounds = 10;

/// Each row against the others.
struct Study {
  Eigen::VectorXd square;    ///< (N,) residual by its covariance among the others
  Eigen::VectorXd distance;  ///< (N,) from where the others want it [m]
  Eigen::VectorXd reach;     ///< (N,) std of that place, in units of the noise
  double variance = 1.0;     ///< of the rows kept, in units of the system's noise
  double freedom = 0.0;      ///< of the rows kept
};

bool is_kept(double trust) { return trust > kWhisper; }

int dimensions(const Measurement& m, Index row) { return !m.tracked && m.plane[row] >= 0 ? 1 : 3; }

/// What the touches' centre takes of a row: its share in the weight of its point.
std::vector<double> shares(const ArmSystem& system) {
  const Measurement& m = system.measurement();
  std::vector<double> total(static_cast<std::size_t>(m.points()), 0.0);
  std::vector<double> share(static_cast<std::size_t>(m.rows()), 0.0);
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] >= 0) total[m.point[i]] += system.weight(i);
  }
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] >= 0) share[i] = system.weight(i) / total[m.point[i]];
  }
  return share;
}

/// The inverse, without the directions that nothing but the row itself tells.
Eigen::Matrix3d inverse_where_told(const Eigen::Matrix3d& spread) {
  constexpr double kUntold = 1e-6;
  const Eigen::Matrix3d inverse = spread.inverse();
  if (inverse.norm() < 1.0 / kUntold && spread.determinant() > 0.0) return inverse;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const Vec3 values = axes.eigenvalues();
  const Vec3 inverses = (values.array() < kUntold).select(0.0, values.cwiseInverse());
  return axes.eigenvectors() * inverses.asDiagonal() * axes.eigenvectors().transpose();
}

Study study(const ArmSystem& system, const Eigen::VectorXd& x) {
  const Measurement& m = system.measurement();
  Eigen::VectorXd residuals(system.rows());
  Eigen::MatrixXd jacobian(system.rows(), system.columns());
  const Eigen::VectorXd y = system.scaled(x);
  system.evaluate(y.data(), residuals.data(), jacobian.data());
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian);
  // (P, 3 N): how each row of positions hangs on the columns.
  const Eigen::MatrixXd hold = qr.matrixQR()
                                   .topRows(jacobian.cols())
                                   .triangularView<Eigen::Upper>()
                                   .transpose()
                                   .solve(jacobian.topRows(3 * m.rows()).transpose());
  const std::vector<double> share = shares(system);

  Study out;
  out.square.setZero(m.rows());
  out.distance.setZero(m.rows());
  out.reach.setZero(m.rows());
  double sum = 0.0;
  for (Index i = 0; i < m.rows(); ++i) {
    const double trust = system.trust()[i];
    const Vec3 residual = residuals.segment<3>(3 * i);
    const auto held = hold.middleCols<3>(3 * i);
    const Eigen::Matrix3d lever = held.transpose() * held;
    if (is_kept(trust)) {
      sum += residual.squaredNorm();
      out.freedom += dimensions(m, i) * (1.0 - share[i]) - lever.trace();
    }
    // Among the others: a row that was fitted is nearer to the fit than chance would have it.
    const double sign = is_kept(trust) ? -1.0 : 1.0;
    const Eigen::Matrix3d spread =
        (1.0 + sign * share[i]) * Eigen::Matrix3d::Identity() + sign * lever / trust;
    const Vec3 miss = residual / std::sqrt(trust);
    const Eigen::Matrix3d by_spread = inverse_where_told(spread);
    out.square[i] = miss.dot(by_spread * miss);
    const Vec3 from = by_spread * (is_kept(trust) ? miss : Vec3(spread * miss));
    out.distance[i] = from.norm() * system.noise().position / std::sqrt(m.weights[i]);
    out.reach[i] = std::sqrt(1.0 + share[i] + lever.trace() / trust);
  }
  const double unit = kLeastNoise / system.noise().position;
  out.variance = std::max(out.freedom > 0.0 ? sum / out.freedom : 0.0, unit * unit);
  return out;
}

/// Whether chance would put row i where it is.
bool stands_apart(const Study& study, const ArmSystem& system, Index i) {
  const int axes = dimensions(system.measurement(), i);
  const bool kept = is_kept(system.trust()[i]);
  const double freedom = study.freedom - (kept ? axes : 0);
  if (freedom < 1.0) return false;
  const double rest = study.variance * study.freedom - (kept ? study.square[i] : 0.0);
  const double floor = kLeastNoise / system.noise().position;
  const double variance = std::max(rest / freedom, floor * floor);
  if (study.distance[i] < kLeastDistance) return false;
  if (study.square[i] < kLeastSigma * kLeastSigma * variance) return false;
  const double f = study.square[i] / (axes * variance);
  return f_tail(f, axes, freedom) < kFalseAlarm / static_cast<double>(system.measurement().rows());
}

/// Residuals without outliers are normal: none far out, and their median where their mean puts it.
bool looks_normal(const Study& study, const ArmSystem& system) {
  constexpr double kMostMean = 1.5;
  const Measurement& m = system.measurement();
  std::vector<double> scaled;
  double sum = 0.0;
  for (Index i = 0; i < m.rows(); ++i) {
    if (stands_apart(study, system, i)) return false;
    if (dimensions(m, i) != 3) continue;
    scaled.push_back(study.square[i]);
    sum += study.square[i];
  }
  if (scaled.empty()) return true;
  const auto middle = scaled.begin() + static_cast<std::ptrdiff_t>(scaled.size() / 2);
  std::nth_element(scaled.begin(), middle, scaled.end());
  const double mean = sum / (3.0 * static_cast<double>(scaled.size()));
  return mean < kMostMean * *middle / (kMedianOfNorm * kMedianOfNorm);
}

Eigen::VectorXd weighted_norms(const ArmSystem& system, const Eigen::VectorXd& x) {
  Eigen::VectorXd norms = system.deviations(x).colwise().norm();
  for (Index i = 0; i < norms.size(); ++i) norms[i] *= std::sqrt(system.measurement().weights[i]);
  return norms;
}

void solve(const ArmSystem& system, int steps, Eigen::VectorXd& x) {
  const LeastSquaresOptions options{.max_iterations = steps};
  x = system.values(solve_least_squares(system, system.scaled(x), options).y);
}

/// Of touches, that is: measured positions hold an arm where it is.
bool has_strayed(const ArmSystem& system, const Eigen::VectorXd& x) {
  if (system.measurement().tracked) return false;
  const ArmColumns& columns = system.arm_columns();
  for (const int c : system.free()) {
    const Place& place = columns.places[c];
    if (!is_row(place)) continue;
    const double change = std::abs(x[c] - columns.columns[c].nominal);
    if (change > (is_length(place) ? kFarLength : kFarAngle)) return true;
  }
  return false;
}

/// The same search with every row of the arm held loosely to its drawing, the frames hardly.
ArmSystem near_drawing(const ArmSystem& fitted, const Measurement& untold) {
  constexpr double kFrame = 10.0;   // [m] or [rad]
  constexpr double kLength = 2e-3;  // [m] little else holds the size of touches
  const ArmColumns& columns = fitted.arm_columns();
  ArmSystem system(columns, untold, Criterion::kCentroid, false, 1);
  system.set_free(fitted.free());
  std::vector<LinearRow> rows;
  for (const int c : fitted.free()) {
    const Place& place = columns.places[c];
    const double std = !is_row(place) ? kFrame : is_length(place) ? kLength : kFarAngle;
    rows.push_back({Eigen::VectorXd::Unit(columns.nominal().size(), c), std});
  }
  system.set_linear_rows(std::move(rows));
  system.set_noise(fitted.noise(), columns.nominal());
  return system;
}

double huber(double ratio) {
  constexpr double kWidth = 1.345;
  return std::min(1.0, kWidth / std::max(ratio, kWidth));
}

double tukey(double ratio) {
  constexpr double kWidth = 4.685;
  const double bell = 1.0 - ratio * ratio / (kWidth * kWidth);
  return std::max(bell > 0.0 ? bell * bell : 0.0, kWhisper);
}

/// Finds the arm again with each row trusted by its distance in units of the noise.
void reweigh(ArmSystem& system, double (*trust_of)(double), int most_rounds, Eigen::VectorXd& x) {
  constexpr double kSettled = 0.02;
  std::vector<double> trust = system.trust();
  for (int round = 0; round < most_rounds; ++round) {
    const Eigen::VectorXd norms = weighted_norms(system, x);
    const double noise = std::max(median_noise(system, norms), kLeastDistance / kLeastSigma);
    double change = 0.0;
    for (Index i = 0; i < norms.size(); ++i) {
      const double next = trust_of(norms[i] / noise);
      change = std::max(change, std::abs(next - trust[i]));
      trust[i] = next;
    }
    if (change < kSettled) return;
    system.set_trust(trust);
    system.set_noise({noise, system.noise().rotation}, x);
    solve(system, 2, x);
  }
}

/// Least squares of the rows that stand the test, until they stay the same.
Study settle(ArmSystem& system, Eigen::VectorXd& x) {
  const Eigen::VectorXd norms = weighted_norms(system, x);
  const double noise = std::max(median_noise(system, norms), kLeastDistance / kLeastSigma);
  std::vector<double> trust(system.trust().size(), 1.0);
  for (Index i = 0; i < norms.size(); ++i) {
    if (norms[i] > kLeastSigma * noise) trust[i] = kWhisper;
  }
  Study found;
  for (int round = 0; round < kMaxSearchRounds; ++round) {
    system.set_trust(trust);
    solve(system, 5, x);
    found = study(system, x);
    const double now = system.noise().position * std::sqrt(found.variance);
    system.set_noise({now, system.noise().rotation}, x);
    found = study(system, x);
    std::vector<double> next(trust.size(), 1.0);
    for (Index i = 0; i < norms.size(); ++i) {
      if (stands_apart(found, system, i)) next[i] = kWhisper;
    }
    if (next == trust) break;
    trust = std::move(next);
  }
  return found;
}

/// The other point near which row i lies, when there is one.
std::optional<int> point_that_fits(const ArmSystem& system, const Study& study, Index i,
                                   const Vec3& tip, const Eigen::Matrix3Xd& centers) {
  constexpr double kMuchNearer = 0.2;
  const Measurement& m = system.measurement();
  const double noise =
      system.noise().position * std::sqrt(study.variance / m.weights[i]) * study.reach[i];
  for (int p = 0; p < m.points(); ++p) {
    const double away = (tip - centers.col(p)).norm();
    if (p != m.point[i] && away < kLeastSigma * noise && away < kMuchNearer * study.distance[i]) {
      return m.labels[p];
    }
  }
  return std::nullopt;
}

}  // namespace

OutlierSearch find_outliers(const ArmSystem& fitted, const Eigen::VectorXd& x) {
  const Measurement& m = fitted.measurement();
  OutlierSearch out{
      {}, false, false, x, std::vector<double>(static_cast<std::size_t>(m.rows()), 1.0), {}};
  if (fitted.columns() == 0) return out;  // nothing was asked of the rows
  {
    ArmSystem system = fitted;
    system.set_criterion(Criterion::kCentroid, false);
    system.set_trust(out.trust);
    const Study found = study(system, x);
    if (!has_strayed(system, x) && (found.freedom < 1.0 || looks_normal(found, system))) return out;
  }

  out.looked_twice = true;
  Measurement untold = m;
  untold.distances.clear();
  untold.known_points.clear();
  ArmSystem system = near_drawing(fitted, untold);
  Eigen::VectorXd found_x = fitted.arm_columns().nominal();
  reweigh(system, huber, 15, found_x);
  reweigh(system, tukey, 10, found_x);
  const Study found = settle(system, found_x);
  out.points = system.centroids(found_x);
  const Eigen::Matrix3Xd deviations = system.deviations(found_x);
  Index strangers = 0;
  for (Index i = 0; i < m.rows(); ++i) {
    if (is_kept(system.trust()[i])) continue;
    Outlier outlier{static_cast<int>(i), m.point[i] < 0 ? -1 : m.labels[m.point[i]],
                    found.distance[i], std::nullopt};
    if (m.point[i] >= 0) {
      const Vec3 tip = out.points.col(m.point[i]) + deviations.col(i);
      outlier.fits = point_that_fits(system, found, i, tip, out.points);
    }
    if (!outlier.fits) ++strangers;
    out.outliers.push_back(outlier);
  }
  const double left = std::sqrt(3.0 * found.variance) * system.noise().position;
  if (3 * strangers > m.rows() || left > kForeignShare * chain_length(system.arm_columns().arm)) {
    out.hopeless = true;
    out.outliers.clear();
    return out;
  }
  out.x = found_x;
  out.trust = system.trust();
  return out;
}

}  // namespace bathyal
