// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/lack_of_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bathyal/selection/internal/cross_validation.hpp"
#include "bathyal/selection/internal/subset_search.hpp"

namespace bathyal {
namespace {

constexpr int kMostRounds = 4;
constexpr std::size_t kMostProbes = 6;  ///< that are asked at once
constexpr std::size_t kManyNames = 6;

bool contains(const std::vector<int>& forms, int form) {
  return std::find(forms.begin(), forms.end(), form) != forms.end();
}

std::vector<int> joined(std::vector<int> forms, const std::vector<int>& more) {
  forms.insert(forms.end(), more.begin(), more.end());
  return forms;
}

}  // namespace

std::vector<int> Standing::all() const { return joined(names, probes); }

BeyondNames::BeyondNames(Vantage& vantage, const std::vector<int>& candidates, const Blocks& blocks,
                         const Eigen::VectorXd& trust, std::function<void()> still_at_it)
    : vantage_(vantage),
      candidates_(candidates),
      blocks_(blocks),
      trust_(trust),
      still_at_it_(std::move(still_at_it)) {}

Standing BeyondNames::look(const std::vector<int>& names) {
  Standing standing{names, {}};
  for (int round = 0; round < kMostRounds; ++round) {
    still_at_it_();
    without_place_ = beyond_noise(standing);
    // So many names describe more than they explain, and structure is told beside them.
    if (standing.names.size() > kManyNames) break;
    const std::vector<int> asked = foretelling(standing, without_place_);
    if (asked.empty()) break;
    std::erase_if(without_place_, [&](int form) { return contains(asked, form); });
    const Pool pool = vantage_.pool_of(joined(joined(candidates_, standing.probes), asked));
    const std::vector<int> set = standing.all().empty()
                                     ? find_best_set(pool)
                                     : improve_set(pool, members_of(pool, standing.all()));
    Standing next;
    for (const int form : forms_of(pool, set)) {
      (vantage_.form(form).probe ? next.probes : next.names).push_back(form);
    }
    if (next.probes == standing.probes) break;
    if (next.names != standing.names && !holds(next, standing)) {
      without_place_ = joined(without_place_, asked);
      break;
    }
    standing = std::move(next);
  }
  return standing;
}

std::vector<int> BeyondNames::beyond_noise(const Standing& standing) const {
  std::vector<int> probes;
  for (const Dependence& d : vantage_.dependences(vantage_.ground(standing.all()))) {
    if (d.p > kBeyondNoise || probes.size() == kMostProbes) break;
    probes.push_back(d.form);
  }
  return probes;
}

/// Structure takes the place of names only where it foretells, as they must.
std::vector<int> BeyondNames::foretelling(const Standing& standing,
                                          const std::vector<int>& probes) {
  const FormsHeldOut held(vantage_, joined(standing.all(), probes), blocks_);
  const double without = held.density_of(standing.all());
  std::vector<int> out;
  for (const int probe : probes) {
    if (held.density_of(joined(standing.all(), {probe})) > without) out.push_back(probe);
  }
  return out;
}

/// What a search promised must hold where the fit ends; else the subject returns.
bool BeyondNames::holds(const Standing& next, const Standing& standing) {
  const double score = vantage_.score_of(standing.all(), trust_);
  const double foretold = foretold_by(standing.all());
  const auto place = vantage_.place();
  vantage_.settle(next.names);
  if (vantage_.score_of(next.all(), trust_) > score && foretold_by(next.all()) > foretold) {
    return true;
  }
  vantage_.return_to(*place);
  return false;
}

/// ln of how likely held-out rows are, comparable from place to place.
double BeyondNames::foretold_by(const std::vector<int>& forms) const {
  const FormsHeldOut held(vantage_, forms, blocks_);
  return held.density() - held.rows() * std::log(vantage_.subject().noise());
}

std::vector<Dependence> BeyondNames::left_by(const Standing& standing, bool refuted) const {
  std::vector<Dependence> out;
  std::vector<int> all = standing.all();
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<Dependence> there = vantage_.dependences(vantage_.ground(all));
    const auto next = std::find_if(there.begin(), there.end(), [&](const Dependence& d) {
      return d.p <= kBeyondNoise && (refuted || (contains(without_place_, d.form) && d.gain > 0.0));
    });
    if (next == there.end()) break;
    out.push_back(*next);
    all.push_back(next->form);
  }
  return out;
}

}  // namespace bathyal
