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

namespace bathyal {
namespace {

struct Scored {
  std::vector<int> members;  ///< rising
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

/// Members by falling quick score, at most `count`; those that are impossible never.
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

/// Sets that are kept: causes hide each other where there are few; where there are many the next
/// one is plain.
std::size_t beam_of(std::size_t members) { return members < 4 ? 8 : members < 8 ? 3 : 1; }

/// Sets one larger than those of `beam`, the best first.
std::vector<Scored> grown(const Pool& pool, const std::vector<Scored>& beam,
                          const SetSearchOptions& options) {
  std::vector<Scored> out;
  std::set<std::vector<int>> seen;
  for (const Scored& base : beam) {
    for (const int m : best_of(pool.scores_beside(base.members), options.extensions)) {
      std::vector<int> members = with(base.members, m);
      if (!seen.insert(members).second) continue;
      if (const auto fit = pool.judge(members)) out.push_back({std::move(members), fit->score});
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  if (out.size() > beam_of(beam.front().members.size())) {
    out.erase(out.begin() + static_cast<std::ptrdiff_t>(beam_of(beam.front().members.size())),
              out.end());
  }
  return out;
}

/// Rivals less likely than e to minus this are not told.
constexpr double kLeastOdds = 20.0;
constexpr int kAskedOfCause = 3;  ///< forms of one cause that are judged in a member's place

/// What a quick score may lack of the true one: others' costs change with a member.
constexpr double kQuickScoreLacks = 6.0;

/// The best one that `scores` (of additions to `base`) promise to be better than `best`.
Scored better_of(const Pool& pool, const std::vector<int>& base, Scored best,
                 const SetSearchOptions& options) {
  const Eigen::VectorXd scores = pool.scores_beside(base);
  std::vector<int> asked = best_of(scores, options.extensions);
  std::erase_if(asked, [&](int m) { return scores[m] < best.score - kQuickScoreLacks; });
  std::vector<std::optional<SetFit>> fits(asked.size());
  parallel_for(asked.size(), 1, pool.num_threads(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) fits[k] = pool.judge(with(base, asked[k]));
  });
  for (std::size_t k = 0; k < asked.size(); ++k) {
    if (fits[k] && fits[k]->score > best.score) best = {with(base, asked[k]), fits[k]->score};
  }
  return best;
}

/// The best exchange of one member for another, where one is better than `best`.
Scored exchanged(const Pool& pool, const std::vector<int>& members, Scored best,
                 const SetSearchOptions& options) {
  const Eigen::MatrixXd scores = pool.scores_instead(members);
  const double promising = best.score - kQuickScoreLacks;
  std::vector<std::pair<double, std::vector<int>>> worth;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Eigen::VectorXd own = scores.row(static_cast<Index>(i));
    for (const int m : best_of(own, options.extensions)) {
      if (own[m] < promising) break;
      worth.emplace_back(-own[m], with(without(members, i), m));
    }
  }
  std::stable_sort(worth.begin(), worth.end());
  if (worth.size() > options.exchanges) worth.resize(options.exchanges);
  std::vector<std::optional<SetFit>> fits(worth.size());
  parallel_for(worth.size(), 1, pool.num_threads(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) fits[k] = pool.judge(worth[k].second);
  });
  for (std::size_t k = 0; k < worth.size(); ++k) {
    if (fits[k] && fits[k]->score > best.score) best = {worth[k].second, fits[k]->score};
  }
  return best;
}

/// The best set that differs by one member: added, where that helps; else dropped or exchanged.
Scored improved(const Pool& pool, const Scored& now, const SetSearchOptions& options) {
  if (static_cast<int>(now.members.size()) < options.most) {
    Scored larger = better_of(pool, now.members, now, options);
    if (larger.score > now.score) return larger;
  }
  Scored best = now;
  std::map<std::string, int> causes;
  const auto whole = pool.judge(now.members);
  for (std::size_t i = 0; i < now.members.size(); ++i) {
    ++causes[pool.about(now.members[i]).cause];
    if (pool.worth(now.members, *whole, i) > kQuickScoreLacks) continue;
    std::vector<int> rest = without(now.members, i);
    const auto fit = pool.judge(rest);
    if (fit && fit->score > best.score) best = {std::move(rest), fit->score};
  }
  best = exchanged(pool, now.members, std::move(best), options);
  // One wide member may be all that several of its cause are, and fits none of them beside it.
  for (const auto& [cause, count] : causes) {
    if (count < 2) continue;
    std::vector<int> without_kin = now.members;
    std::erase_if(without_kin, [&, &kin = cause](int m) { return pool.about(m).cause == kin; });
    best = better_of(pool, without_kin, std::move(best), options);
  }
  return best;
}

/// The members that can stand together: where one is made of those before it, it goes.
Scored independent_of(const Pool& pool, const std::vector<int>& members) {
  if (const auto all = pool.judge(members)) return {members, all->score};
  Scored out{{}, pool.judge({})->score};
  for (const int m : members) {
    std::vector<int> longer = with(out.members, m);
    if (const auto fit = pool.judge(longer)) out = {std::move(longer), fit->score};
  }
  return out;
}

}  // namespace

std::vector<int> improve_set(const Pool& pool, std::vector<int> start,
                             const SetSearchOptions& options) {
  std::sort(start.begin(), start.end());
  Scored best = independent_of(pool, start);
  for (;;) {
    Scored next = improved(pool, best, options);
    if (!(next.score > best.score)) return best.members;
    best = std::move(next);
  }
}

std::vector<int> find_best_set(const Pool& pool, const SetSearchOptions& options) {
  Scored best{{}, pool.judge({})->score};
  std::vector<Scored> beam{best};
  // Two causes may hide each other: one size may be worse than the last before the next is better.
  int worse = 0;
  for (int size = 1; size <= options.most && !beam.empty() && worse < 2; ++size) {
    beam = grown(pool, beam, options);
    if (beam.empty()) break;
    worse = beam.front().score > best.score ? 0 : worse + 1;
    if (worse == 0) best = beam.front();
  }
  return improve_set(pool, best.members, options);
}

std::vector<Rival> find_rivals(const Pool& pool, const std::vector<int>& set) {
  std::vector<Rival> out;
  const auto all = pool.judge(set);
  const Eigen::MatrixXd quick = pool.scores_instead(set);
  const auto trials = [&](int m) { return std::log(pool.about(m).trials); };
  for (std::size_t i = 0; i < set.size(); ++i) {
    const std::vector<int> rest = without(set, i);
    const double own = all->score + trials(set[i]);
    std::map<std::string, Rival> best_of_cause;
    const Eigen::VectorXd scores = quick.row(static_cast<Index>(i));
    std::map<std::string, int> asked;
    for (const int m : best_of(scores, pool.size())) {
      if (scores[m] + trials(m) < own - kLeastOdds) continue;
      const std::string& cause = pool.about(m).cause;
      if (cause == pool.about(set[i]).cause || ++asked[cause] > kAskedOfCause) continue;
      const auto fit = pool.judge(with(rest, m));
      if (!fit) continue;
      // What helps as much beside the member as in its place stands for something else.
      const auto both = pool.judge(with(set, m));
      const double best = std::max(own, both ? both->score + trials(m) + trials(set[i]) : own);
      const Rival rival{set[i], m, std::exp(std::min(fit->score + trials(m) - best, 0.0))};
      const auto [place, fresh] = best_of_cause.emplace(cause, rival);
      if (!fresh && rival.odds > place->second.odds) place->second = rival;
    }
    const std::size_t first = out.size();
    for (const auto& [cause, rival] : best_of_cause) out.push_back(rival);
    std::stable_sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                     [](const Rival& a, const Rival& b) { return a.odds > b.odds; });
  }
  return out;
}

}  // namespace bathyal
