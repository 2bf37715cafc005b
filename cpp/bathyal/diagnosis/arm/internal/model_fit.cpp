// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/estimation/gram.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/identify/fit/scale_bias.hpp"
#include "bathyal/identify/model/arm_linearization.hpp"
#include "bathyal/identify/model/effect_parameters.hpp"

// Joint fit of geometry and effects.

namespace bathyal::diagnosis {
namespace {

constexpr int kMaxEvaluations = 6;       ///< of effects, each at the arm of the last fit
constexpr double kSameResiduals = 3e-3;  ///< rms change after a new evaluation [noise]
constexpr int kMaxRounds = 12;           ///< of values, noise and prior scales
constexpr int kMaxSteps = 30;
constexpr double kFirstDamping = 1e-2;  ///< 1 / (10 mm or mrad)²
constexpr double kSettledCost = 1e-2;   ///< of the mean square of a row
constexpr int kOrderRounds = 4;
constexpr double kOrderSettled = 0.05;  ///< standard deviations
constexpr double kFarOrder = 3.0;       ///< over the span: half a wave
constexpr double kOrderStep = 1e-4;     ///< relative

}  // namespace

void ArmModel::fit(const std::vector<int>& terms) {
  for (int round = 0; round < kOrderRounds; ++round) {
    fit_at_settings(terms);
    if (!update_orders()) return;
  }
  fit_at_settings(terms);  // at the orders that moved last
}

/// A Gauss–Newton step for the orders of active waves, given all else that is fitted.
bool ArmModel::update_orders() {
  const Eigen::MatrixXd by_order = setting_derivatives();
  if (by_order.cols() == 0) return false;
  const int threads = problem_.system->num_threads();
  Eigen::MatrixXd basis = linearization_.jacobian.leftCols(observable_.cols());
  append(basis, effect_jacobian_);
  normalize_columns(basis);
  Eigen::MatrixXd square = inner_products(basis, threads);
  square.diagonal().array() += kCollinearityTolerance * kCollinearityTolerance;
  Eigen::MatrixXd projected = by_order;
  add_product(basis, -square.llt().solve(inner_products(basis, by_order, threads)), projected,
              threads);
  Eigen::VectorXd residuals(problem_.system->rows());
  problem_.system->evaluate(problem_.system->scaled(x_).data(), residuals.data(), nullptr);
  const Eigen::VectorXd change =
      -inner_products(projected, threads).ldlt().solve(projected.transpose() * residuals);
  const Eigen::VectorXd precision = projected.colwise().norm();  // 1 / standard deviation
  bool moved = false;
  Index at = 0;
  for (const int term : active_) {
    EffectVariant& variant = sources_[term].variant;
    if (!variant.settings.contains("order") || has_whole_order(variant)) continue;
    const double step = change[at];
    const double far =
        kFarOrder / (data_.q.col(variant.joint).maxCoeff() - data_.q.col(variant.joint).minCoeff());
    const double order = variant.settings["order"] + step;
    // Two waves of one order are one.
    const bool alone = std::none_of(active_.begin(), active_.end(), [&](int other) {
      const EffectVariant& neighbour = sources_[other].variant;
      const auto own = neighbour.settings.find("order");
      return other != term && neighbour.joint == variant.joint && own != neighbour.settings.end() &&
             std::abs(own->second - order) < 0.5 * far;
    });
    if (std::abs(step) * precision[at] > kOrderSettled && std::abs(step) < far && order > 0.0 &&
        alone) {
      variant.settings["order"] = order;
      terms_[term].description = sources_[term].effect->describe(variant, nominal_);
      moved = true;
    }
    ++at;
  }
  return moved;
}

void ArmModel::fit_at_settings(const std::vector<int>& terms) {
  // Terms that stay start from their present values.
  std::map<int, Eigen::VectorXd> known;
  auto at = static_cast<Index>(geometry_);
  for (const int term : active_) {
    const auto wide = static_cast<Index>(sources_[term].variant.parameters.size());
    known[term] = x_.segment(at, wide);
    at += wide;
  }
  active_ = terms;
  const auto families = large_families();
  std::erase_if(prior_scales_, [&](const auto& size) { return !families.contains(size.first); });
  activate(terms);
  Eigen::VectorXd x = x_.head(static_cast<Index>(geometry_));
  for (const int term : terms) {
    const auto wide = static_cast<Index>(sources_[term].variant.parameters.size());
    x.conservativeResize(x.size() + wide);
    x.tail(wide).setZero();
    if (known.contains(term)) x.tail(wide) = known[term];
  }
  const ArmResiduals& system = *problem_.system;
  for (int evaluation = 0; evaluation < kMaxEvaluations; ++evaluation) {
    bool other_noise = true;
    for (int round = 0; round < kMaxRounds; ++round) {
      if (!learn_prior_scales(x) && !other_noise) break;
      const LeastSquaresOptions options = fit_options();
      x = system.values(solve_least_squares(system, system.scaled(x), options).y);
      if (!m_.tracked) x = remove_scale_bias(system, x, options);
      x_ = x;
      other_noise = update_noise();
    }
    if (evaluate_effects_at(x) < kSameResiduals) break;
  }
  linearize_at(x);
  if (terms.empty()) before_ = deviations();
}

/// Appends the parameters of `terms`, with their priors, to those of the geometry.
void ArmModel::activate(const std::vector<int>& terms) {
  active_ = terms;
  truncate_parameters(problem_.parameters, geometry_);
  std::vector<int> free = base_free_;
  for (const int term : terms) {
    const int begin =
        add_effect(problem_.parameters, sources_[term].variant, perturbations_of(term));
    const auto end = static_cast<int>(problem_.parameters.parameters.size());
    for (int c = begin; c < end; ++c) {
      Parameter& column = problem_.parameters.parameters[c];
      column.prior_std = prior_std(term, static_cast<std::size_t>(c - begin), column.scale);
      free.push_back(c);
    }
  }
  problem_.system->set_free(std::move(free));
}

double ArmModel::evaluate_effects_at(const Eigen::VectorXd& x) {
  const ArmResiduals& system = *problem_.system;
  effects_arm_ = arm_at(x);
  exact_ = consistent_joints(system, x);
  // Effects evaluated at recorded joints would follow their scatter, and so explain it.
  if (!m_.tracked) data_.q = exact_;
  if (!effects_changed()) return 0.0;
  const auto residuals = [&] {
    Eigen::VectorXd out(system.rows());
    system.evaluate(system.scaled(x).data(), out.data(), nullptr);
    return Eigen::VectorXd(out.head(system.data_rows()));
  };
  const Eigen::VectorXd before = residuals();
  activate(active_);
  return (residuals() - before).norm() / std::sqrt(static_cast<double>(before.size()));
}

/// Whether the perturbations of active effects differ from those that were fitted.
bool ArmModel::effects_changed() const {
  const auto same = [](const Perturbation& a, const Perturbation& b) {
    return a.values == b.values;
  };
  std::size_t column = 0;
  for (const int term : active_) {
    for (const std::vector<Perturbation>& perturbations : perturbations_of(term)) {
      const std::vector<Perturbation>& active = *problem_.parameters.perturbations[column++];
      if (!std::equal(perturbations.begin(), perturbations.end(), active.begin(), active.end(),
                      same)) {
        return true;
      }
    }
  }
  return false;
}

/// All that a fit estimates.
struct ArmModel::ArmCheckpoint final : Checkpoint {
  ArmCheckpoint(Arm arm, RowMatrix q, RowMatrix joints)
      : effects_arm(std::move(arm)), effects_q(std::move(q)), exact(std::move(joints)) {}

