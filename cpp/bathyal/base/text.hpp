// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

// Numbers and lists formatted for people: reports and warnings of all rooms.

namespace bathyal {

/// "0.301 mm": three digits.
std::string millimetres(double metres);

/// "12.3 deg": three digits.
std::string degrees(double radians);

/// Three digits and the unit that reports use: mm for "m", deg for "rad".
std::string in_its_unit(double value, const std::string& unit);

std::string three_digits(double value);

/// "1 row", "3 rows": `many` when it is not the plain plural.
std::string counted(long count, const std::string& one, const std::string& many = "");

/// "a, b and c"; of more than `most` items the first ones "and 7 more".
std::string listed(const std::vector<std::string>& items, std::size_t most = 8);
std::string listed(const std::vector<int>& items, std::size_t most = 8);

}  // namespace bathyal
