// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/outlier_test.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/estimation/f_distribution.hpp"

namespace bathyal {
namespace {

/// Variance in units of the noise: what exact data leave lies below, and has no outliers.
constexpr double kRounding = 1e-6;
constexpr double kMostOdd = 0.2;  ///< share of units: more are no exception

std::vector<std::vector<Index>> rows_of_units(const Linearization& at, Index units) {
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(units));
  for (Index r = 0; r < at.misfit.size(); ++r) {
    if (at.unit[r] >= 0) rows[at.unit[r]].push_back(r);
  }
  return rows;
}

/// What the rows show, turned within each unit so that a noise form makes them independent.
struct Spread {
  std::vector<int> unit;
  std::vector<double> squares;   ///< leverage taken out
  std::vector<double> variance;  ///< of the form, relative to the noise
  void add(int of, double square, double by_form) {
    unit.push_back(of);
    squares.push_back(square);
    variance.push_back(by_form);
  }
};

/// -2 log likelihood at variances 1 + θ v, the common factor at its best.
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

/// θ of the least deviance, by golden sections of ln θ; 0 when nothing is better than that.
double best_theta(const Spread& s) {
  constexpr double kGolden = 0.6180339887498949;
  double low = std::log(1e-6), high = std::log(1e6);
  // One minimum inside is not certain: the best of a coarse grid is what is narrowed.
  constexpr int kSteps = 60;
  int best = 0;
  double least = deviance(s, std::exp(low));
  for (int k = 1; k <= kSteps; ++k) {
    const double now = deviance(s, std::exp(low + (high - low) * k / kSteps));
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
    if (deviance(s, std::exp(a)) < deviance(s, std::exp(b))) {
      high = b;
    } else {
      low = a;
    }
  }
  const double theta = std::exp(0.5 * (low + high));
  return deviance(s, theta) < deviance(s, 0.0) ? theta : 0.0;
}

Spread some_of(const Spread& all, const std::vector<int>& block, int wanted, bool inside) {
  Spread out;
  for (std::size_t i = 0; i < all.unit.size(); ++i) {
    if ((block[all.unit[i]] == wanted) == inside) {
      out.add(all.unit[i], all.squares[i], all.variance[i]);
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

/// Rows of units that count.
Spread spread_of(const NoiseForm& form, const Linearization& at, const Eigen::MatrixXd& basis,
                 const Eigen::VectorXd& trust, double noise) {
  constexpr double kLeastFree = 1e-3;  // of a row that the model all but explains by itself
  const Eigen::VectorXd left = at.misfit - basis * (basis.transpose() * at.misfit);
  const std::vector<std::vector<Index>> rows = rows_of_units(at, trust.size());
  Spread out;
  for (Index u = 0; u < trust.size(); ++u) {
    if (!(trust[u] > 0.0)) continue;
    std::vector<Index> own = rows[static_cast<std::size_t>(u)];
    std::erase_if(own, [&](Index row) { return row >= at.noise_rows; });
    const Eigen::MatrixXd loads = form.loads(own, Eigen::all) / noise;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(loads * loads.transpose());
    const Eigen::MatrixXd turn = eigen.eigenvectors().transpose();
    const Eigen::VectorXd along = turn * left(own);
    const Eigen::VectorXd taken = (turn * basis(own, Eigen::all)).rowwise().squaredNorm();
    for (Index k = 0; k < along.size(); ++k) {
      const double free = 1.0 - taken[k];
      if (free < kLeastFree) continue;
      out.add(static_cast<int>(u), along[k] * along[k] / free,
              std::max(eigen.eigenvalues()[k], 0.0));
    }
  }
  return out;
}

}  // namespace

std::vector<UnitTest> test_units(const Linearization& at, const Eigen::MatrixXd& basis,
                                 const Eigen::VectorXd& trust, double freedom) {
  std::vector<std::vector<Index>> rows = rows_of_units(at, trust.size());
  for (std::vector<Index>& own : rows) {  // a touch of a plane has two that measure nothing
    std::erase_if(
        own, [&](Index r) { return at.misfit[r] == 0.0 && (at.base.row(r).array() == 0.0).all(); });
  }
  const Eigen::VectorXd left = at.misfit - basis * (basis.transpose() * at.misfit);
  const double squares = left.squaredNorm();
  std::vector<UnitTest> out(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::MatrixXd part = basis(rows[i], Eigen::all);
    const auto k = static_cast<Index>(rows[i].size());
    const Eigen::MatrixXd spread = Eigen::MatrixXd::Identity(k, k) - part * part.transpose();
    const Eigen::VectorXd own = left(rows[i]);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(spread);
    double distance = 0.0, width = 0.0;
    for (Index c = 0; c < k; ++c) {
      if (eigen.eigenvalues()[c] < 1e-6) continue;  // that nothing else foretells
      const double along = eigen.eigenvectors().col(c).dot(own);
      distance += along * along / eigen.eigenvalues()[c];
      width += 1.0;
    }
    const bool used = trust[static_cast<Index>(i)] > 0.0;
    if (!used) distance /= kLeftOut;
    const double others = used ? squares - distance : squares;
    const double free = used ? freedom - width : freedom;
    if (width == 0.0 || !(free > 0.0)) continue;
    const double variance = std::max({others, 1e-12 * squares, kRounding * free}) / free;
    out[i] = {distance / width / variance, f_tail(distance / width / variance, width, free), width};
  }
  return out;
}

Eigen::VectorXd leave_out_odd(const Linearization& at, const Eigen::MatrixXd& basis,
                              const Eigen::VectorXd& trust, double freedom) {
  const std::vector<UnitTest> tests = test_units(at, basis, trust, freedom);
  const double threshold = kOddUnit / static_cast<double>(trust.size());
  Eigen::VectorXd out = trust;
  Index odd = 0;
  for (Index i = 0; i < trust.size(); ++i) {
    const bool belongs = tests[static_cast<std::size_t>(i)].p > threshold;
    if (!belongs) ++odd;
    if (belongs && !(trust[i] > 0.0)) out[i] = 1.0;
    if (!belongs) out[i] = 0.0;
  }
  return static_cast<double>(odd) > kMostOdd * static_cast<double>(trust.size()) ? trust : out;
}

NoiseFit fit_noise(const NoiseForm& form, const Linearization& at, const Eigen::MatrixXd& basis,
                   const Eigen::VectorXd& trust, double noise, const Blocks& blocks) {
  Spread all = spread_of(form, at, basis, trust, noise);
  double mean = 0.0;
  for (const double v : all.variance) mean += v / static_cast<double>(all.variance.size());
  NoiseFit out;
  if (!(mean > 0.0)) return out;
  for (double& v : all.variance) v /= mean;  // so that θ is of the noise's size

  const auto theta_of = [&](const Spread& s) {
    if (!(form.known > 0.0)) return best_theta(s);
    // The step is in the record; what it does beside the rest of the noise, σ² = s² (1 - c).
    const double share = form.known * form.known * mean;
    const double whole = best_scale(s, 0.0);
    return share < 0.99 * whole ? share / (whole - share) : 99.0;
  };
  const double theta = theta_of(all);
  const double scale = best_scale(all, theta);
  out.gain = 0.5 * (deviance(all, 0.0) - deviance(all, theta));
  out.parameter = form.known > 0.0 ? form.known : std::sqrt(theta * scale / mean);
  // By the curvature of the likelihood in ln θ.
  if (theta > 0.0 && !(form.known > 0.0)) {
    constexpr double kStep = 0.05;
    const double bend = 0.5 *
                        (deviance(all, theta * std::exp(kStep)) +
                         deviance(all, theta * std::exp(-kStep)) - 2.0 * deviance(all, theta)) /
                        (kStep * kStep);
    if (bend > 0.0) out.std = 0.5 * out.parameter / std::sqrt(bend);
  }
  for (int b = 0; b < blocks.count; ++b) {
    const Spread others = some_of(all, blocks.of, b, false), own = some_of(all, blocks.of, b, true);
    const double other_theta = theta_of(others);
    out.held_out_gain += log_likelihood(own, other_theta, best_scale(others, other_theta)) -
                         log_likelihood(own, 0.0, best_scale(others, 0.0));
  }
  out.ratio = theta / (mean * noise * noise);
  out.share = theta / (1.0 + theta);
  return out;
}

}  // namespace bathyal
