// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/diagnosis/diagnose.hpp"

// Rows that repeat another to the last digit, as a logger leaves them that is faster than its
// instrument: no measurements of their own. For use inside the room.

namespace bathyal {

/// For each row the row that it is a copy of: the first of the same tool at the same station with
/// the same joint values and the same measured position and orientation.
std::vector<int> find_copies(const Tracked& tracked);

/// Rows that are no copies.
Tracked without_copies(const Tracked& tracked, const std::vector<int>& of);

/// Makes what is told by row of the data without copies speak of all rows, and warns.
void spread_over_copies(const std::vector<int>& of, Diagnosis& diagnosis);

}  // namespace bathyal
