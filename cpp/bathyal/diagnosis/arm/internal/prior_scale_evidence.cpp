// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/estimation/gram.hpp"
#include "bathyal/estimation/orthogonal.hpp"

// Prior scales of effects' values, estimated by the evidence.

namespace bathyal::diagnosis {
namespace {

constexpr std::size_t kRigidValues = 6;  ///< values of a rigid motion: larger families have a scale
constexpr double kScaleSettled = 0.2;    ///< relative
constexpr int kScaleRounds = 40;
constexpr double kScaleFound = 0.02;     ///< relative, of scales and noise of the linear model
constexpr double kNoiseFound = 5e-3;     ///< relative
constexpr double kMinPriorScale = 1e-3;  ///< of the plausible size

/// The model linearized: values of effects with normal priors about 0, and all other parameters.
class LinearEffects {
 public:
  /// `data` (k + 1, k + 1): Gram matrix of all columns, effects' last, and of the residual, without
  /// priors. `weight`: prior precision of effects' values.
  LinearEffects(Eigen::MatrixXd data, Eigen::VectorXd weight)
      : data_(std::move(data)), weight_(std::move(weight)), last_(data_.cols() - 1) {}

  void solve() { found_ = root().solve(-data_.col(last_).head(last_) / (noise_ * noise_)); }

  /// Updates the noise; returns its relative change.
  double refine_noise(double dof) {
    const double squares = data_(last_, last_) + 2.0 * found_.dot(data_.col(last_).head(last_)) +
                           found_.dot(data_.topLeftCorner(last_, last_) * found_);
    const double next = std::sqrt(std::max(squares, 0.0) / dof);
    const double change = std::abs(next / noise_ - 1.0);
    noise_ = std::max(next, kLeastNoise);
    return change;
  }

  /// Posterior variance of each value.
  Eigen::VectorXd spread() const {
    const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(last_, last_);
    return root().matrixL().solve(all).colwise().squaredNorm().tail(weight_.size());
  }

  /// Updates the scale of the values at `positions`, relative to their plausible size: Σ value²
  /// over the effective number that the data determine. Returns its relative change.
  double refine_scale(const std::vector<Index>& positions, const Eigen::VectorXd& spread,
                      double& scale) {
    const auto values = found_.tail(weight_.size());
    double squares = 0.0, determined = 0.0;
    for (const Index i : positions) {
      squares += std::pow(values[i], 2) * weight_[i];
      determined += 1.0 - spread[i] * weight_[i];
    }
    const double old = scale;
    scale = std::clamp(old * std::sqrt(squares / std::max(determined, 1.0)), kMinPriorScale, 1.0);
    for (const Index i : positions) weight_[i] *= std::pow(old / scale, 2);
    return std::abs(scale / old - 1.0);
  }

 private:
  Eigen::LLT<Eigen::MatrixXd> root() const {
    Eigen::MatrixXd square = data_.topLeftCorner(last_, last_) / (noise_ * noise_);
    square.diagonal().tail(weight_.size()) += weight_;
    square.diagonal() *= 1.0 + kCollinearityTolerance * kCollinearityTolerance;
    return Eigen::LLT<Eigen::MatrixXd>(square);
  }

  Eigen::MatrixXd data_;
  Eigen::VectorXd weight_;
  Index last_;
  double noise_ = 1.0;
  Eigen::VectorXd found_;
};

}  // namespace

/// Active families whose scale can be estimated: the positions of their values among the effects'.
std::map<ArmModel::Family, std::vector<Index>> ArmModel::large_families() const {
  std::map<Family, std::vector<Index>> out;
  Index count = 0;
  for (const int term : active_) {
    for (std::size_t i = 0; i < sources_[term].variant.parameters.size(); ++i) {
      out[family_of(term)].push_back(count++);
    }
  }
  std::erase_if(out, [](const auto& family) { return family.second.size() <= kRigidValues; });
  return out;
}

/// Gram matrix of all columns and of the residual at effects of 0, linearized at `x`, without the
/// effects' priors, whose precision in the system is `weight`.
Eigen::MatrixXd ArmModel::data_normal_equations(const Eigen::VectorXd& x,
                                                const Eigen::VectorXd& weight) const {
  const ArmResiduals& system = *problem_.system;
  const Eigen::VectorXd y = system.scaled(x);
  const Eigen::MatrixXd to_free = admissible_changes();
  const Index wide = to_free.rows(), last = to_free.cols(), effects = weight.size();
  Eigen::MatrixXd to_all = Eigen::MatrixXd::Zero(wide + 1, last + 1);
  to_all.topLeftCorner(wide, last) = to_free;
  to_all(wide, last) = 1.0;
  Eigen::MatrixXd gram =
      inner_products(to_all, product(system.normal_equations(y.data()), to_all, 1), 1);
  const Eigen::VectorXd values = y.tail(effects);
  const auto own = Eigen::seqN(last - effects, effects);
  gram.diagonal()(own) -= weight;
  gram(own, last) -= weight.cwiseProduct(values);
  gram(last, last) -= weight.dot(values.cwiseAbs2());
  gram(last, last) += values.dot(gram(own, own) * values) - 2.0 * values.dot(gram(own, last));
  gram.col(last).head(last) -= gram(Eigen::seqN(0, last), own) * values;
  return gram;
}

/// Many values of one kind along one joint (a dozen waves, and little motion) have directions that
/// the data hardly determine. Their prior scale is estimated by the evidence (MacKay 1992),
/// together with noise and values, in the model linearized at `x`: a fit that starts with too wide
/// priors would follow weak directions out of the linear region.
bool ArmModel::learn_prior_scales(const Eigen::VectorXd& x) {
  const auto families = large_families();
  if (families.empty()) return false;
  std::vector<Parameter>& columns = problem_.parameters.parameters;
  Eigen::VectorXd weight(problem_.system->columns() - observable_.rows());
  for (Index i = 0; i < weight.size(); ++i) {
    const Parameter& column = columns[geometry_ + static_cast<std::size_t>(i)];
    weight[i] = std::pow(column.scale / column.prior_std, 2);
  }
  LinearEffects model(data_normal_equations(x, weight), weight);
  const double dof =
      problem_.system->free_rows().sum() - static_cast<double>(observable_.cols() + weight.size());
  const bool noise_is_free = !problem_.options.noise && dof > 0.5;
  std::map<Family, double> scales;
  for (const auto& [family, positions] : families) {
    scales[family] = prior_scales_.try_emplace(family, 1.0).first->second;
  }
  for (int round = 0; round < kScaleRounds; ++round) {
    model.solve();
    const double change = noise_is_free ? model.refine_noise(dof) : 0.0;
    if (change > kScaleFound) continue;  // while the noise is too large, all scales shrink to 0
    bool settled = change < kNoiseFound;
    const Eigen::VectorXd spread = model.spread();
    for (const auto& [family, positions] : families) {
      settled = model.refine_scale(positions, spread, scales[family]) < kScaleFound && settled;
    }
    if (settled) break;
  }
  bool learned = false;
  for (const auto& [family, positions] : families) {
    double& scale = prior_scales_[family];
    const double change = scales[family] / scale;
    if (std::abs(change - 1.0) < kScaleSettled) continue;
    learned = true;
    scale = scales[family];
    for (const Index i : positions) {
      columns[geometry_ + static_cast<std::size_t>(i)].prior_std *= change;
    }
  }
  return learned;
}

}  // namespace bathyal::diagnosis
