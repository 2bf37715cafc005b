// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/term_selection.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "bathyal/selection/decisions.hpp"
#include "bathyal/selection/internal/grid_scan.hpp"
#include "bathyal/selection/internal/subset_search.hpp"
#include "bathyal/selection/outlier_test.hpp"

namespace bathyal::selection {
namespace {

constexpr int kMaxPasses = 6;  ///< of selection and fit
constexpr int kMaxScans = 4;   ///< in the first pass; later ones start from its result
constexpr int kPeaks = 4;      ///< of each scan that are refined
constexpr int kFinerRounds = 3;

}  // namespace

/// All library terms that are in no scan: those enter by their peaks.
TermSelector::TermSelector(WorkingPoint& working_point, std::function<void()> check_stop)
    : working_point_(working_point), check_stop_(std::move(check_stop)) {
  std::set<int> scanned;
  for (const std::vector<int>& family : working_point_.model().scans()) {
    scanned.insert(family.begin(), family.end());
  }
  for (int term = 0; term < static_cast<int>(working_point_.model().terms().size()); ++term) {
    if (!working_point_.term(term).lack_of_fit && !scanned.contains(term))
      candidates_.push_back(term);
  }
}

void TermSelector::add_candidate(int term) {
  if (std::find(candidates_.begin(), candidates_.end(), term) == candidates_.end()) {
    candidates_.push_back(term);
  }
}

/// Whether they are peaks of their scan or not.
void TermSelector::add_kin(int term) {
  const Term own = working_point_.term(term);
  if (own.combinable) return;
  const std::vector<Term>& all = working_point_.model().terms();
  for (int other = 0; other < static_cast<int>(all.size()); ++other) {
    if (all[other].preferred && all[other].alias_group == own.alias_group) add_candidate(other);
  }
}

/// The peaks of each scan given the active set.
void TermSelector::add_peaks(const NuisanceBasis& nuisance) {
  for (const std::vector<int>& family : working_point_.model().scans()) {
    if (working_point_.term(family.front()).lack_of_fit) continue;
    check_stop_();
    const std::vector<ScannedTerm> scanned = scan(working_point_.model(), family, nuisance.basis,
                                                  working_point_.model().linearization().residual,
                                                  nuisance.dof, working_point_.num_threads());
    for (const int term : peaks(scanned, kPeaks)) add_candidate(term);
  }
}

/// Refines the setting of each scanned term between the points of its grid. All are refined at
/// once, each given the others at their present settings; a step that does not improve the set is
/// undone.
std::vector<int> TermSelector::refined(std::vector<int> terms) {
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (refined_.insert(terms[i]).second) moving.push_back(i);
  }
  for (int round = 0; round < kFinerRounds && !moving.empty(); ++round) {
    check_stop_();
    std::vector<int> asked = terms;
    std::vector<std::vector<int>> near;
    for (const std::size_t i : moving) {
      near.push_back(working_point_.refine(terms[i]));
      asked.insert(asked.end(), near.back().begin(), near.back().end());
    }
    const CandidateSet candidates = working_point_.candidate_set(asked);
    std::vector<int> set = members_of(candidates, terms);
    const auto now = candidates.evaluate(set);
    if (!now) break;
    const auto value_of = [&](double score, int term) {
      return score + (working_point_.term(term).preferred ? Decisions::kPreferredBonus : 0.0);
    };
    double best = now->score;
    const Eigen::MatrixXd replacement = candidates.exchange_scores(set);
    std::vector<std::size_t> still;
    for (std::size_t k = 0; k < moving.size(); ++k) {
      int& term = terms[moving[k]];
      const auto place = std::find_if(set.begin(), set.end(),
                                      [&](int m) { return candidates.term_index(m) == term; });
      if (place == set.end()) continue;
      const Eigen::VectorXd scores = replacement.row(place - set.begin());
      int best_member = *place;
      double most = value_of(now->score, term);
      for (const int m : members_of(candidates, near[k])) {
        if (value_of(scores[m], candidates.term_index(m)) > most) {
          best_member = m;
          most = value_of(scores[m], candidates.term_index(m));
        }
      }
      if (best_member != *place) {
        const int old = std::exchange(*place, best_member);
        const auto moved = candidates.evaluate(set);
        if (moved &&
            value_of(moved->score, candidates.term_index(best_member)) > value_of(best, term)) {
          best = moved->score;
          term = candidates.term_index(best_member);
          refined_.insert(term);
        } else {
          *place = old;
        }
      }
      if (!near[k].empty() && !working_point_.term(term).preferred) still.push_back(moving[k]);
    }
    moving = still;
  }
  for (const int term : terms) add_candidate(term);
  std::sort(terms.begin(), terms.end());
  return terms;
}

