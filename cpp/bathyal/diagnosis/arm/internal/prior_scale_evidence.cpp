// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/estimation/gram.hpp"
#include "bathyal/estimation/orthogonal.hpp"

// The sizes that values of one kind are held to, learned from the data.

namespace bathyal::diagnosis {
namespace {

constexpr std::size_t kRigid = 6;      ///< values of a rigid motion: more of a kind are learned
constexpr double kScaleSettled = 0.2;  ///< relative
constexpr int kScaleRounds = 40;
constexpr double kScaleFound = 0.02;     ///< relative, of sizes and noise where the model is linear
constexpr double kNoiseFound = 5e-3;     ///< relative
constexpr double kMinPriorScale = 1e-3;  ///< of what the effect's description calls plausible

/// Where the model is linear: values of effects beside all else, with normal priors about 0.
class LinearEffects {
 public:
  /// `told` (k + 1, k + 1): square of all columns, effects' last, and of the misfit, by the data
  /// alone. `weight`: 1 / variance of effects' values before the data.
  LinearEffects(Eigen::MatrixXd told, Eigen::VectorXd weight)
      : told_(std::move(told)), weight_(std::move(weight)), last_(told_.cols() - 1) {}

  void solve() { found_ = root().solve(-told_.col(last_).head(last_) / (noise_ * noise_)); }

  /// The noise that the values leave; by how much it is another, relative.
  double refine_noise(double dof) {
    const double left = told_(last_, last_) + 2.0 * found_.dot(told_.col(last_).head(last_)) +
                        found_.dot(told_.topLeftCorner(last_, last_) * found_);
    const double next = std::sqrt(std::max(left, 0.0) / dof);
    const double change = std::abs(next / noise_ - 1.0);
    noise_ = std::max(next, kLeastNoise);
    return change;
  }

  /// Variance of each value by data and prior.
  Eigen::VectorXd spread() const {
    const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(last_, last_);
    return root().matrixL().solve(all).colwise().squaredNorm().tail(weight_.size());
  }

  /// The size of the values at `places`, relative to what is plausible of them: Σ value² over the
  /// number of values that the data tell rather than the prior. By how much it is another.
  double refine_scale(const std::vector<Index>& places, const Eigen::VectorXd& spread,
                      double& size) {
    const auto values = found_.tail(weight_.size());
    double squares = 0.0, told = 0.0;
    for (const Index i : places) {
      squares += std::pow(values[i], 2) * weight_[i];
      told += 1.0 - spread[i] * weight_[i];
    }
    const double old = size;
    size = std::clamp(old * std::sqrt(squares / std::max(told, 1.0)), kMinPriorScale, 1.0);
    for (const Index i : places) weight_[i] *= std::pow(old / size, 2);
    return std::abs(size / old - 1.0);
  }

 private:
  Eigen::LLT<Eigen::MatrixXd> root() const {
    Eigen::MatrixXd square = told_.topLeftCorner(last_, last_) / (noise_ * noise_);
    square.diagonal().tail(weight_.size()) += weight_;
    square.diagonal() *= 1.0 + kCollinearityTolerance * kCollinearityTolerance;
    return Eigen::LLT<Eigen::MatrixXd>(square);
  }

  Eigen::MatrixXd told_;
  Eigen::VectorXd weight_;
  Index last_;
  double noise_ = 1.0;
  Eigen::VectorXd found_;
};

}  // namespace

/// ActiveSet ones whose sizes can be learned: the places of their values among the effects'.
std::map<ArmModel::Family, std::vector<Index>> ArmModel::large_families() const {
  std::map<Family, std::vector<Index>> out;
  Index count = 0;
  for (const int term : active_) {
    for (std::size_t i = 0; i < sources_[term].variant.parameters.size(); ++i) {
      out[family_of(term)].push_back(count++);
    }
  }
  std::erase_if(out, [](const auto& family) { return family.second.size() <= kRigid; });
  return out;
}

/// Squares of all that moves and of the misfit about effects of 0, where the model is as at `x`, by
/// the data alone. `weight`: what the system holds effects' values with.
Eigen::MatrixXd ArmModel::data_normal_equations(const Eigen::VectorXd& x,
                                                const Eigen::VectorXd& weight) const {
  const ArmResiduals& system = *problem_.system;
  const Eigen::VectorXd y = system.scaled(x);
  const Eigen::MatrixXd to_free = admissible_changes();
  const Index wide = to_free.rows(), last = to_free.cols(), effects = weight.size();
  Eigen::MatrixXd to_all = Eigen::MatrixXd::Zero(wide + 1, last + 1);
  to_all.topLeftCorner(wide, last) = to_free;
  to_all(wide, last) = 1.0;
  Eigen::MatrixXd told =
      inner_products(to_all, product(system.normal_equations(y.data()), to_all, 1), 1);
  const Eigen::VectorXd values = y.tail(effects);
  const auto own = Eigen::seqN(last - effects, effects);
  told.diagonal()(own) -= weight;
  told(own, last) -= weight.cwiseProduct(values);
  told(last, last) -= weight.dot(values.cwiseAbs2());
  told(last, last) += values.dot(told(own, own) * values) - 2.0 * values.dot(told(own, last));
  told.col(last).head(last) -= told(Eigen::seqN(0, last), own) * values;
  return told;
}

/// Many values of one kind along one joint (a curve where it moves little, a dozen waves) have
/// directions that the data hardly tell. They are held to the size that the others show, by the
/// evidence (MacKay 1992). Sizes, noise and values are found together where the model is as at `x`,
/// so that no fit sets out with sizes at which weak directions run off to where it is another.
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
  const double dof = free_rows().sum() - static_cast<double>(observable_.cols() + weight.size());
  const bool noise_is_free = !problem_.options.noise && dof > 0.5;
  std::map<Family, double> sizes;
  for (const auto& [family, places] : families) {
    sizes[family] = prior_scales_.try_emplace(family, 1.0).first->second;
  }
  for (int round = 0; round < kScaleRounds; ++round) {
    model.solve();
    const double change = noise_is_free ? model.refine_noise(dof) : 0.0;
    if (change > kScaleFound) continue;  // with too much noise, all sizes look like none
    bool settled = change < kNoiseFound;
    const Eigen::VectorXd spread = model.spread();
    for (const auto& [family, places] : families) {
      settled = model.refine_scale(places, spread, sizes[family]) < kScaleFound && settled;
    }
    if (settled) break;
  }
  bool learned = false;
  for (const auto& [family, places] : families) {
    double& size = prior_scales_[family];
    const double change = sizes[family] / size;
    if (std::abs(change - 1.0) < kScaleSettled) continue;
    learned = true;
    size = sizes[family];
    for (const Index i : places) {
      columns[geometry_ + static_cast<std::size_t>(i)].prior_std *= change;
    }
  }
  return learned;
}

}  // namespace bathyal::diagnosis
