// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/optimal_design.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bathyal/base/parallel.hpp"

namespace bathyal {

using Eigen::Index;

namespace {

constexpr std::size_t kTouchesPerChunk = 64;
/// Of variances: high enough for the worst poses to dominate, low enough for others to contribute.
constexpr double kPower = 12.0;
constexpr int kShortlist = 4;  ///< candidates of an exchange that are evaluated exactly
// Relative to the difference between the first selection and all candidates together: parameters
// that the touches never determine would otherwise dominate the criterion, and small gains must
// still be found.
constexpr double kMinimumGain = 1e-5;  ///< by which an exchange must improve the criterion
constexpr double kConverged = 2e-3;  ///< a round that changes the criterion by less is the last one
constexpr double kExcluded = -std::numeric_limits<double>::infinity();

/// Posterior covariance given the selected touches.
struct Posterior {
  Eigen::MatrixXd covariance;  ///< of all unknowns
  Eigen::VectorXd variance;    ///< (S,) of the tip over the workspace
  double value = 0.0;          ///< minimised: ln of a worst variance, or of a determinant
};

class ExchangeSelector {
 public:
  ExchangeSelector(const OptimalDesign& design, int first_points, int num_threads)
      : d_(design),
        first_points_(first_points),
        num_threads_(num_threads),
        columns_(design.touches.rows()),
        information_(design.prior),
        used_(design.point.size(), false),
        touched_(static_cast<std::size_t>(design.points), 0) {}

  bool add_best(int point);
  void exchange(std::size_t slot, double minimum_gain, Posterior& now);
  Posterior posterior(const Eigen::MatrixXd& information) const;
  Posterior posterior_of_all() const;
  const Eigen::MatrixXd& information() const { return information_; }
  const std::vector<int>& chosen() const { return chosen_; }

 private:
  bool by_determinant() const { return d_.tips.cols() == 0; }
  Eigen::VectorXd gains(const Eigen::MatrixXd& information, int only_point) const;
  std::vector<int> best_of(const Eigen::VectorXd& gains, int count) const;
  void change(Eigen::MatrixXd& information, int touch, double sign) const;
  Eigen::Matrix3d quadratic_form(int touch, const Eigen::MatrixXd& covariance,
                                 const Eigen::Ref<const Eigen::MatrixXd>& product) const;

