// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "bathyal/selection/decisions.hpp"
#include "bathyal/selection/internal/cross_validation.hpp"
#include "bathyal/selection/internal/subset_search.hpp"

namespace bathyal::selection {
namespace {

class StructureSelection {
 public:
  StructureSelection(Model& model, const SelectionOptions& options, const Progress& progress)
      : model_(model),
        options_(options),
        progress_(progress),
        working_point_(model, options.num_threads),
        selector_(working_point_, [this] { repeat_progress(); }) {
    std::set<std::string> effects;
    for (const Term& term : model_.terms()) {
      if (!term.lack_of_fit) effects.insert(term.effect);
    }
    effects_ = static_cast<double>(effects.size());
  }

  SelectionResult run(const Shortlist& shortlist);

 private:
  void report_progress(double done, const std::string& stage) {
    done_ = done;
    stage_ = stage;
    repeat_progress();
  }
  /// Within a long stage: the caller may want to stop.
  void repeat_progress() const {
    if (progress_) progress_(done_, stage_);
  }

  void select_explanation(const Shortlist& shortlist);
  VarianceComponentFit fitted(int component, const NuisanceBasis& whole, const Folds& folds) const;
  void whiten();
  void fit_variance_components();
  void drop_redundant_terms();
  void drop_unpredictive_terms();
  double p_value_of(const CandidateSet& candidates, int member, const SetFit& fit,
                    std::size_t i) const;
  void fill_held_out(const BlockCrossValidation& held, const HeldOutErrors& before);
  void fill_evidence();
  void add_lack_of_fit(const std::vector<LackOfFit>& forward);
  void test_remainder();
  void test_scatter(const NuisanceBasis& whole);
  void fill_alternatives();
  void fill_detectable();

