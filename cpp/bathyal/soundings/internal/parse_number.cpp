// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/parse_number.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <system_error>

namespace bathyal::soundings::number {
namespace {

/// A value beyond the range of double: from_chars leaves it untouched, so zero and infinity are
/// distinguished by the power of ten of the first digit that is not zero.
double out_of_range(const std::string& text) {
  int exponent = 0;
  const std::size_t mark = text.find_first_of("eE");
  if (mark != std::string::npos) read_exponent(text.data() + mark, exponent);
  const std::string mantissa = text.substr(0, mark);
  const auto first = static_cast<std::ptrdiff_t>(mantissa.find_first_of("123456789"));
  const auto point = static_cast<std::ptrdiff_t>(std::min(mantissa.find('.'), mantissa.size()));
  return point - first + exponent > 0 ? std::numeric_limits<double>::infinity() : 0.0;
}

}  // namespace

double slow_value(const char* begin, const char* end, char decimal) {
  std::string text(begin, end);
  if (decimal != '.') std::replace(text.begin(), text.end(), decimal, '.');
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc::result_out_of_range ? out_of_range(text) : value;
}

}  // namespace bathyal::soundings::number
