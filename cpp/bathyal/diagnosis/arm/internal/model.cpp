// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "bathyal/base/text.hpp"
#include "bathyal/diagnosis/arm/internal/quantisation_step.hpp"
#include "bathyal/identify/checks/run_checks.hpp"
#include "bathyal/identify/fit/fit_results.hpp"
#include "bathyal/identify/model/chain_derivatives.hpp"
#include "bathyal/identify/model/effect_parameters.hpp"
#include "bathyal/selection/folds.hpp"

namespace bathyal::diagnosis {
namespace {

constexpr double kReplicateDistance = 1e-3;  ///< [rad] or [m]: nearer poses are replicates
constexpr std::size_t kScanFrom = 9;        ///< so many terms of an effect's alias group are a scan
constexpr double kMinSingularValue = 1e-5;  ///< of the largest singular value, per mm and mrad
constexpr double kOrdinaryMove = 1e-3;      ///< [m]
constexpr double kRounding = 1e-7;
constexpr int kMomentsNear = 8;       ///< on either side
constexpr double kNothing = 1e-10;    ///< of an effect's largest perturbation: rounding
constexpr double kPlausible = 100.0;  ///< of a parameter's scale, where the effect gives none
/// Of the residual degrees of freedom, that one effect may use: beyond a third, the penalty of
/// parameters that explain nothing is less than their apparent gain.
constexpr double kMaxShareOfDof = 0.25;

std::vector<int> numbered(const Eigen::VectorXd& values) {
  std::map<double, int> known;
  for (const double value : values) known.emplace(value, 0);
  int next = 0;
  for (auto& [value, index] : known) index = next++;
  std::vector<int> out;
  for (const double value : values) out.push_back(known[value]);
  return out;
}

/// The rank in time of each row.
std::vector<int> ranks_of(const std::vector<int>& order) {
  std::vector<int> out(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) out[order[i]] = static_cast<int>(i);
  return out;
}

}  // namespace

bool has_whole_order(const EffectVariant& variant) {
  const auto order = variant.settings.find("order");
  return order != variant.settings.end() && order->second == std::round(order->second);
}

ArmModel::ArmModel(const Arm& arm, const Measurement& measurement,
                   std::unique_ptr<const Measurement>&& own, const IdentifyOptions& options)
    : nominal_(arm),
      own_(std::move(own)),
      m_(measurement),
      problem_(arm, measurement, options),
      observability_(observe(*problem_.system, problem_.start)),
      fit_(arm),
      effects_arm_(arm) {
  if (problem_.drop_scale_prior(observability_.null_space))
    observability_ = observe(*problem_.system, problem_.start);
  start_ = search(problem_, observability_);
  fit_ = make_arm_fit(problem_, observability_, start_);
  effects_arm_ = fit_.arm;
  geometry_ = problem_.parameters.parameters.size();
  free_observable_directions();
}

ArmModel::ArmModel(const Arm& arm, const Measurement& measurement, const Covariates& covariates,
                   const IdentifyOptions& options, const Effects& effects)
    : ArmModel(arm, measurement, nullptr, options) {
  geometry_warnings_ = run_checks(measurement, *problem_.system, arm, fit_);
  gather_data(covariates);
  gather_observations();
  gather_terms(effects);
  gather_variance_components();
  evaluate_effects_at(x_);
  linearize_at(x_);
}

/// Frees all that the caller does not fix, along the directions that data or priors determine at
/// the end of the search. Parameters that are redundant in general need not be so for an arm of
/// special angles, and collinear columns do no harm here.
void ArmModel::free_observable_directions() {
  for (int c = 0; c < static_cast<int>(geometry_); ++c) {
    if (std::find(problem_.fixed.begin(), problem_.fixed.end(), c) == problem_.fixed.end()) {
      base_free_.push_back(c);
    }
  }
  ArmResiduals& system = *problem_.system;
  system.set_linear_constraints({});
  system.set_free(base_free_);
  x_ = start_.x;
  exact_ = consistent_joints(system, x_);
  const RankReport rank =
      numerical_rank(qr_factor(derivatives(x_), system.num_threads()), kMinSingularValue);
  observable_ = rank.directions.leftCols(rank.rank);
}

void ArmModel::gather_data(const Covariates& covariates) {
  data_ = make_effect_data(effects_arm_, m_.q, covariates, m_.has_rotation());
}

void ArmModel::gather_observations() {
  observations_.order = ranks_of(data_.order);
  observations_.timed = data_.has("time");
  observations_.replicate = selection::find_replicates(m_.q, kReplicateDistance);
  observations_.session = m_.station;
  if (data_.has("session")) observations_.session = numbered(data_.covariate("session").col(0));
  observations_.group = m_.point;
}

void ArmModel::gather_terms(const Effects& effects) {
  for (const auto& effect : effects) {
    std::vector<EffectVariant> variants = effect->variants(data_);
    std::erase_if(variants, [this](const EffectVariant& variant) { return is_too_wide(variant); });
    find_largest(*effect, variants);
    std::map<std::pair<int, std::string>, std::vector<int>> by_alias_group;
    for (EffectVariant& variant : variants) {
      by_alias_group[{variant.joint, variant.alias_group}].push_back(
          static_cast<int>(terms_.size()));
      terms_.push_back({variant.effect, variant.joint, variant.alias_group,
                        effect->describe(variant, nominal_), static_cast<double>(variants.size()),
                        has_whole_order(variant)});
      terms_.back().combinable = effect->info().combinable;
      terms_.back().continuous = variant.settings.contains("order") && !has_whole_order(variant);
      sources_.push_back({effect, std::move(variant), -1});
    }
    for (auto& [cause, family] : by_alias_group) {
      if (family.size() < kScanFrom) continue;
      for (std::size_t i = 0; i < family.size(); ++i) {
        neighbours_[family[i]] = {i > 0 ? family[i - 1] : -1,
                                  i + 1 < family.size() ? family[i + 1] : -1};
      }
      scans_.push_back(std::move(family));
    }
  }
  lack_of_fit_terms_ =
      make_lack_of_fit_terms(data_, m_.tracked ? tips_from_base() : Eigen::Matrix3Xd());
  contexts_ = make_contexts(data_, m_.tracked ? tips_from_base() : Eigen::Matrix3Xd(),
                            m_.tracked ? ranges() : Eigen::VectorXd());
  std::map<int, std::vector<int>> families;
  for (int p = 0; p < static_cast<int>(lack_of_fit_terms_.size()); ++p) {
    const LackOfFitTerm& about = lack_of_fit_terms_[p];
    if (about.family >= 0) families[about.family].push_back(static_cast<int>(terms_.size()));
    terms_.push_back({to_text(about.dependence), -1, "lack of fit " + about.description,
                      about.description, about.multiplicity});
    terms_.back().lack_of_fit = true;
    sources_.push_back({nullptr, {}, p});
  }
  for (auto& [number, family] : families) scans_.push_back(std::move(family));
}

bool ArmModel::is_too_wide(const EffectVariant& variant) {
  const auto wide = static_cast<double>(variant.parameters.size());
  if (wide <= kMaxShareOfDof * fit_.degrees_of_freedom) return false;
  const long left = std::max(0L, std::lround(fit_.degrees_of_freedom));
  const std::string text = variant.effect + " was not tried with " +
                           counted(static_cast<long>(variant.parameters.size()), "number") +
                           ": these data have " + counted(left, "equation") +
                           " more than unknowns, and it may use a quarter of them.";
  if (std::find(untried_.begin(), untried_.end(), text) == untried_.end()) {
    untried_.push_back(text);
  }
  return true;
}

std::vector<int> ArmModel::refine(int term) {
  const auto found = neighbours_.find(term);
  if (found == neighbours_.end()) return {};
  const int lower = found->second.first, upper = found->second.second;
  std::vector<int> chain;
  const auto add_between = [&](int from, int to) {
    if (from < 0 || to < 0) return;
    const Source here = sources_[term];
    for (EffectVariant& variant : here.effect->between(sources_[from].variant, sources_[to].variant,
                                                       record_ ? *record_ : data_)) {
      selection::Term about = terms_[term];
      about.description = here.effect->describe(variant, nominal_);
      about.preferred = has_whole_order(variant);
      about.continuous = variant.settings.contains("order") && !about.preferred;
      chain.push_back(static_cast<int>(terms_.size()));
      terms_.push_back(std::move(about));
      sources_.push_back({here.effect, std::move(variant), -1});
    }
  };
  if (lower >= 0) chain.push_back(lower);
  add_between(lower, term);
  chain.push_back(term);
  add_between(term, upper);
  if (upper >= 0) chain.push_back(upper);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (chain[i] == lower || chain[i] == upper) continue;
    neighbours_[chain[i]] = {i > 0 ? chain[i - 1] : -1, i + 1 < chain.size() ? chain[i + 1] : -1};
  }
  std::erase_if(chain, [&](int f) { return f == lower || f == upper || f == term; });
  if (!chain.empty() || terms_[term].continuous || terms_[term].preferred) return chain;
  // There is nothing between consecutive moments: the neighbours themselves.
  for (const bool below : {true, false}) {
    int at = term;
    for (int step = 0; step < kMomentsNear; ++step) {
      at = below ? neighbours_[at].first : neighbours_[at].second;
      if (at < 0) break;
      chain.push_back(at);
    }
  }
  return chain;
}