  std::vector<int> active;
  std::vector<EffectVariant> variants;  ///< of those: their orders are fitted
  std::map<Family, double> prior_scales;
  Eigen::VectorXd x;
  Arm effects_arm;      ///< at which they are evaluated
  RowMatrix effects_q;  ///< likewise
  RowMatrix exact;
  std::vector<double> weights;
  ArmResiduals::Whitening whitening;
  Noise noise;
};

std::shared_ptr<const selection::Model::Checkpoint> ArmModel::save() const {
  auto out = std::make_shared<ArmCheckpoint>(effects_arm_, data_.q, exact_);
  out->active = active_;
  for (const int term : active_) out->variants.push_back(sources_[term].variant);
  out->prior_scales = prior_scales_;
  out->x = x_;
  out->weights = problem_.system->observation_weights();
  out->whitening = problem_.system->row_whitening();
  out->noise = problem_.system->noise();
  return out;
}

void ArmModel::restore(const Checkpoint& checkpoint) {
  const auto& to = dynamic_cast<const ArmCheckpoint&>(checkpoint);
  for (std::size_t i = 0; i < to.active.size(); ++i) {
    Source& source = sources_[to.active[i]];
    source.variant = to.variants[i];
    terms_[to.active[i]].description = source.effect->describe(source.variant, nominal_);
  }
  prior_scales_ = to.prior_scales;
  effects_arm_ = to.effects_arm;
  data_.q = to.effects_q;
  exact_ = to.exact;
  activate(to.active);
  problem_.system->set_observation_weights(to.weights);
  problem_.system->set_row_whitening(to.whitening);
  problem_.system->set_noise(to.noise, to.x);
  linearize_at(to.x);
}

/// Derivatives at consistent joint values: at the recorded ones, scatter would pass for information
/// on the arm's scale (see identify/fit/scale_bias.hpp).
Eigen::MatrixXd ArmModel::derivatives(const Eigen::VectorXd& x) const {
  ArmResiduals exact = *problem_.system;
  exact.set_joints(exact_);
  return exact.jacobian(x);
}

/// Damping is the same for all parameters in units of their scales, so that steps along a curved
/// valley stay within plausible changes.
LeastSquaresOptions ArmModel::fit_options() const {
  return {.solver = Solver::kPaper,
          .max_iterations = kMaxSteps,
          .damping = kFirstDamping,
          .cost_change = 0.0,
          .relative_cost_change = kSettledCost / static_cast<double>(problem_.system->data_rows()),
          .ridge = kCollinearityTolerance * kCollinearityTolerance,
          .subspace = admissible_changes()};
}

/// (free, k): admissible changes of the free parameters. Those of the base model change along the
/// directions that data or priors determine, effects one by one.
Eigen::MatrixXd ArmModel::admissible_changes() const {
  const Index effects = problem_.system->columns() - observable_.rows();
  Eigen::MatrixXd out =
      Eigen::MatrixXd::Zero(observable_.rows() + effects, observable_.cols() + effects);
  out.topLeftCorner(observable_.rows(), observable_.cols()) = observable_;
  out.bottomRightCorner(effects, effects).setIdentity();
  return out;
}

void ArmModel::linearize_at(const Eigen::VectorXd& x) {
  x_ = x;
  ArmResiduals& system = *problem_.system;
  const Index rows = system.rows();
  const auto wide = static_cast<Index>(base_free_.size());
  Eigen::VectorXd residuals(rows);
  const Eigen::VectorXd y = system.scaled(x);
  system.evaluate(y.data(), residuals.data(), nullptr);
  const Eigen::MatrixXd jacobian = derivatives(x);
  effect_jacobian_ = jacobian.rightCols(system.columns() - wide);
  linearization_ =
      to_linearization(system, effect_jacobian_ * y.tail(y.size() - wide) - residuals,
                       product(jacobian.leftCols(wide), observable_, system.num_threads()));
  // Prior rows of effects measure nothing.
  linearization_.constrained_dof += static_cast<double>(system.columns() - wide);
}

/// (M, orders) d modelled / d order of active waves: the uncertainty of an order is part of that of
/// the values.
Eigen::MatrixXd ArmModel::setting_derivatives() const {
  std::vector<ActingVariant> acting;
  std::vector<Eigen::VectorXd> values;
  std::vector<double> changes;
  auto at = static_cast<Index>(geometry_);
  for (const int term : active_) {
    const EffectVariant& here = sources_[term].variant;
    const auto wide = static_cast<Index>(here.parameters.size());
    const auto order = here.settings.find("order");
    if (order != here.settings.end() && !has_whole_order(here)) {
      values.emplace_back(x_.segment(at, wide));
      changes.push_back(kOrderStep * order->second);
      for (const double change : {changes.back(), -changes.back()}) {
        EffectVariant other = here;
        other.settings["order"] += change;
        auto perturbations = perturbations_of(*sources_[term].effect, other);
        acting.push_back({std::move(other), std::move(perturbations)});
      }
    }
    at += wide;
  }
  Eigen::MatrixXd out(linearization_.residual.size(), static_cast<Index>(values.size()));
  if (values.empty()) return out;
  const std::vector<ParameterColumns> moved = columns_of(std::move(acting));
  for (std::size_t i = 0; i < values.size(); ++i) {
    out.col(static_cast<Index>(i)) =
        (moved[2 * i].columns - moved[2 * i + 1].columns) * (values[i] / (2.0 * changes[i]));
  }
  return out;
}

}  // namespace bathyal::diagnosis
