// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/selection/candidate_set.hpp"

namespace bathyal {

/// A member of the best set, and what could stand in its place.
struct Rival {
  int member = 0;     ///< of the set
  int instead = 0;    ///< another cause
  double odds = 0.0;  ///< likelihood with it, freedom counted, against that of the set
};

struct SetSearchOptions {
  int extensions = 12;         ///< of a set, by their quick score, that are judged
  std::size_t exchanges = 48;  ///< of a set, the same
  int most = 48;               ///< members
};

/// The best set of a pool's candidates by Pool::judge: sets grow by one, the best of each size are
/// kept (a beam, wide while sets are small), then the best of all is improved by adding, dropping
/// and exchanging members until nothing helps.
std::vector<int> find_best_set(const Pool& pool, const SetSearchOptions& options = {});

/// The second half of it alone, from `start`.
std::vector<int> improve_set(const Pool& pool, std::vector<int> start,
                             const SetSearchOptions& options = {});

/// The best one of each other cause in each member's place, likeliest first. Odds leave out how
/// many forms were tried: two that explain the same are told apart by none of that.
std::vector<Rival> find_rivals(const Pool& pool, const std::vector<int>& set);

}  // namespace bathyal
