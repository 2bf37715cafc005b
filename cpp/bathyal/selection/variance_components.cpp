// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/variance_components.hpp"

#include <map>
#include <utility>
#include <vector>

namespace bathyal::selection {
namespace {

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
  std::vector<std::vector<Index>> rows = at.rows_by_observation(weights.size());
  for (std::vector<Index>& own : rows)
    std::erase_if(own, [&](Index row) { return row >= at.noise_rows; });
  Spread out;
  for (const std::vector<int>& set : observations_by_source(term, weights)) {
    const Eigen::MatrixXd loads = term.loads(rows[set[0]], Eigen::all) / noise;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(loads * loads.transpose());
    // Of n replicates the first combination is √n times their mean, the others have no part in it.
    const auto count = static_cast<Index>(set.size());
    const Eigen::MatrixXd combinations =
        Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::VectorXd::Ones(count)).householderQ();
    for (Index k = 0; k < loads.rows(); ++k) {
      const Eigen::VectorXd direction = eigen.eigenvectors().col(k);
      Eigen::VectorXd along(count);
      Eigen::MatrixXd part(basis.cols(), count);
      for (Index i = 0; i < count; ++i) {
        along[i] = direction.dot(unexplained_residual(rows[set[i]]));
        part.col(i) = basis(rows[set[i]], Eigen::all).transpose() * direction;
      }
      along = combinations.transpose() * along;
      const Eigen::VectorXd taken = (part * combinations).colwise().squaredNorm();
      for (Index c = 0; c < count; ++c) {
        const double free = 1.0 - taken[c];
        if (free < kLeastFree) continue;
        const double share = c == 0 ? static_cast<double>(count) : 0.0;
        out.add(set[0], along[c] * along[c] / free, share * std::max(eigen.eigenvalues()[k], 0.0));
      }
    }
  }
  return out;
}

}  // namespace

VarianceComponentFit fit_variance_component(const VarianceComponent& term, const Linearization& at,
                                            const Eigen::MatrixXd& basis,
                                            const Eigen::VectorXd& weights, double noise,
                                            const Folds& folds) {
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