  const Model& model_;
  const SelectionOptions& options_;
  const Progress& progress_;
  WorkingPoint working_point_;
  TermSelector selector_;
  double effects_;  ///< that could be selected
  ActiveSet active_;
  Eigen::VectorXd weights_;
  bool whitened_by_known_ = false;
  SelectionResult out_;
  double done_ = 0.0;
  std::string stage_;
};

void StructureSelection::select_explanation(const Shortlist& shortlist) {
  working_point_.set_observation_weights(Eigen::VectorXd::Ones(model_.observations().count()));
  working_point_.fit({});
  out_.base_noise = model_.noise();
  whitened_by_known_ = working_point_.whiten_by_known();
  out_.lack_of_fit_before = working_point_.lack_of_fit(working_point_.nuisance());
  report_progress(shortlist.terms.empty() ? 0.2 : 0.5, "looking for causes");
  const Selection best =
      shortlist.terms.empty() ? selector_.select() : selector_.select_from(shortlist);
  active_.terms = best.terms;
  weights_ = best.weights;
}

/// `component`, fitted to the rows as they are whitened.
VarianceComponentFit StructureSelection::fitted(int component, const NuisanceBasis& whole,
                                                const Folds& folds) const {
  VarianceComponent of_rows = model_.variance_components()[component];
  if (!out_.noise.empty()) of_rows.loads = model_.whitened(of_rows.loads);
  VarianceComponentFit fit = fit_variance_component(of_rows, model_.linearization(), whole.basis,
                                                    weights_, model_.noise(), folds);
  fit.term = component;
  return fit;
}

/// Whitens the rows by the components that were found; the selection is updated for that.
void StructureSelection::whiten() {
  Eigen::VectorXd ratios =
      Eigen::VectorXd::Zero(static_cast<Index>(model_.variance_components().size()));
  for (const VarianceComponentFit& fit : out_.noise) ratios[fit.term] = fit.ratio;
  working_point_.set_variance_ratios(ratios);
  working_point_.fit(active_.terms);
  const Selection again = selector_.reselect({active_.terms, weights_});
  active_.terms = again.terms;
  weights_ = again.weights;
}

/// A component that the record itself shows comes first; what is estimated is tested given it.
void StructureSelection::fit_variance_components() {
  const std::vector<VarianceComponent>& components = model_.variance_components();
  if (whitened_by_known_) {  // all are estimated anew, given the terms
    working_point_.set_variance_ratios(
        Eigen::VectorXd::Zero(static_cast<Index>(components.size())));
    working_point_.fit(active_.terms);
  }
  std::vector<int> order(components.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(),
                        [&](int f) { return components[f].known > 0.0; });
  std::erase_if(order, [&](int f) { return components[f].lack_of_fit; });
  for (const int f : order) {
    const NuisanceBasis& whole = working_point_.nuisance(active_.terms);
    VarianceComponentFit fit = fitted(f, whole, out_.folds);
    // A step that the record itself shows needs no evidence, only a share that matters. Where
    // residuals have structure, it is uneven too: then a component must be worth a term.
    const auto is_significant = [&] {
      const std::vector<LackOfFit> structure = working_point_.lack_of_fit(whole);
      return structure.empty() || structure.front().p > Decisions::kBeyondNoise
                 ? fit.p() <= Decisions::kBeyondNoise
                 : fit.gain > Decisions::kTermPenalty + complexity_penalty(1.0, 2.0 * fit.gain);
    };
    const bool named = components[f].known > 0.0 ? fit.share > Decisions::kMinKnownShare
                                                 : fit.held_out_gain > 0.0 && is_significant();
    if (!named) continue;
    // What the noise is made of without this component is a smaller part of it.
    const double others = 1.0 - fit.share;
    for (VarianceComponentFit& found : out_.noise) {
      fit.share *= 1.0 - found.share;
      found.ratio /= others;
    }
    out_.noise.push_back(fit);
    whiten();
  }
}

/// p-value of the `i`-th of a set given the others: by Fisher's F, corrected for the multiplicity
/// of its effect and for the number of effects.
double StructureSelection::p_value_of(const CandidateSet& candidates, int member, const SetFit& fit,
                                      std::size_t i) const {
  return std::min(1.0, candidates.term(member).multiplicity * effects_ *
                           f_tail(fit.f[i], fit.width[i], fit.dof));
}

/// A term may have been selected at the linearization of the search and be redundant at that of the
/// fit, or given structure found later.
void StructureSelection::drop_redundant_terms() {
  while (!active_.terms.empty()) {
    const CandidateSet candidates = working_point_.candidate_set(active_.all());
    std::vector<int> set = stepwise_search(candidates, all_members(candidates));
    // A term may help only because it lowers the value of another, and so its penalty.
    const auto fit = candidates.evaluate(set);
    std::size_t weakest = set.size();
    double p = Decisions::kMaxPValue;
    for (std::size_t i = 0; i < set.size(); ++i) {
      if (candidates.term(set[i]).lack_of_fit || !(p_value_of(candidates, set[i], *fit, i) > p))
        continue;
      weakest = i;
      p = p_value_of(candidates, set[i], *fit, i);
    }
    if (weakest < set.size()) set.erase(set.begin() + static_cast<std::ptrdiff_t>(weakest));
    std::vector<int> needed = terms_of(candidates, set);
    std::erase_if(needed, [this](int term) { return working_point_.term(term).lack_of_fit; });
    if (needed == active_.terms) return;
    active_.terms = needed;
    working_point_.fit(active_.terms);
  }
}

/// Position of a term that does not improve the prediction given the others, where there is one.
/// `before`: PRESS of the base model.
std::optional<std::size_t> find_unpredictive(const BlockCrossValidation& held, double before) {
  if (held.terms().empty()) return std::nullopt;
  const auto least = [&held](const auto& of_place) {
    std::vector<double> values;
    for (std::size_t i = 0; i < held.terms().size(); ++i) values.push_back(of_place(i));
    const auto at = std::min_element(values.begin(), values.end());
    return std::pair(*at, static_cast<std::size_t>(at - values.begin()));
  };
  const double with = held.log_predictive_density();
  const auto [gain, worst] =
      least([&](std::size_t i) { return with - held.log_predictive_density(i); });
  if (!(gain > 0.0)) return worst;
  if (held.press() < before) return std::nullopt;
  // Terms that compensate each other are each needed. The one whose removal lowers PRESS most is
  // what makes the prediction worse than that of the base model.
  return least([&](std::size_t i) { return held.press(i); }).second;
}

/// A term must improve the prediction of held-out rows.
void StructureSelection::drop_unpredictive_terms() {
  for (;;) {
    drop_redundant_terms();
    BlockCrossValidation held(working_point_, active_.terms, out_.folds);
    const std::size_t promised = held.terms().size();
    const HeldOutErrors before = held.errors_of_base();
    while (const auto place = find_unpredictive(held, before.by_fold.sum())) held.drop(*place);
    if (held.terms().size() == promised) {
      fill_held_out(held, before);
      return;
    }
    active_.terms = held.terms();
    std::sort(active_.terms.begin(), active_.terms.end());
    working_point_.fit(active_.terms);
  }
}

void StructureSelection::fill_held_out(const BlockCrossValidation& held,
                                       const HeldOutErrors& before) {
  const double squares = held.press();
  for (std::size_t i = 0; i < held.terms().size(); ++i) {
    SelectedTerm chosen;
    chosen.term = held.terms()[i];
    chosen.held_out_with = squares / held.rows();
    chosen.held_out_without = held.press(i) / held.rows();
    out_.terms.push_back(chosen);
  }
  const HeldOutErrors after = held.errors();
  out_.error_before = before.error;
  out_.error_after = after.error;
  out_.p_value = sign_flip_p(before.by_fold - after.by_fold);
}

void StructureSelection::fill_evidence() {
  const CandidateSet candidates = working_point_.candidate_set(active_.all());
  std::vector<int> named, everything;
  for (int m = 0; m < candidates.size(); ++m) {
    everything.push_back(m);
    if (!candidates.term(m).lack_of_fit) named.push_back(m);
  }
  const auto whole = candidates.evaluate(everything);
  const auto terms_only = candidates.evaluate(named);
  out_.base_squares = candidates.total();
  if (!whole || !terms_only) return;
  out_.dof = terms_only->dof;
  const auto width_of = [&](const std::vector<int>& members) {
    double width = 0.0;
    for (const int m : members) width += static_cast<double>(candidates.width(m));
    return width;
  };
  const double noise = whole->noise();
  out_.explained =
      std::max(candidates.total() - terms_only->residual_sum - width_of(named) * noise, 0.0);
  out_.unexplained = std::max(terms_only->residual_sum - whole->residual_sum -
                                  (width_of(everything) - width_of(named)) * noise,
                              0.0);
  const auto rows = static_cast<double>(model_.linearization().residual.size());
  for (std::size_t i = 0; i < everything.size(); ++i) {
    const int m = everything[i];
    const double width = whole->width[i], f = whole->f[i];
    const bool lack_of_fit = candidates.term(m).lack_of_fit;
    if (lack_of_fit) out_.lack_of_fit.push_back({candidates.term_index(m)});
    SelectedTerm& chosen = lack_of_fit ? out_.lack_of_fit.back()
                                       : *std::find_if(out_.terms.begin(), out_.terms.end(),
                                                       [&](const SelectedTerm& c) {
                                                         return c.term == candidates.term_index(m);
                                                       });
    chosen.f = f;
    chosen.width = width;
    chosen.explained = f * width * noise;
    chosen.size = std::sqrt(std::max(f * width - width, 0.0) / rows);
    chosen.p = p_value_of(candidates, m, *whole, i);
  }
}

/// Lack of fit given all of the active set.
void StructureSelection::add_lack_of_fit(const std::vector<LackOfFit>& forward) {
  const auto rows = static_cast<double>(model_.linearization().residual.size());
  for (const LackOfFit& d : forward) {
    SelectedTerm selected;
    selected.term = d.term;
    selected.explained = d.explained;
    selected.width = d.width;
    selected.size = d.size;
    selected.p = d.p;
    out_.lack_of_fit.push_back(selected);
    out_.unexplained += d.size * d.size * rows;
  }
}

/// Unexplained structure of any form, in addition to the terms that were found.
void StructureSelection::test_remainder() {
  std::vector<int> terms = active_.terms;
  for (const SelectedTerm& selected : out_.lack_of_fit) terms.push_back(selected.term);
  const NuisanceBasis& whole = working_point_.nuisance(terms);
  out_.autocorrelation =
      test_autocorrelation(model_, whole.basis, whole.dof, weights_, options_.num_threads);
  for (Autocorrelation& a : out_.autocorrelation)
    a.p = std::min(1.0, Decisions::kStructureTests * a.p);
  std::erase_if(out_.autocorrelation,
                [](const Autocorrelation& a) { return a.p > Decisions::kBeyondNoise; });
  out_.pure_error = test_pure_error(model_, whole.basis, whole.dof, weights_);
  out_.pure_error.p = std::min(1.0, Decisions::kStructureTests * out_.pure_error.p);
  test_scatter(whole);
  // Measures of the same.
  double more = out_.autocorrelation.empty() ? 0.0 : out_.autocorrelation.front().explained;
  if (out_.pure_error.p <= Decisions::kBeyondNoise)
    more = std::max(more, out_.pure_error.explained);
  if (!out_.scatter.empty()) more = std::max(more, out_.scatter.front().share * whole.dof);
  out_.unexplained += more;
}

/// Whether residuals scatter more where, and in the direction in which, something would move the
/// tip: a cause may change from one observation to the next with what the record does not have.
void StructureSelection::test_scatter(const NuisanceBasis& whole) {
  const std::vector<VarianceComponent>& components = model_.variance_components();
  const auto tests = static_cast<double>(std::ranges::count_if(
      components, [](const VarianceComponent& component) { return component.lack_of_fit; }));
  for (int f = 0; f < static_cast<int>(components.size()); ++f) {
    if (!components[f].lack_of_fit) continue;
    VarianceComponentFit fit = fitted(f, whole, {});
    fit.multiplicity = Decisions::kStructureTests * tests;
    if (fit.p() <= Decisions::kBeyondNoise) out_.scatter.push_back(fit);
  }
  std::ranges::stable_sort(out_.scatter,
                           [](const auto& a, const auto& b) { return a.gain > b.gain; });
}

void StructureSelection::fill_alternatives() {
  if (active_.terms.empty()) return;
  for (const int term : active_.terms) {
    selector_.add_candidate(term);
    selector_.add_kin(term);
  }
  const CandidateSet candidates = working_point_.candidate_set(selector_.candidates());
  for (const Alternative& alternative :
       find_alternatives(candidates, members_of(candidates, active_.terms))) {
    out_.alternatives.push_back({candidates.term_index(alternative.member),
                                 candidates.term_index(alternative.replacement), alternative.odds});
  }
}

/// Of a term with two columns among fifty: the size at which its evidence equals its penalty.
void StructureSelection::fill_detectable() {
  constexpr double kWidth = 2.0, kTrials = 50.0;
  const auto rows = static_cast<double>(model_.linearization().residual.size());
  double explained = 20.0;
  for (int round = 0; round < 50; ++round) {
    explained = 2.0 * (Decisions::kTermPenalty + std::log(kTrials) +
                       complexity_penalty(kWidth, explained / kWidth));
  }
  out_.detectable = std::sqrt(explained / rows);
}

SelectionResult StructureSelection::run(const Shortlist& shortlist) {
  report_progress(shortlist.terms.empty() ? 0.1 : 0.4, "testing the rigid model for lack of fit");
  const bool given = !options_.groups.empty();
  out_.folds =
      given ? folds_of_groups(options_.groups) : make_folds(model_.observations(), options_.folds);
  select_explanation(shortlist);
  fill_detectable();
  const NuisanceBasis& whole = working_point_.nuisance(active_.terms);
  out_.held_out = out_.folds.count >= (given ? Decisions::kMinGivenGroups : Decisions::kMinFolds) &&
                  whole.dof >= Decisions::kMinDof;
  if (!out_.held_out) {
    working_point_.fit({});
    active_.terms.clear();
    return std::move(out_);
  }
  fit_variance_components();
  report_progress(0.6, "testing for lack of fit");
  LackOfFitCheck check(working_point_, selector_.candidates(), out_.folds, weights_,
                       [this] { repeat_progress(); });
  active_ = check.select(active_.terms);
  report_progress(0.8, "measuring the gain");
  const std::vector<int> promised = active_.terms;
  drop_unpredictive_terms();
  fill_evidence();
  add_lack_of_fit(check.remaining(active_, active_.terms != promised));
  test_remainder();
  fill_alternatives();
  for (Index i = 0; i < weights_.size(); ++i) {
    if (!(weights_[i] > 0.0)) out_.outliers.push_back(static_cast<int>(i));
  }
  report_progress(1.0, "done");
  return std::move(out_);
}

}  // namespace

SelectionResult select_terms(Model& model, const SelectionOptions& options,
                             const Progress& progress, const Shortlist& shortlist) {
  return StructureSelection(model, options, progress).run(shortlist);
}

Shortlist shortlist_terms(Model& model, int num_threads, const Progress& progress) {
  WorkingPoint working_point(model, num_threads);
  working_point.set_observation_weights(Eigen::VectorXd::Ones(model.observations().count()));
  working_point.fit({});
  TermSelector selector(working_point, [&progress] {
    if (progress) progress(0.1, "looking for causes in a subset of the rows");
  });
  return selector.shortlist(selector.select().terms);
}

}  // namespace bathyal::selection