  const OptimalDesign& d_;
  int first_points_;
  int num_threads_;
  Index columns_;
  Eigen::MatrixXd information_;
  std::vector<bool> used_;
  std::vector<int> touched_;  ///< how often each point
  std::vector<int> chosen_;
};

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information) {
  return information.llt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

double log_determinant(const Eigen::MatrixXd& matrix) {
  const Eigen::LLT<Eigen::MatrixXd> root(matrix);
  return 2.0 * root.matrixLLT().diagonal().array().log().sum();
}

void ExchangeSelector::change(Eigen::MatrixXd& information, int touch, double sign) const {
  const auto rows = d_.touches.middleCols<3>(3 * touch);
  const Index at = columns_ + 3 * d_.point[touch];
  const double weight = d_.point_weight;
  information.topLeftCorner(columns_, columns_) += sign * (rows * rows.transpose());
  information.block(0, at, columns_, 3) -= sign * weight * rows;
  information.block(at, 0, 3, columns_) -= sign * weight * rows.transpose();
  information.block<3, 3>(at, at).diagonal().array() += sign * weight * weight;
}

Posterior ExchangeSelector::posterior(const Eigen::MatrixXd& information) const {
  Posterior out;
  out.covariance = inverse_of(information);
  const auto arm = out.covariance.topLeftCorner(columns_, columns_);
  if (by_determinant()) {
    out.value = log_determinant(arm);
    return out;
  }
  const Eigen::VectorXd squares =
      (d_.tips.array() * (arm * d_.tips).array()).colwise().sum().transpose();
  out.variance = squares.reshaped(3, squares.size() / 3).colwise().sum().transpose();
  const double worst = out.variance.maxCoeff();
  out.value =
      std::log(worst) + std::log((out.variance / worst).array().pow(kPower).mean()) / kPower;
  return out;
}

/// Given all candidates.
Posterior ExchangeSelector::posterior_of_all() const {
  Eigen::MatrixXd information = d_.prior;
  for (int touch = 0; touch < static_cast<int>(d_.point.size()); ++touch) {
    change(information, touch, 1.0);
  }
  return posterior(information);
}

/// Gᵀ M G for the rows G of a touch; `product` is the columns' corner of M times theirs of G.
Eigen::Matrix3d ExchangeSelector::quadratic_form(
    int touch, const Eigen::MatrixXd& matrix,
    const Eigen::Ref<const Eigen::MatrixXd>& product) const {
  const auto rows = d_.touches.middleCols<3>(3 * touch);
  const Index at = columns_ + 3 * d_.point[touch];
  const double weight = d_.point_weight;
  const Eigen::Matrix3d mixed = weight * (rows.transpose() * matrix.block(0, at, columns_, 3));
  return rows.transpose() * product - mixed - mixed.transpose() +
         weight * weight * matrix.block<3, 3>(at, at);
}

/// Decrease of the criterion by each unused touch: first order, or exact for the determinant.
Eigen::VectorXd ExchangeSelector::gains(const Eigen::MatrixXd& information, int only_point) const {
  const Posterior current = posterior(information);
  const Eigen::MatrixXd& covariance = current.covariance;
  Eigen::MatrixXd sensitivity;  // covariance · Σ w ∂tip ∂tipᵀ · covariance
  Eigen::VectorXd own = Eigen::VectorXd::Zero(d_.points);  // information on its point alone
  if (by_determinant()) {
    const Index rest = 3 * d_.points;
    const Eigen::MatrixXd points = inverse_of(information.bottomRightCorner(rest, rest));
    for (int p = 0; p < d_.points; ++p) {
      own[p] = std::log((Eigen::Matrix3d::Identity() +
                         d_.point_weight * d_.point_weight * points.block<3, 3>(3 * p, 3 * p))
                            .determinant());
    }
  } else {
    const Eigen::VectorXd weight =
        (current.variance / current.variance.maxCoeff()).array().pow(kPower - 1.0);
    const Eigen::VectorXd thrice = weight.transpose().replicate(3, 1).reshaped();
    const Eigen::MatrixXd spread = d_.tips * thrice.asDiagonal() * d_.tips.transpose();
    sensitivity = covariance.leftCols(columns_) * spread * covariance.topRows(columns_);
  }

  const auto arm = [&](const Eigen::MatrixXd& matrix, Index begin, Index count) {
    return Eigen::MatrixXd(matrix.topLeftCorner(columns_, columns_) *
                           d_.touches.middleCols(3 * begin, 3 * count));
  };
  Eigen::VectorXd out(static_cast<Index>(d_.point.size()));
  parallel_for(
      d_.point.size(), kTouchesPerChunk, num_threads_, [&](std::size_t begin, std::size_t end) {
        const auto first = static_cast<Index>(begin);
        const auto count = static_cast<Index>(end - begin);
        const Eigen::MatrixXd covariance_rows = arm(covariance, first, count);
        Eigen::MatrixXd sensitivity_rows;
        if (!by_determinant()) sensitivity_rows = arm(sensitivity, first, count);
        for (Index i = 0; i < count; ++i) {
          const auto touch = static_cast<int>(first + i);
          const int point = d_.point[touch];
          if (used_[touch] || (only_point >= 0 ? point != only_point : point >= first_points_)) {
            out[touch] = kExcluded;
            continue;
          }
          const Eigen::Matrix3d gain =
              Eigen::Matrix3d::Identity() +
              quadratic_form(touch, covariance, covariance_rows.middleCols(3 * i, 3));
          out[touch] =
              by_determinant()
                  ? std::log(gain.determinant()) - own[point]
                  : (gain.inverse() *
                     quadratic_form(touch, sensitivity, sensitivity_rows.middleCols(3 * i, 3)))
                        .trace();
        }
      });
  return out;
}

std::vector<int> ExchangeSelector::best_of(const Eigen::VectorXd& gains, int count) const {
  std::vector<int> order(static_cast<std::size_t>(gains.size()));
  std::iota(order.begin(), order.end(), 0);
  const auto most = std::min(static_cast<std::size_t>(count), order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end(),
      [&](int a, int b) { return gains[a] != gains[b] ? gains[a] > gains[b] : a < b; });
  order.resize(most);
  std::erase_if(order, [&](int touch) { return gains[touch] == kExcluded; });
  return order;
}

/// False when all touches of that point have been used.
bool ExchangeSelector::add_best(int point) {
  const std::vector<int> best = best_of(gains(information_, point), 1);
  if (best.empty()) return false;
  const int touch = best.front();
  change(information_, touch, 1.0);
  used_[touch] = true;
  ++touched_[d_.point[touch]];
  chosen_.push_back(touch);
  return true;
}

/// Replaces a touch by another one where that improves `now`.
void ExchangeSelector::exchange(std::size_t slot, double minimum_gain, Posterior& now) {
  const int old = chosen_[slot];
  const int point = d_.point[old];
  Eigen::MatrixXd without = information_;
  change(without, old, -1.0);
  const int only_point = touched_[point] > 2 ? -1 : point;
  const int shortlist = by_determinant() ? 1 : kShortlist;

  int best = -1;
  Posterior best_posterior;
  for (const int touch : best_of(gains(without, only_point), shortlist)) {
    Eigen::MatrixXd with = without;
    change(with, touch, 1.0);
    Posterior candidate = posterior(with);
    if (candidate.value < (best < 0 ? now.value - minimum_gain : best_posterior.value)) {
      best = touch;
      best_posterior = std::move(candidate);
    }
  }
  if (best < 0) return;
  change(without, best, 1.0);
  information_ = std::move(without);
  used_[old] = false;
  used_[best] = true;
  --touched_[point];
  ++touched_[d_.point[best]];
  chosen_[slot] = best;
  now = std::move(best_posterior);
}

}  // namespace

std::vector<int> exchange_select(const OptimalDesign& design, int count, int passes,
                                 int num_threads) {
  const int points = std::clamp(count / 2, 1, design.points);
  ExchangeSelector selector(design, points, num_threads);
  int idle = 0;  // consecutive points without an unused touch
  for (int turn = 0; static_cast<int>(selector.chosen().size()) < count && idle < points; ++turn) {
    idle = selector.add_best(turn % points) ? 0 : idle + 1;
  }
  Posterior now = selector.posterior(selector.information());
  const double range = now.value - selector.posterior_of_all().value;
  for (int pass = 0; pass < passes; ++pass) {
    const double before = now.value;
    for (std::size_t slot = 0; slot < selector.chosen().size(); ++slot) {
      selector.exchange(slot, kMinimumGain * range, now);
    }
    if (now.value > before - kConverged * range) break;
  }
  return selector.chosen();
}

}  // namespace bathyal
