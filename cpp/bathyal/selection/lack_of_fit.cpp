// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/lack_of_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bathyal/selection/decisions.hpp"
#include "bathyal/selection/internal/cross_validation.hpp"
#include "bathyal/selection/internal/grid_scan.hpp"
#include "bathyal/selection/internal/subset_search.hpp"

namespace bathyal::selection {
namespace {

constexpr int kMaxRounds = 4;
constexpr std::size_t kMaxLackOfFitTerms = 6;  ///< tested at once
constexpr std::size_t kMaxReplacements = 4;    ///< from which a search begins

bool contains(const std::vector<int>& terms, int term) {
  return std::find(terms.begin(), terms.end(), term) != terms.end();
}

std::vector<int> joined(std::vector<int> terms, const std::vector<int>& more) {
  terms.insert(terms.end(), more.begin(), more.end());
  return terms;
}

}  // namespace

std::vector<int> ActiveSet::all() const { return joined(terms, lack_of_fit); }

LackOfFitCheck::LackOfFitCheck(WorkingPoint& working_point, const std::vector<int>& candidates,
                               const Folds& folds, const Eigen::VectorXd& weights,
                               std::function<void()> check_stop)
    : working_point_(working_point),
      candidates_(candidates),
      folds_(folds),
      weights_(weights),
      check_stop_(std::move(check_stop)) {}

ActiveSet LackOfFitCheck::select(const std::vector<int>& terms) {
  ActiveSet active{terms, {}};
  for (int round = 0; round < kMaxRounds; ++round) {
    check_stop_();
    unplaced_ = significant(active);
    // So many terms approximate anything: structure is reported in addition to them.
    if (active.terms.size() > Decisions::kManyTerms) break;
    if (auto next = replaced(active)) {
      active = std::move(*next);
      continue;
    }
    const std::vector<int> tested = predictive(active, unplaced_);
    if (tested.empty()) break;
    std::erase_if(unplaced_, [&](int term) { return contains(tested, term); });
    const CandidateSet candidates =
        working_point_.candidate_set(joined(joined(candidates_, active.lack_of_fit), tested));
    const std::vector<int> set =
        active.all().empty() ? beam_search(candidates)
                             : stepwise_search(candidates, members_of(candidates, active.all()));
    ActiveSet next;
    for (const int term : terms_of(candidates, set)) {
      (working_point_.term(term).lack_of_fit ? next.lack_of_fit : next.terms).push_back(term);
    }
    if (next.lack_of_fit == active.lack_of_fit) break;
    if (next.terms != active.terms && !is_improvement(next, active)) {
      unplaced_ = joined(unplaced_, tested);
      break;
    }
    active = std::move(next);
  }
  return active;
}

std::vector<int> LackOfFitCheck::significant(const ActiveSet& active) const {
  std::vector<int> found;
  for (const LackOfFit& d : working_point_.lack_of_fit(working_point_.nuisance(active.all()))) {
    if (d.p > Decisions::kBeyondNoise || found.size() == kMaxLackOfFitTerms) break;
    found.push_back(d.term);
  }
  return found;
}

/// Names that only crowd around something else leave little; what they crowd around shows where
/// one term does better than all of them. Tried are all sets of selected terms; the best of each
/// lack-of-fit term, most first.
std::vector<Replacement> LackOfFitCheck::replacements(const ActiveSet& active) const {
  std::vector<int> asked;
  for (int term = 0; term < static_cast<int>(working_point_.model().terms().size()); ++term) {
    if (working_point_.term(term).lack_of_fit && !contains(active.lack_of_fit, term))
      asked.push_back(term);
  }
  const CandidateSet candidates = working_point_.candidate_set(active.all());
  const auto whole = candidates.evaluate(all_members(candidates));
  if (!whole || asked.empty()) return {};
  std::map<int, Replacement> best;
  const auto count = static_cast<unsigned>(active.terms.size());
  for (unsigned removed = 1; removed < (1u << count); ++removed) {
    check_stop_();
    std::vector<int> rest;
    for (unsigned i = 0; i < count; ++i) {
      if (!(removed >> i & 1u)) rest.push_back(active.terms[i]);
    }
    const std::vector<int> others = joined(rest, active.lack_of_fit);
    const auto fit = candidates.evaluate(members_of(candidates, others));
    if (!fit) continue;
    const NuisanceBasis& basis = working_point_.nuisance(others);
    for (const ScannedTerm& scanned : scan(working_point_.model(), asked, basis.basis,
                                           working_point_.model().linearization().residual,
                                           basis.dof, working_point_.num_threads())) {
      const double gain = fit->score + scanned.gain -
                          std::log(working_point_.term(scanned.term).multiplicity) - whole->score;
      if (!(gain > Decisions::kReplacementGain)) continue;
      const auto [place, fresh] = best.emplace(scanned.term, Replacement{scanned.term, rest, gain});
      if (!fresh && gain > place->second.gain) place->second = {scanned.term, rest, gain};
    }
  }
  std::vector<Replacement> out;
  for (auto& [term, replacement] : best) out.push_back(std::move(replacement));
  std::stable_sort(out.begin(), out.end(),
                   [](const Replacement& a, const Replacement& b) { return a.gain > b.gain; });
  if (out.size() > kMaxReplacements) out.resize(kMaxReplacements);
  return out;
}

/// The best set that begins with a replacement, where one predicts held-out rows better too.
std::optional<ActiveSet> LackOfFitCheck::replaced(const ActiveSet& active) {
  if (active.terms.empty()) return std::nullopt;
  const std::vector<Replacement> starts = replacements(active);
  if (starts.empty()) return std::nullopt;
  std::vector<int> tested;
  for (const Replacement& start : starts) tested.push_back(start.lack_of_fit);
  const CandidateSet candidates =
      working_point_.candidate_set(joined(joined(candidates_, active.lack_of_fit), tested));
  const auto now = candidates.evaluate(members_of(candidates, active.all()));
  if (!now) return std::nullopt;
  std::vector<int> best_set;
  double best = now->score;
  for (const Replacement& start : starts) {
    check_stop_();
    const std::vector<int> set = stepwise_search(
        candidates, members_of(candidates, joined(joined(start.rest, active.lack_of_fit),
                                                  {start.lack_of_fit})));
    const double score = candidates.evaluate(set)->score;
    if (score > best) {
      best = score;
      best_set = set;
    }
  }
  ActiveSet next;
  for (const int term : terms_of(candidates, best_set)) {
    (working_point_.term(term).lack_of_fit ? next.lack_of_fit : next.terms).push_back(term);
  }
  if (next.lack_of_fit.size() <= active.lack_of_fit.size() || !is_improvement(next, active))
    return std::nullopt;
  return next;
}

/// Lack-of-fit terms replace others only where they predict held-out rows, as those must.
std::vector<int> LackOfFitCheck::predictive(const ActiveSet& active,
                                            const std::vector<int>& lack_of_fit_terms) {
  const BlockCrossValidation held(working_point_, joined(active.all(), lack_of_fit_terms), folds_);
  const double without = held.log_predictive_density_of(active.all());
  std::vector<int> out;
  for (const int term : lack_of_fit_terms) {
    if (held.log_predictive_density_of(joined(active.all(), {term})) > without) out.push_back(term);
  }
  return out;
}

/// The gain of a search, made at one linearization, must persist after the fit; else the model is
/// restored.
bool LackOfFitCheck::is_improvement(const ActiveSet& next, const ActiveSet& active) {
  const double score = working_point_.score(active.all(), weights_);
  const double density = log_predictive_density(active.all());
  const auto checkpoint = working_point_.save();
  working_point_.fit(next.terms);
  if (working_point_.score(next.all(), weights_) > score &&
      log_predictive_density(next.all()) > density) {
    return true;
  }
  working_point_.restore(*checkpoint);
  return false;
}

/// Of held-out rows, comparable between working points.
double LackOfFitCheck::log_predictive_density(const std::vector<int>& terms) const {
  const BlockCrossValidation held(working_point_, terms, folds_);
  return held.log_predictive_density() - held.rows() * std::log(working_point_.model().noise());
}

std::vector<LackOfFit> LackOfFitCheck::remaining(const ActiveSet& active, bool refuted) const {
  std::vector<LackOfFit> out;
  std::vector<int> all = active.all();
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::vector<LackOfFit> there = working_point_.lack_of_fit(working_point_.nuisance(all));
    const auto next = std::find_if(there.begin(), there.end(), [&](const LackOfFit& d) {
      return d.p <= Decisions::kBeyondNoise &&
             (refuted || (contains(unplaced_, d.term) && d.gain > 0.0));
    });
    if (next == there.end()) break;
    out.push_back(*next);
    all.push_back(next->term);
  }
  return out;
}

}  // namespace bathyal::selection