/// The scale of an effect without a plausible size is that of its columns: those that are nothing
/// next to its others, in any of its variants, would get values that mean nothing.
void ArmModel::find_largest(const Effect& effect, const std::vector<EffectVariant>& variants) {
  const EffectInfo info = effect.info();
  for (const EffectVariant& variant : variants) {
    const bool sized = std::all_of(
        variant.parameters.begin(), variant.parameters.end(),
        [&](const EffectParameter& p) { return std::isfinite(plausible_size(info, p)); });
    if (sized) continue;
    const auto perturbations = perturbations_of(effect, variant);
    for (std::size_t p = 0; p < perturbations.size(); ++p) {
      double& largest = largest_[&effect][variant.parameters[p].unit];
      for (const Perturbation& perturbation : perturbations[p]) {
        largest = std::max(largest, perturbation.values.norm());
      }
    }
  }
}

void ArmModel::silence(const Effect& effect, const EffectVariant& variant,
                       std::vector<std::vector<Perturbation>>& perturbations) const {
  const auto known = largest_.find(&effect);
  if (known == largest_.end()) return;
  for (std::size_t p = 0; p < perturbations.size(); ++p) {
    const auto largest = known->second.find(variant.parameters[p].unit);
    if (largest == known->second.end()) continue;
    for (Perturbation& perturbation : perturbations[p]) {
      if (perturbation.values.norm() < kNothing * largest->second) perturbation.values.setZero();
    }
  }
}

