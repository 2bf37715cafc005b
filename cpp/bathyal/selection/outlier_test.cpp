// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/outlier_test.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/selection/decisions.hpp"

namespace bathyal::selection {
namespace {

/// Variance in units of the noise below which residuals are rounding, and have no outliers.
constexpr double kRounding = 1e-6;

std::vector<std::vector<Index>> rows_of_observations(const Linearization& at, Index observations) {
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(observations));
  for (Index r = 0; r < at.residual.size(); ++r) {
    if (at.observation[r] >= 0) rows[at.observation[r]].push_back(r);
  }
  return rows;
}

/// Squared residuals, rotated within each observation, and among replicates that share their
/// sources, so that a variance component leaves them independent.
struct Spread {
  std::vector<int> observation;  ///< of replicates that share their sources, the first
  std::vector<double> squares;   ///< corrected for leverage
  std::vector<double> variance;  ///< by the component, relative to the noise
  void add(int of, double square, double by_form) {
    observation.push_back(of);
    squares.push_back(square);
    variance.push_back(by_form);
  }
};

/// -2 log likelihood at variances 1 + θ v, profiled over the common factor.
double deviance(const Spread& s, double theta) {
  double logs = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < s.squares.size(); ++i) {
    const double factor = 1.0 + theta * s.variance[i];
    logs += std::log(factor);
    sum += s.squares[i] / factor;
  }
  const auto rows = static_cast<double>(s.squares.size());
  return logs + rows * std::log(std::max(sum / rows, 1e-300));
}

/// The θ at which `loss` is least, by golden-section search in ln θ.
template <typename Loss>
double least_theta(const Loss& loss) {
  constexpr double kGolden = 0.6180339887498949;
  double low = std::log(1e-6), high = std::log(1e6);
  // The loss may have several minima: the search starts from the best point of a coarse grid.
  constexpr int kSteps = 60;
  int best = 0;
  double least = loss(std::exp(low));
  for (int k = 1; k <= kSteps; ++k) {
    const double now = loss(std::exp(low + (high - low) * k / kSteps));
    if (now < least) {
      least = now;
      best = k;
    }
  }
  const double step = (high - low) / kSteps;
  const double middle = low + step * best;
  low = middle - step;
  high = middle + step;
  while (high - low > 1e-6) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (loss(std::exp(a)) < loss(std::exp(b))) {
      high = b;
    } else {
      low = a;
    }
  }
  return std::exp(0.5 * (low + high));
}

/// θ of least deviance; 0 when none is better than that.
double best_theta(const Spread& s) {
  const double theta = least_theta([&](double at) { return deviance(s, at); });
  return deviance(s, theta) < deviance(s, 0.0) ? theta : 0.0;
}

Spread some_of(const Spread& all, const std::vector<int>& fold, int wanted, bool inside) {
  Spread out;
  for (std::size_t i = 0; i < all.observation.size(); ++i) {
    if ((fold[all.observation[i]] == wanted) == inside) {
      out.add(all.observation[i], all.squares[i], all.variance[i]);
    }
  }
  return out;
}

double best_scale(const Spread& s, double theta) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.squares.size(); ++i) {
    sum += s.squares[i] / (1.0 + theta * s.variance[i]);
  }
  return s.squares.empty() ? 1.0 : sum / static_cast<double>(s.squares.size());
}

double log_likelihood(const Spread& s, double theta, double scale) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.squares.size(); ++i) {
    const double factor = scale * (1.0 + theta * s.variance[i]);
    sum -= 0.5 * (std::log(factor) + s.squares[i] / factor);
  }
  return sum;
}

/// Those that are not excluded.
std::vector<std::vector<int>> observations_by_source(const VarianceComponent& term,
                                                     const Eigen::VectorXd& weights) {
  std::map<int, std::vector<int>> sets;
  for (int i = 0; i < static_cast<int>(weights.size()); ++i) {
    if (weights[i] > 0.0) sets[term.source.empty() ? i : term.source[i]].push_back(i);
  }
  std::vector<std::vector<int>> out;
  for (auto& [source, set] : sets) out.push_back(std::move(set));
  return out;
}

Spread spread_of(const VarianceComponent& term, const Linearization& at,
                 const Eigen::MatrixXd& basis, const Eigen::VectorXd& weights, double noise) {
  constexpr double kLeastFree = 1e-3;  // 1 - leverage of a row that the model all but determines
  const Eigen::VectorXd unexplained_residual =
      at.residual - basis * (basis.transpose() * at.residual);
  std::vector<std::vector<Index>> rows = rows_of_observations(at, weights.size());
  for (std::vector<Index>& own : rows)
    std::erase_if(own, [&](Index row) { return row >= at.noise_rows; });
  Spread out;
  for (const std::vector<int>& set : observations_by_source(term, weights)) {
    const Eigen::MatrixXd loads = term.loads(rows[set[0]], Eigen::all) / noise;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(loads * loads.transpose());
    const Eigen::MatrixXd turn = eigen.eigenvectors().transpose();
    // Of n replicates the first combination is √n times their mean, the others have no part in it.
    const auto count = static_cast<Index>(set.size());
    const Eigen::MatrixXd combinations =
        Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::VectorXd::Ones(count)).householderQ();
    for (Index c = 0; c < count; ++c) {
      Eigen::VectorXd along = Eigen::VectorXd::Zero(turn.rows());
      Eigen::MatrixXd part = Eigen::MatrixXd::Zero(turn.rows(), basis.cols());
      for (Index i = 0; i < count; ++i) {
        along += combinations(i, c) * turn * unexplained_residual(rows[set[i]]);
        part += combinations(i, c) * turn * basis(rows[set[i]], Eigen::all);
      }
      const double factor = c == 0 ? static_cast<double>(count) : 0.0;
      for (Index k = 0; k < along.size(); ++k) {
        const double free = 1.0 - part.row(k).squaredNorm();
        if (free < kLeastFree) continue;
        out.add(set[0], along[k] * along[k] / free, factor * std::max(eigen.eigenvalues()[k], 0.0));
      }
    }
  }
  return out;
}

}  // namespace

