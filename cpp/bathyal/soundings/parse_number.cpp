// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/parse_number.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <limits>
#include <string>
#include <system_error>

namespace bathyal::number {
namespace {

__extension__ using Wide = unsigned __int128;

/// 5^k, moved left until its top bit is set.
struct ShiftedFive {
  std::uint64_t value;
  int shift;
};

constexpr std::array<ShiftedFive, 28> shifted_fives() {
  std::array<ShiftedFive, 28> fives{};
  std::uint64_t value = 1;
  for (ShiftedFive& five : fives) {
    const int shift = std::countl_zero(value);
    five = {value << shift, shift};
    value *= 5;
  }
  return fives;
}

constexpr std::array<ShiftedFive, 28> kFives = shifted_fives();

/// A value beyond the range of double: from_chars leaves it untouched, so zero and infinity are
/// told apart by the power of ten of the first digit that is not zero.
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

/// digits / 10^power = (digits / 5^power) / 2^power. The division of the digits, moved left as far
/// as they go, by 5^power, moved left likewise, gives a quotient of 63 or 64 bits; whether its
/// remainder is zero is all that rounding to the 53 bits of a double still needs to know.
double divide_exactly(std::uint64_t digits, int power) {
  const ShiftedFive& five = kFives[static_cast<std::size_t>(power)];
  const int shift = __builtin_clzll(digits);
  const Wide dividend = static_cast<Wide>(digits << shift) << 63U;
  auto quotient = static_cast<std::uint64_t>(dividend / five.value);
  // Sticky: below every bit that is kept. (% would divide once more.)
  if (static_cast<Wide>(quotient) * five.value != dividend) quotient |= 1U;
  // A conversion to double rounds to nearest, ties to even, and 63 or 64 bits leave at least ten
  // below the last one kept, so the sticky bit decides ties and nothing else. The scale is a power
  // of two, and the result is far from the ends of the range: nothing is rounded again.
  const int exponent = five.shift - shift - 63 - power;
  const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U);
  return static_cast<double>(quotient) * scale;
}

}  // namespace bathyal::number
