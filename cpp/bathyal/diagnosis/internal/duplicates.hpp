// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/diagnosis/diagnose.hpp"

// Rows that duplicate another to the last digit, as a logger that is faster than its instrument
// writes them: no measurements of their own.

namespace bathyal::diagnosis {

/// For each row the row that it duplicates: the first that agrees in joint values, tool, station,
/// all covariates but time and session, and in what was measured (position and orientation, or the
/// touched point). Touches of planes are never duplicates.
std::vector<int> find_duplicates(const Tracked& tracked);
std::vector<int> find_duplicates(const Touches& touches);

/// Rows that duplicate no earlier one, ascending.
std::vector<int> distinct_rows(const std::vector<int>& of);

/// The data without duplicate rows.
Tracked without_duplicates(const Tracked& tracked, const std::vector<int>& of);
Touches without_duplicates(const Touches& touches, const std::vector<int>& of);

/// Expands the results by row from the data without duplicates to all rows, and adds a warning.
void expand_to_duplicates(const std::vector<int>& of, Diagnosis& diagnosis);

}  // namespace bathyal::diagnosis
