// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/selection/candidate_set.hpp"

namespace bathyal::selection {

/// A member of the best set, and a candidate that could take its place.
struct Alternative {
  int member = 0;       ///< of the set
  int replacement = 0;  ///< another cause
  double odds = 0.0;    ///< likelihood ratio to the set, complexity penalized
};

struct SetSearchOptions {
  int extensions = 12;         ///< of a set, by approximate score, that are evaluated
  std::size_t exchanges = 48;  ///< of a set, the same
  int max_members = 48;        ///< members
};

/// The best subset by CandidateSet::evaluate: a beam search over growing sets (wide while they are
/// small), then stepwise search from the best of all sizes.
std::vector<int> beam_search(const CandidateSet& candidates, const SetSearchOptions& options = {});

/// Adds, drops and exchanges members of `start` until no step improves the score.
std::vector<int> stepwise_search(const CandidateSet& candidates, std::vector<int> start,
                                 const SetSearchOptions& options = {});

/// The best candidate of each alias group that is another cause in each member's place, most likely
/// first. Odds leave out multiplicity, which cannot distinguish two terms that explain the same.
std::vector<Alternative> find_alternatives(const CandidateSet& candidates,
                                           const std::vector<int>& set);

}  // namespace bathyal::selection
