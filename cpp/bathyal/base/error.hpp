// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace bathyal {

/// A broken file, a solver that failed, a part that is not installed: not the caller's mistake.
/// Python sees it as `bathyal.Error`.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws std::invalid_argument (Python: `ValueError`) with the text
/// "`name`: expected <expected>, got <got>". Every caller's mistake is reported by this function.
[[noreturn]] void throw_argument(std::string_view name, std::string_view expected,
                                 std::string_view got);

/// Throws Error with the text "name:line: why": what is wrong in a line of a file, counted from 1.
[[noreturn]] void throw_at(std::string_view name, std::ptrdiff_t line, std::string_view why);

/// A number as a person would write it: shortest text that reads back as the same double.
std::string to_text(double value);

}  // namespace bathyal
