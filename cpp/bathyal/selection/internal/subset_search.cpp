// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/subset_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>

#include "bathyal/base/parallel.hpp"
#include "bathyal/selection/decisions.hpp"

namespace bathyal::selection {
namespace {

struct Scored {
  std::vector<int> members;  ///< ascending
  double score;
};

std::vector<int> with(std::vector<int> members, int member) {
  members.insert(std::upper_bound(members.begin(), members.end(), member), member);
  return members;
}

std::vector<int> without(std::vector<int> members, std::size_t place) {
  members.erase(members.begin() + static_cast<std::ptrdiff_t>(place));
  return members;
}

/// The `count` members of highest approximate score; never those that cannot be added.
std::vector<int> best_of(const Eigen::VectorXd& scores, int count) {
  std::vector<int> order;
  for (int m = 0; m < static_cast<int>(scores.size()); ++m) {
    if (std::isfinite(scores[m])) order.push_back(m);
  }
  const auto better = [&](int a, int b) {
    return std::pair(-scores[a], a) < std::pair(-scores[b], b);
  };
  const auto end =
      order.begin() + std::min<std::ptrdiff_t>(count, static_cast<std::ptrdiff_t>(order.size()));
  std::partial_sort(order.begin(), end, order.end(), better);
  order.erase(end, order.end());
  return order;
}

/// Beam width: terms mask each other in small sets; in large ones the next one is clear.
std::size_t beam_width(std::size_t members) { return members < 4 ? 8 : members < 8 ? 3 : 1; }

/// Sets one member larger than those of `beam`, the best first.
std::vector<Scored> extended(const CandidateSet& candidates, const std::vector<Scored>& beam,
                             const SetSearchOptions& options) {
  std::vector<Scored> out;
  std::set<std::vector<int>> seen;
  for (const Scored& base : beam) {
    for (const int m : best_of(candidates.forward_scores(base.members), options.extensions)) {
      std::vector<int> members = with(base.members, m);
      if (!seen.insert(members).second) continue;
      if (const auto fit = candidates.evaluate(members))
        out.push_back({std::move(members), fit->score});
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  if (out.size() > beam_width(beam.front().members.size())) {
    out.erase(out.begin() + static_cast<std::ptrdiff_t>(beam_width(beam.front().members.size())),
              out.end());
  }
  return out;
}

constexpr int kAskedOfAliasGroup = 3;  ///< terms of a group that are evaluated in a member's place

/// By how much an approximate score may be too low: a member changes the others' penalties.
constexpr double kQuickScoreLacks = 6.0;

/// The best addition to `base`, or `best` where none exceeds it.
Scored best_addition(const CandidateSet& candidates, const std::vector<int>& base, Scored best,
                     const SetSearchOptions& options) {
  const Eigen::VectorXd scores = candidates.forward_scores(base);
  std::vector<int> asked = best_of(scores, options.extensions);
  std::erase_if(asked, [&](int m) { return scores[m] < best.score - kQuickScoreLacks; });
  std::vector<std::optional<SetFit>> fits(asked.size());
  parallel_for(asked.size(), 1, candidates.num_threads(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) fits[k] = candidates.evaluate(with(base, asked[k]));
  });
  for (std::size_t k = 0; k < asked.size(); ++k) {
    if (fits[k] && fits[k]->score > best.score) best = {with(base, asked[k]), fits[k]->score};
  }
  return best;
}

/// The best exchange of one member for a candidate, or `best` where none exceeds it.
Scored best_exchange(const CandidateSet& candidates, const std::vector<int>& members, Scored best,
                     const SetSearchOptions& options) {
  const Eigen::MatrixXd scores = candidates.exchange_scores(members);
  const double promising = best.score - kQuickScoreLacks;
  std::vector<std::pair<double, std::vector<int>>> trials_of_exchange;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Eigen::VectorXd own = scores.row(static_cast<Index>(i));
    for (const int m : best_of(own, options.extensions)) {
      if (own[m] < promising) break;
      trials_of_exchange.emplace_back(-own[m], with(without(members, i), m));
    }
  }
  std::stable_sort(trials_of_exchange.begin(), trials_of_exchange.end());
  if (trials_of_exchange.size() > options.exchanges) trials_of_exchange.resize(options.exchanges);
  std::vector<std::optional<SetFit>> fits(trials_of_exchange.size());
  parallel_for(trials_of_exchange.size(), 1, candidates.num_threads(),
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t k = begin; k < end; ++k)
                   fits[k] = candidates.evaluate(trials_of_exchange[k].second);
               });
  for (std::size_t k = 0; k < trials_of_exchange.size(); ++k) {
    if (fits[k] && fits[k]->score > best.score)
      best = {trials_of_exchange[k].second, fits[k]->score};
  }
  return best;
}

