// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/base/error.hpp"

namespace bathyal {

inline void check_range(std::string_view name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  std::string expected("from ");
  expected.append(to_text(low)).append(" to ").append(to_text(high));
  throw_argument(name, expected, to_text(value));
}

/// What lies between the commas.
inline std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

[[noreturn]] inline void throw_field(std::string_view format, std::string_view expected,
                                     std::string_view got) {
  std::string text(format);
  text.append(": expected ").append(expected).append(", got '");
  throw Error(text.append(got.substr(0, 20)).append("'"));
}

/// A number of a whole field, leading blanks and a plus allowed. \throw Error that names `format`
inline double number_of(std::string_view format, std::string_view field, double low, double high) {
  std::string_view digits = field;
  while (!digits.empty() && digits.front() == ' ') digits.remove_prefix(1);
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  double value = 0.0;
  const char* last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  if (error != std::errc() || end != last || !(value >= low && value <= high)) {
    throw_field(format, "a number", field);
  }
  return value;
}

}  // namespace bathyal
