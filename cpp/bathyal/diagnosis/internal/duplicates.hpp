// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/diagnosis/diagnose.hpp"

// Rows that repeat another to the last digit, as a logger leaves them that is faster than its
// instrument: no measurements of their own. For use inside the room.

namespace bathyal::diagnosis {

/// For each row the row that it is a copy of: the first that agrees in joint values, tool, station,
/// all that was recorded beside but time and session, and what was measured (position and
/// orientation, or the point that was touched). Touches of planes are no copies.
std::vector<int> find_duplicates(const Tracked& tracked);
std::vector<int> find_duplicates(const Touches& touches);

/// Rows that are no copies.
Tracked without_duplicates(const Tracked& tracked, const std::vector<int>& of);
Touches without_duplicates(const Touches& touches, const std::vector<int>& of);

/// Makes what is told by row of the data without copies speak of all rows, and warns.
void expand_to_duplicates(const std::vector<int>& of, Diagnosis& diagnosis);

}  // namespace bathyal::diagnosis
