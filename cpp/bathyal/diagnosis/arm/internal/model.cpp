// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "bathyal/base/text.hpp"
#include "bathyal/diagnosis/arm/internal/descriptions.hpp"
#include "bathyal/diagnosis/arm/internal/quantisation_step.hpp"
#include "bathyal/identify/checks/run_checks.hpp"
#include "bathyal/identify/fit/fit_results.hpp"
#include "bathyal/identify/model/chain_derivatives.hpp"
#include "bathyal/identify/model/effect_parameters.hpp"
#include "bathyal/selection/folds.hpp"

namespace bathyal {
namespace {

constexpr double kTwins = 1e-3;          ///< [rad] or [m]: poses nearer than this are one pose
constexpr std::size_t kScanFrom = 9;     ///< so many forms of one cause of one effect are a scan
constexpr double kSeenDirection = 1e-5;  ///< of the largest singular value, per mm and mrad
constexpr double kOrdinaryMove = 1e-3;   ///< [m]
constexpr double kRounding = 1e-7;
constexpr int kMomentsNear = 8;       ///< on either side
constexpr double kPlausible = 100.0;  ///< of a parameter's scale, where nobody told
/// Of the equations more than unknowns, that one effect may use up: beyond a third, freedom that
/// explains nothing costs less than it seems to gain.
constexpr double kMostOfFreedom = 0.25;

std::vector<int> numbered(const Eigen::VectorXd& values) {
  std::map<double, int> known;
  for (const double value : values) known.emplace(value, 0);
  int next = 0;
  for (auto& [value, index] : known) index = next++;
  std::vector<int> out;
  for (const double value : values) out.push_back(known[value]);
  return out;
}

/// Of rows in their order in time, the place of each.
std::vector<int> places_of(const std::vector<int>& order) {
  std::vector<int> out(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) out[order[i]] = static_cast<int>(i);
  return out;
}

}  // namespace

ArmSubject::ArmSubject(const Arm& arm, const Measurement& measurement,
                       std::unique_ptr<const Measurement>&& own, const IdentifyOptions& options)
    : nominal_(arm),
      own_(std::move(own)),
      m_(measurement),
      problem_(arm, measurement, options),
      seen_(observe(*problem_.system, problem_.start)),
      fit_(arm),
      effects_arm_(arm) {
  if (problem_.drop_scale_prior(seen_.null_space))
    seen_ = observe(*problem_.system, problem_.start);
  start_ = search(problem_, seen_);
  fit_ = make_arm_fit(problem_, seen_, start_);
  effects_arm_ = fit_.arm;
  geometry_ = problem_.parameters.parameters.size();
  free_what_is_seen();
}

ArmSubject::ArmSubject(const Arm& arm, const Measurement& measurement, const Covariates& covariates,
                       const IdentifyOptions& options, const Effects& effects)
    : ArmSubject(arm, measurement, nullptr, options) {
  geometry_doubts_ = run_checks(measurement, *problem_.system, arm, fit_);
  gather_data(covariates);
  gather_units();
  gather_forms(effects);
  gather_noise_forms();
  evaluate_effects_at(x_);
  stand_at(x_);
}

/// All that the caller does not hold, along the directions that the data or priors see where the
/// search ended. What identification leaves to base and tool as superfluous in general need not be
/// so for an arm of special angles: columns that depend do no harm here.
void ArmSubject::free_what_is_seen() {
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
      numerical_rank(qr_factor(derivatives(x_), system.num_threads()), kSeenDirection);
  held_ = rank.directions.leftCols(rank.rank);
}

void ArmSubject::gather_data(const Covariates& covariates) {
  data_ = make_effect_data(effects_arm_, m_.q, covariates, m_.has_rotation());
}

void ArmSubject::gather_units() {
  units_.order = places_of(data_.order);
  units_.timed = data_.has("time");
  units_.twin = find_twins(m_.q, kTwins);
  units_.session = m_.station;
  if (data_.has("session")) units_.session = numbered(data_.covariate("session").col(0));
  units_.point = m_.point;
}

void ArmSubject::gather_noise_forms() {
  if (m_.tracked) {
    // Where the model has the tip: what was measured holds the very errors that are looked at.
    const std::vector<Vec3> world = tips();
    Eigen::MatrixXd loads(3 * m_.rows(), 3);
    for (Index i = 0; i < m_.rows(); ++i) {
      const double range = world[static_cast<std::size_t>(i)].norm();
      loads.middleRows<3>(3 * i) = std::sqrt(m_.weights[i]) * range * Eigen::Matrix3d::Identity();
    }
    noise_forms_.push_back(
        {"range_noise", "noise that grows with the range", "rate", "1", 1.0, std::move(loads)});
  }
  const double step = logged_step(m_.q, nominal_);
  if (!(step > 0.0)) return;
  Eigen::MatrixXd loads(3 * m_.rows(), m_.q.cols());
  const ChainDerivatives walk(problem_.parameters, x_, {});
  ChainFrames frames;
  Vec3 tip;
  for (Index i = 0; i < m_.rows(); ++i) {
    const double evenly = std::sqrt(m_.weights[i] / 12.0);  // over a step of 1
    loads.middleRows<3>(3 * i) =
        evenly * walk.joint_jacobian(m_.q.row(i).data(), i, m_.tool[i], m_.station[i], frames, tip);
  }
  noise_forms_.push_back(
      {"quantisation", "joint values logged in steps", "step", "rad", 1.0, std::move(loads)});
  noise_forms_.back().known = step;
}

void ArmSubject::gather_forms(const Effects& effects) {
  for (const auto& effect : effects) {
    std::vector<EffectVariant> variants = effect->variants(data_);
    std::erase_if(variants, [this](const EffectVariant& variant) { return is_too_wide(variant); });
    std::map<std::pair<int, std::string>, std::vector<int>> by_cause;
    for (EffectVariant& variant : variants) {
      by_cause[{variant.joint, variant.alias_group}].push_back(static_cast<int>(forms_.size()));
      forms_.push_back({variant.effect, variant.joint, variant.alias_group,
                        words_of(variant, nominal_), static_cast<double>(variants.size()),
                        has_whole_order(variant)});
      forms_.back().shares = effect->info().combinable;
      forms_.back().moves = variant.settings.contains("order") && !has_whole_order(variant);
      sources_.push_back({effect, std::move(variant), -1});
    }
    for (auto& [cause, family] : by_cause) {
      if (family.size() < kScanFrom) continue;
      for (std::size_t i = 0; i < family.size(); ++i) {
        neighbours_[family[i]] = {i > 0 ? family[i - 1] : -1,
                                  i + 1 < family.size() ? family[i + 1] : -1};
      }
      scans_.push_back(std::move(family));
    }
  }
  probes_ = make_probes(data_, m_.tracked ? tips_from_base() : Eigen::Matrix3Xd());
  std::map<int, std::vector<int>> families;
  for (int p = 0; p < static_cast<int>(probes_.size()); ++p) {
    const Probe& probe = probes_[p];
    if (probe.family >= 0) families[probe.family].push_back(static_cast<int>(forms_.size()));
    forms_.push_back({probe.against, -1, "probe " + probe.words, probe.words, probe.trials});
    forms_.back().probe = true;
    sources_.push_back({nullptr, {}, p});
  }
  for (auto& [number, family] : families) scans_.push_back(std::move(family));
}

bool ArmSubject::is_too_wide(const EffectVariant& variant) {
  const auto wide = static_cast<double>(variant.parameters.size());
  if (wide <= kMostOfFreedom * fit_.degrees_of_freedom) return false;
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

std::vector<int> ArmSubject::finer(int form) {
  const auto found = neighbours_.find(form);
  if (found == neighbours_.end()) return {};
  const int lower = found->second.first, upper = found->second.second;
  std::vector<int> chain;
  const auto add_between = [&](int from, int to) {
    if (from < 0 || to < 0) return;
    const Source here = sources_[form];
    for (EffectVariant& variant : here.effect->between(sources_[from].variant, sources_[to].variant,
                                                       record_ ? *record_ : data_)) {
      Form about = forms_[form];
      about.words = words_of(variant, nominal_);
      about.plain = has_whole_order(variant);
      about.moves = variant.settings.contains("order") && !about.plain;
      chain.push_back(static_cast<int>(forms_.size()));
      forms_.push_back(std::move(about));
      sources_.push_back({here.effect, std::move(variant), -1});
    }
  };
  if (lower >= 0) chain.push_back(lower);
  add_between(lower, form);
  chain.push_back(form);
  add_between(form, upper);
  if (upper >= 0) chain.push_back(upper);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (chain[i] == lower || chain[i] == upper) continue;
    neighbours_[chain[i]] = {i > 0 ? chain[i - 1] : -1, i + 1 < chain.size() ? chain[i + 1] : -1};
  }
  std::erase_if(chain, [&](int f) { return f == lower || f == upper || f == form; });
  if (!chain.empty() || forms_[form].moves || forms_[form].plain) return chain;
  // There is nothing between moments that follow one another: the next ones themselves.
  for (const bool below : {true, false}) {
    int at = form;
    for (int step = 0; step < kMomentsNear; ++step) {
      at = below ? neighbours_[at].first : neighbours_[at].second;
      if (at < 0) break;
      chain.push_back(at);
    }
  }
  return chain;
}

std::vector<std::vector<Perturbation>> ArmSubject::perturbations_of(int form) const {
  const Source& source = sources_[form];
  if (source.probe < 0) return perturbations_of(*source.effect, source.variant);
  std::vector<std::vector<Perturbation>> out;
  for (Perturbation& perturbation : probes_[source.probe].perturbations())
    out.push_back({std::move(perturbation)});
  return out;
}

/// Largest size of a parameter, as far as it has not been learned; `scale` is that of its column,
/// which tells where the effect's description does not.
double ArmSubject::plausible(int form, std::size_t parameter, double scale) const {
  const Source& source = sources_[form];
  const auto learned = sizes_.find(family_of(form));
  const double size = learned != sizes_.end() ? learned->second : 1.0;
  double told = std::numeric_limits<double>::infinity();
  if (source.effect) {
    told = plausible_size(source.effect->info(), source.variant.parameters[parameter]);
  }
  return size * (std::isfinite(told) ? told : kPlausible * scale);
}

std::vector<Eigen::MatrixXd> ArmSubject::columns(std::span<const int> forms) const {
  std::vector<ActingVariant> acting;
  for (const int form : forms) {
    EffectVariant variant = sources_[form].variant;
    std::vector<std::vector<Perturbation>> perturbations = perturbations_of(form);
    if (sources_[form].probe >= 0) {
      variant.effect = forms_[form].words;
      for (std::size_t c = 0; c < perturbations.size(); ++c) {
        variant.parameters.push_back({std::to_string(c), "", 1.0});
      }
    }
    acting.push_back({std::move(variant), std::move(perturbations)});
  }
  std::vector<Eigen::MatrixXd> out;
  for (ParameterColumns& one : columns_of(std::move(acting))) {
    const int form = forms[out.size()];
    for (Index p = 0; p < one.scale.size(); ++p) {
      one.columns.col(p) *= plausible(form, static_cast<std::size_t>(p), one.scale[p]);
    }
    out.push_back(std::move(one.columns));
  }
  return out;
}

std::vector<ArmSubject::ParameterColumns> ArmSubject::columns_of(
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
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(linearization_.misfit.size(), first.back());
  all.topRows(system.data_rows()) = system.jacobian(x).topRows(system.data_rows());
  // A column in units of its scale moves tips by about a millimetre. One that moves residuals by
  // next to nothing of that has been taken from them whole (a shift of a touched point), and what
  // is left of it is rounding.
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

std::vector<Vec3> ArmSubject::tips() const {
  std::vector<Vec3> tips;
  const ChainDerivatives walk(problem_.parameters, x_, {});
  ChainFrames frames;
  for (Index i = 0; i < m_.rows(); ++i) {
    tips.push_back(
        walk.tip(m_.q.row(i).data(), i, m_.tool[i], m_.station[i], frames, nullptr, nullptr, 0)
            .translation());
  }
  return tips;
}

Eigen::Matrix3Xd ArmSubject::tips_from_base() const {
  const std::vector<Vec3> world = tips();
  Eigen::Matrix3Xd out(3, m_.rows());
  for (Index i = 0; i < m_.rows(); ++i) {
    out.col(i) = fit_.bases[m_.station[i]].inverse() * world[static_cast<std::size_t>(i)];
  }
  return out;
}

}  // namespace bathyal