std::vector<ObservationTest> test_observations(const Linearization& at,
                                               const Eigen::MatrixXd& basis,
                                               const Eigen::VectorXd& weights, double dof) {
  std::vector<std::vector<Index>> rows = rows_of_observations(at, weights.size());
  for (std::vector<Index>& own : rows) {  // a touch of a plane has two rows that measure nothing
    std::erase_if(own, [&](Index r) {
      return at.residual[r] == 0.0 && (at.jacobian.row(r).array() == 0.0).all();
    });
  }
  const Eigen::VectorXd unexplained_residual =
      at.residual - basis * (basis.transpose() * at.residual);
  const double squares = unexplained_residual.squaredNorm();
  std::vector<ObservationTest> out(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::MatrixXd part = basis(rows[i], Eigen::all);
    const auto k = static_cast<Index>(rows[i].size());
    const Eigen::MatrixXd spread = Eigen::MatrixXd::Identity(k, k) - part * part.transpose();
    const Eigen::VectorXd own = unexplained_residual(rows[i]);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(spread);
    const bool used = weights[static_cast<Index>(i)] > 0.0;
    double distance = 0.0, width = 0.0, square = 0.0;
    for (Index c = 0; c < k; ++c) {
      const double left = eigen.eigenvalues()[c];
      if (left < 1e-6) continue;  // not predicted by any other row
      const double along = eigen.eigenvectors().col(c).dot(own);
      distance += along * along / left;
      square += std::pow(used ? along / left : along, 2);
      width += 1.0;
    }
    if (!used) {
      distance /= kExcludedWeight;
      square /= kExcludedWeight;
    }
    const double others = used ? squares - distance : squares;
    const double free = used ? dof - width : dof;
    if (width == 0.0 || !(free > 0.0)) continue;
    const double variance = std::max({others, 1e-12 * squares, kRounding * free}) / free;
    out[i] = {distance / width / variance, f_tail(distance / width / variance, width, free), width,
              distance, std::sqrt(square)};
  }
  return out;
}

Eigen::VectorXd exclude_outliers(const Linearization& at, const Eigen::MatrixXd& basis,
                                 const Eigen::VectorXd& weights, double dof) {
  const std::vector<ObservationTest> tests = test_observations(at, basis, weights, dof);
  const double threshold = Decisions::kOutlierLevel / static_cast<double>(weights.size());
  Eigen::VectorXd out = weights;
  Index outliers = 0;
  for (Index i = 0; i < weights.size(); ++i) {
    const bool belongs = tests[static_cast<std::size_t>(i)].p > threshold;
    if (!belongs) ++outliers;
    if (belongs && !(weights[i] > 0.0)) out[i] = 1.0;
    if (!belongs) out[i] = 0.0;
  }
  return static_cast<double>(outliers) >
                 Decisions::kMaxOutliers * static_cast<double>(weights.size())
             ? weights
             : out;
}

VarianceComponentFit fit_noise(const VarianceComponent& term, const Linearization& at,
                               const Eigen::MatrixXd& basis, const Eigen::VectorXd& weights,
                               double noise, const Folds& folds) {
  Spread all = spread_of(term, at, basis, weights, noise);
  double mean = 0.0;
  for (const double v : all.variance) mean += v / static_cast<double>(all.variance.size());
  VarianceComponentFit out;
  if (!(mean > 0.0)) return out;
  for (double& v : all.variance) v /= mean;  // so that θ is the variance ratio

  const auto theta_of = [&](const Spread& s) {
    if (!(term.known > 0.0)) return best_theta(s);
    // The mean variance by the component is known from the record: θ is that over the rest, which
    // is found where the likelihood is highest. Rows that the component hardly moves show it.
    const double known = term.known * term.known * mean;
    return least_theta([&](double at) { return -log_likelihood(s, at, known / at); });
  };
  const double theta = theta_of(all);
  const double scale = best_scale(all, theta);
  out.gain = 0.5 * (deviance(all, 0.0) - deviance(all, theta));
  out.parameter = term.known > 0.0 ? term.known : std::sqrt(theta * scale / mean);
  // By the curvature of the likelihood in ln θ.
  if (theta > 0.0 && !(term.known > 0.0)) {
    constexpr double kStep = 0.05;
    const double bend = 0.5 *
                        (deviance(all, theta * std::exp(kStep)) +
                         deviance(all, theta * std::exp(-kStep)) - 2.0 * deviance(all, theta)) /
                        (kStep * kStep);
    if (bend > 0.0) out.std = 0.5 * out.parameter / std::sqrt(bend);
  }
  for (int b = 0; b < folds.count; ++b) {
    const Spread others = some_of(all, folds.fold_of, b, false),
                 own = some_of(all, folds.fold_of, b, true);
    const double other_theta = theta_of(others);
    out.held_out_gain += log_likelihood(own, other_theta, best_scale(others, other_theta)) -
                         log_likelihood(own, 0.0, best_scale(others, 0.0));
  }
  out.ratio = theta / (mean * noise * noise);
  out.share = theta / (1.0 + theta);
  return out;
}

}  // namespace bathyal::selection