/// The best set one step away: an addition where one helps; else a removal or an exchange.
Scored best_step(const CandidateSet& candidates, const Scored& now,
                 const SetSearchOptions& options) {
  if (static_cast<int>(now.members.size()) < options.max_members) {
    Scored larger = best_addition(candidates, now.members, now, options);
    if (larger.score > now.score) return larger;
  }
  Scored best = now;
  std::map<std::string, int> alias_groups;
  const auto whole = candidates.evaluate(now.members);
  for (std::size_t i = 0; i < now.members.size(); ++i) {
    ++alias_groups[candidates.term(now.members[i]).alias_group];
    if (candidates.marginal_score(now.members, *whole, i) > kQuickScoreLacks) continue;
    std::vector<int> rest = without(now.members, i);
    const auto fit = candidates.evaluate(rest);
    if (fit && fit->score > best.score) best = {std::move(rest), fit->score};
  }
  best = best_exchange(candidates, now.members, std::move(best), options);
  // One wide member may span several of its alias group, and can be added to none of them.
  for (const auto& [alias_group, count] : alias_groups) {
    if (count < 2) continue;
    std::vector<int> without_kin = now.members;
    std::erase_if(without_kin,
                  [&, &kin = alias_group](int m) { return candidates.term(m).alias_group == kin; });
    best = best_addition(candidates, without_kin, std::move(best), options);
  }
  return best;
}

/// An independent subset: members that are collinear with those before them are dropped.
Scored independent_subset(const CandidateSet& candidates, const std::vector<int>& members) {
  if (const auto all = candidates.evaluate(members)) return {members, all->score};
  Scored out{{}, candidates.evaluate({})->score};
  for (const int m : members) {
    std::vector<int> longer = with(out.members, m);
    if (const auto fit = candidates.evaluate(longer)) out = {std::move(longer), fit->score};
  }
  return out;
}

}  // namespace

std::vector<int> stepwise_search(const CandidateSet& candidates, std::vector<int> start,
                                 const SetSearchOptions& options) {
  std::sort(start.begin(), start.end());
  Scored best = independent_subset(candidates, start);
  for (;;) {
    Scored next = best_step(candidates, best, options);
    if (!(next.score > best.score)) return best.members;
    best = std::move(next);
  }
}

std::vector<int> beam_search(const CandidateSet& candidates, const SetSearchOptions& options) {
  Scored best{{}, candidates.evaluate({})->score};
  std::vector<Scored> beam{best};
  // Two terms may mask each other: one size may be worse than the last before the next is better.
  int worse = 0;
  for (int size = 1; size <= options.max_members && !beam.empty() && worse < 2; ++size) {
    beam = extended(candidates, beam, options);
    if (beam.empty()) break;
    worse = beam.front().score > best.score ? 0 : worse + 1;
    if (worse == 0) best = beam.front();
  }
  return stepwise_search(candidates, best.members, options);
}

/// Log likelihood, less one for each column (Akaike 1974), of a fit to `rows` degrees of freedom of
/// the base model. An alternative is assessed by how well it fits: a parameter more makes it less
/// probable beforehand, and does not exclude it.
double fit_quality(const SetFit& fit, double rows) {
  double out = -0.5 * rows * std::log(fit.residual_sum);
  for (const int width : fit.width) out -= width;
  return out;
}

/// Descriptions of one curve are no alternatives of each other. A scale is another cause than a
/// wave, and where a joint hardly moves a wave of any whole order has its shape.
bool is_alternative(const CandidateSet& candidates, int other, int member) {
  const Term &a = candidates.term(other), &b = candidates.term(member);
  if (a.alias_group != b.alias_group) return true;
  return a.effect != b.effect && (!a.combinable || (a.preferred && !b.combinable)) &&
         candidates.share_outside(other, member) < Decisions::kSameShape;
}

std::vector<Alternative> find_alternatives(const CandidateSet& candidates,
                                           const std::vector<int>& set) {
  std::vector<Alternative> out;
  const auto all = candidates.evaluate(set);
  const Eigen::MatrixXd quick = candidates.exchange_scores(set);
  const auto multiplicity = [&](int m) { return std::log(candidates.term(m).multiplicity); };
  const auto quality = [&](const SetFit& fit) { return fit_quality(fit, candidates.dof()); };
  for (std::size_t i = 0; i < set.size(); ++i) {
    const std::vector<int> rest = without(set, i);
    const double own = all->score + multiplicity(set[i]);
    std::map<std::string, Alternative> best_of_alias_group;
    const Eigen::VectorXd scores = quick.row(static_cast<Index>(i));
    std::map<std::string, int> asked;
    for (const int m : best_of(scores, candidates.size())) {
      if (scores[m] + multiplicity(m) < own - Decisions::kMaxLogOddsDeficit) continue;
      const std::string& alias_group = candidates.term(m).alias_group;
      if (!is_alternative(candidates, m, set[i]) || ++asked[alias_group] > kAskedOfAliasGroup)
        continue;
      const auto fit = candidates.evaluate(with(rest, m));
      if (!fit) continue;
      // What helps as much in addition to the member as in its place explains something else.
      const auto both = candidates.evaluate(with(set, m));
      double best = quality(*all);
      if (both) best = std::max(best, quality(*both));
      const Alternative alternative{set[i], m, std::exp(std::min(quality(*fit) - best, 0.0))};
      const auto [place, fresh] = best_of_alias_group.emplace(alias_group, alternative);
      if (!fresh && alternative.odds > place->second.odds) place->second = alternative;
    }
    const std::size_t first = out.size();
    for (const auto& [alias_group, alternative] : best_of_alias_group) out.push_back(alternative);
    std::stable_sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                     [](const Alternative& a, const Alternative& b) { return a.odds > b.odds; });
  }
  return out;
}

}  // namespace bathyal::selection