std::vector<std::vector<Perturbation>> ArmModel::perturbations_of(int term) const {
  const Source& source = sources_[term];
  if (source.lack_of_fit < 0) return perturbations_of(*source.effect, source.variant);
  std::vector<std::vector<Perturbation>> out;
  for (Perturbation& perturbation : lack_of_fit_terms_[source.lack_of_fit].perturbations())
    out.push_back({std::move(perturbation)});
  return out;
}

/// Prior standard deviation of a parameter, times the scale estimated for its family; `scale` of
/// its column is the basis where the effect gives no plausible size.
double ArmModel::prior_std(int term, std::size_t parameter, double scale) const {
  const Source& source = sources_[term];
  const auto learned = prior_scales_.find(family_of(term));
  const double scale_of_family = learned != prior_scales_.end() ? learned->second : 1.0;
  double size = std::numeric_limits<double>::infinity();
  if (source.effect) {
    size = plausible_size(source.effect->info(), source.variant.parameters[parameter]);
  }
  return scale_of_family * (std::isfinite(size) ? size : kPlausible * scale);
}

std::vector<Eigen::MatrixXd> ArmModel::columns(std::span<const int> terms) const {
  std::vector<ActingVariant> acting;
  for (const int term : terms) {
    EffectVariant variant = sources_[term].variant;
    std::vector<std::vector<Perturbation>> perturbations = perturbations_of(term);
    if (sources_[term].lack_of_fit >= 0) {
      variant.effect = terms_[term].description;
      for (std::size_t c = 0; c < perturbations.size(); ++c) {
        variant.parameters.push_back({std::to_string(c), "", 1.0});
      }
    }
    acting.push_back({std::move(variant), std::move(perturbations)});
  }
  std::vector<Eigen::MatrixXd> out;
  for (ParameterColumns& one : columns_of(std::move(acting))) {
    const int term = terms[out.size()];
    for (Index p = 0; p < one.scale.size(); ++p) {
      one.columns.col(p) *= prior_std(term, static_cast<std::size_t>(p), one.scale[p]);
    }
    out.push_back(std::move(one.columns));
  }
  return out;
}

std::vector<ArmModel::ParameterColumns> ArmModel::columns_of(
    std::vector<ActingVariant> acting) const {
  ArmParameters parameters = problem_.parameters;
  const auto before = static_cast<Index>(parameters.parameters.size());
  std::vector<Index> first{0};
  for (ActingVariant& one : acting) {
    add_effect(parameters, one.variant, std::move(one.perturbations));
    first.push_back(static_cast<Index>(parameters.parameters.size()) - before);
  }
  std::vector<int> wanted(static_cast<std::size_t>(first.back()));
  std::iota(wanted.begin(), wanted.end(), static_cast<int>(before));
  Eigen::VectorXd x = parameters.nominal();
  x.head(x_.size()) = x_;
  ArmResiduals system(parameters, m_, Criterion::kCentroid, false, problem_.system->num_threads());
  system.set_observation_weights(problem_.system->observation_weights());
  system.set_row_whitening(problem_.system->row_whitening());
  system.set_noise(problem_.system->noise(), x);
  system.set_joints(exact_);
  system.set_free(wanted);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(linearization_.residual.size(), first.back());
  all.topRows(system.data_rows()) = system.jacobian(x).topRows(system.data_rows());
  // A column in units of its scale moves tips by about a millimetre. One with hardly any of that in
  // the residuals was eliminated from them (a shift of a touched point), and the rest is rounding.
  const double ordinary = kOrdinaryMove / system.noise().position * std::sqrt(double(m_.rows()));
  Eigen::VectorXd scale(all.cols());
  for (Index c = 0; c < all.cols(); ++c) {
    scale[c] = parameters.parameters[static_cast<std::size_t>(before + c)].scale;
    if (all.col(c).norm() < kRounding * ordinary) {
      all.col(c).setZero();
    } else {
      all.col(c) /= scale[c];
    }
  }
  std::vector<ParameterColumns> out;
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const Index wide = first[i + 1] - first[i];
    out.push_back({all.middleCols(first[i], wide), scale.segment(first[i], wide)});
  }
  return out;
}

}  // namespace bathyal::diagnosis
