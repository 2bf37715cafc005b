// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/set_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>

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
  const auto better = [&](int a, int b) { return std::pair(-scores[a], a) < std::pair(-scores[b], b); };
  const auto end = order.begin() + std::min<std::ptrdiff_t>(count, static_cast<std::ptrdiff_t>(order.size()));
  std::partial_sort(order.begin(), end, order.end(), better);
  order.erase(end, order.end());
  return order;
}

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
  if (out.size() > static_cast<std::size_t>(options.beam)) {
    out.erase(out.begin() + options.beam, out.end());
  }
  return out;
}

/// The best set that differs by one member dropped, or by one exchanged; `now` when none is better.
Scored improved(const Pool& pool, const Scored& now, const SetSearchOptions& options) {
  Scored best = now;
  const auto consider = [&](std::vector<int> members) {
    const auto fit = pool.judge(members);
    if (fit && fit->score > best.score) best = {std::move(members), fit->score};
  };
  for (std::size_t i = 0; i < now.members.size(); ++i) {
    const std::vector<int> rest = without(now.members, i);
    consider(rest);
    for (const int m : best_of(pool.scores_beside(rest), options.extensions)) consider(with(rest, m));
  }
  for (const int m : best_of(pool.scores_beside(now.members), options.extensions)) {
    consider(with(now.members, m));
  }
  return best;
}

}  // namespace

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
  for (;;) {
    Scored next = improved(pool, best, options);
    if (!(next.score > best.score)) return best.members;
    best = std::move(next);
  }
}

std::vector<Rival> find_rivals(const Pool& pool, const std::vector<int>& set) {
  std::vector<Rival> out;
  const auto all = pool.judge(set);
  const auto trials = [&](int m) { return std::log(pool.about(m).trials); };
  for (std::size_t i = 0; i < set.size(); ++i) {
    const std::vector<int> rest = without(set, i);
    const double own = all->score + trials(set[i]);
    std::map<std::string, Rival> best_of_cause;
    for (const int m : best_of(pool.scores_beside(rest), pool.size())) {
      const std::string& cause = pool.about(m).cause;
      if (cause == pool.about(set[i]).cause) continue;
      const auto fit = pool.judge(with(rest, m));
      if (!fit) continue;
      const Rival rival{set[i], m, std::exp(std::min(fit->score + trials(m) - own, 0.0))};
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