/// Of several ways to describe one cause, the narrowest that scores nearly as well: a whole curve
/// is no better a name for a wave because chance bends it a little.
std::vector<int> TermSelector::simplified(std::vector<int> terms) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    check_stop_();
    const std::string alias_group = working_point_.term(terms[i]).alias_group;
    std::vector<int> rest = terms;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    const bool alone = std::none_of(rest.begin(), rest.end(), [&](int other) {
      return working_point_.term(other).alias_group == alias_group;
    });
    if (!alone) continue;
    std::vector<int> others;
    for (const std::vector<int>& family : working_point_.model().scans()) {
      const Term& first = working_point_.term(family.front());
      if (first.lack_of_fit || first.alias_group != alias_group) continue;
      const NuisanceBasis& nuisance = working_point_.nuisance(rest);
      const std::vector<ScannedTerm> scanned = scan(working_point_.model(), family, nuisance.basis,
                                                    working_point_.model().linearization().residual,
                                                    nuisance.dof, working_point_.num_threads());
      for (const int term : peaks(scanned, kPeaks)) others.push_back(term);
    }
    // The best of those, between the points of its grid.
    double best = -std::numeric_limits<double>::infinity();
    int simpler = -1;
    bool is_near = false;
    for (int round = 0; round <= kFinerRounds && !others.empty(); ++round) {
      std::vector<int> asked = terms;
      asked.insert(asked.end(), others.begin(), others.end());
      const CandidateSet candidates = working_point_.candidate_set(asked);
      const auto now = candidates.evaluate(members_of(candidates, terms));
      const std::vector<int> own = members_of(candidates, {terms[i]});
      if (!now || own.empty()) break;
      const int before = simpler;
      for (const int member : members_of(candidates, others)) {
        if (candidates.width(member) >= candidates.width(own.front())) continue;
        std::vector<int> with = rest;
        with.push_back(candidates.term_index(member));
        const auto fit = candidates.evaluate(members_of(candidates, with));
        if (!fit || !(fit->score > best)) continue;
        best = fit->score;
        simpler = candidates.term_index(member);
      }
      is_near = best > now->score - Decisions::kPreferredBonus;
      if (simpler == before) break;
      others = working_point_.refine(simpler);
    }
    if (is_near) terms[i] = simpler;
  }
  return terms;
}

std::vector<int> TermSelector::best_terms(std::vector<int> start, int scans) {
  std::vector<int> terms = std::move(start);
  for (int round = 0; round < std::max(scans, 1); ++round) {
    check_stop_();
    const CandidateSet candidates = working_point_.candidate_set(candidates_);
    const std::vector<int> set = terms.empty()
                                     ? beam_search(candidates)
                                     : stepwise_search(candidates, members_of(candidates, terms));
    const bool same = terms == terms_of(candidates, set);
    terms = terms_of(candidates, set);
    if (terms.empty() || (same && round > 0)) break;
    if (scans == 0) break;
    const std::size_t known = candidates_.size();
    add_peaks(working_point_.nuisance(terms));
    if (candidates_.size() == known) break;
  }
  // A shortlist is simple already: no other terms are tried.
  if (scans > 0) terms = simplified(std::move(terms));
  return refined(std::move(terms));
}

/// Terms, then outliers: one step on from `now`, with which the model is fitted.
Selection TermSelector::next_selection(const Selection& now, int scans) {
  Selection next{best_terms(now.terms, scans), now.weights};
  working_point_.fit(next.terms);
  const NuisanceBasis& whole = working_point_.nuisance(next.terms);
  next.weights =
      exclude_outliers(working_point_.model().linearization(), whole.basis, now.weights, whole.dof);
  if (next.weights != now.weights) {
    working_point_.set_observation_weights(next.weights);
    working_point_.fit(next.terms);
  }
  return next;
}

/// Such steps until neither changes; returns the best of them, since they may cycle.
TermSelector::ScoredSelection TermSelector::search(Eigen::VectorXd weights) {
  Selection now{{}, std::move(weights)};
  working_point_.set_observation_weights(now.weights);
  working_point_.fit({});
  ScoredSelection best;
  int worse = 0;
  for (int pass = 0; pass < kMaxPasses && worse < 2; ++pass) {
    check_stop_();
    const Selection next = next_selection(now, now.terms.empty() ? kMaxScans : 1);
    const double score = working_point_.score(next.terms, next.weights);
    worse = pass == 0 || score > best.score + Decisions::kMinScoreGain ? 0 : worse + 1;
    if (pass == 0 || score > best.score) best = {next, score, working_point_.save()};
    const bool stays =
        next.weights == now.weights && (next.terms == now.terms || next.terms.empty());
    if (stays) break;
    now = next;
  }
  return best;
}

Selection TermSelector::select() {
  const Linearization& at = working_point_.model().linearization();
  const NuisanceBasis& base = working_point_.nuisance();
  add_peaks(base);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(working_point_.model().observations().count());
  const Eigen::VectorXd without_outliers = exclude_outliers(at, base.basis, all, base.dof);
  // Gross errors mask terms, and terms look like gross errors: both orders are tried.
  ScoredSelection best = search(all);
  if (without_outliers != all) {
    ScoredSelection other = search(without_outliers);
    if (other.score > best.score) best = std::move(other);
  }
  working_point_.restore(*best.checkpoint);
  return best.selection;
}

Selection TermSelector::select_from(const Shortlist& from) {
  candidates_ = from.candidates;
  // A setting that is not continuous (the moment of a slip) is refined again with more
  // observations.
  for (const int term : candidates_) {
    const Term& about = working_point_.term(term);
    if (about.continuous || about.preferred) refined_.insert(term);
  }
  const Selection found{from.terms,
                        Eigen::VectorXd::Ones(working_point_.model().observations().count())};
  working_point_.set_observation_weights(found.weights);
  working_point_.fit(found.terms);
  return next_selection(found, 0);
}

Shortlist TermSelector::shortlist(const std::vector<int>& terms) const {
  const CandidateSet candidates = working_point_.candidate_set(candidates_);
  const std::vector<int> set = members_of(candidates, terms);
  const auto now = candidates.evaluate(set);
  if (!now) return {terms, candidates_};
  const Eigen::VectorXd forward = candidates.forward_scores(set);
  const Eigen::MatrixXd replacement = candidates.exchange_scores(set);
  Shortlist out{terms, terms};
  for (int m = 0; m < candidates.size(); ++m) {
    const bool selected = std::find(set.begin(), set.end(), m) != set.end();
    const double best =
        set.empty() ? forward[m] : std::max(forward[m], replacement.col(m).maxCoeff());
    if (!selected && best > now->score - Decisions::kFarBehind)
      out.candidates.push_back(candidates.term_index(m));
  }
  return out;
}

}  // namespace bathyal::selection
