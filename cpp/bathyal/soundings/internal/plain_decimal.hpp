// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "bathyal/soundings/internal/digits.hpp"
#include "bathyal/soundings/internal/round_decimal.hpp"

namespace bathyal::soundings {
namespace number {

/// Appends the `count` (1 to 8) digits at `p` to those of `whole`; false where they are not all
/// digits.
inline bool join_fraction(std::uint64_t whole, const char* p, int count, std::uint64_t& digits) {
  const std::uint64_t fraction = align_digits(load_digits(p), count);
  const auto [before, behind] = join_digits(whole, fraction);
  digits = before * kPowersOfTen[count] + behind;
  return find_non_digit(fraction) == 0;
}

/// The same for 9 to 16 digits; false also where the sum of all is 0.
inline bool join_long_fraction(std::uint64_t whole, const char* p, int count,
                               std::uint64_t& digits) {
  const std::uint64_t eight = load_digits(p);
  const std::uint64_t rest = align_digits(load_digits(p + 8), count - 8);
  const auto [before, behind] = join_digits(whole, eight);
  digits = (before * kPowersOfTen[8] + behind) * kPowersOfTen[count - 8] + join_digits(rest);
  return (find_non_digit(eight) | find_non_digit(rest)) == 0 && digits != 0;
}

}  // namespace number

/// Reads [begin, end) whole as a plain decimal, which is what surveys are made of: perhaps a minus,
/// one to eight digits, and perhaps the point with one to sixteen behind it, no more than nineteen
/// in all. The value is correctly rounded. False for any other text, a number or not. It needs no
/// loop and hardly a branch, and kTextPadding readable bytes behind `end`.
inline bool parse_plain_decimal(const char* begin, const char* end, char decimal, double& value) {
  const std::uint64_t negative = *begin == '-' ? 1 : 0;
  const char* const first = begin + negative;
  const std::uint64_t values = number::load_digits(first);
  const int whole_count = number::count_digits(values);
  if (whole_count == 0) return false;
  const std::uint64_t whole = number::align_digits(values, whole_count);
  const char* const point = first + whole_count;
  const std::ptrdiff_t count = end - point - 1;
  double magnitude = 0.0;
  std::uint64_t digits = 0;
  if (point == end) {
    magnitude = static_cast<double>(static_cast<std::int64_t>(number::join_digits(whole)));
  } else if (*point != decimal || count < 1 || count > 16) {
    return false;
  } else if (count <= 8) {
    const int places = static_cast<int>(count);
    if (!number::join_fraction(whole, point + 1, places, digits)) return false;
    magnitude = number::divide_digits(digits, whole_count + places, places);
  } else {
    const int places = static_cast<int>(count);
    if (whole_count + places > 19) return false;
    if (!number::join_long_fraction(whole, point + 1, places, digits)) return false;
    magnitude = number::divide(digits, places);
  }
  value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | negative << 63U);
  return true;
}

}  // namespace bathyal::soundings
