// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "bathyal/soundings/digits.hpp"
#include "bathyal/soundings/round_decimal.hpp"

namespace bathyal {

/// Bytes that must be readable behind any text given to parse_number: it loads eight at a time.
inline constexpr std::size_t kTextPadding = 64;

namespace number {

/// The digits of a decimal number as a whole number, and the power of ten it is multiplied by.
struct Decimal {
  std::uint64_t digits = 0;
  int exponent = 0;
  int count = 0;  ///< how many digits were read, leading zeros included
};

/// digits · 10^exponent, correctly rounded, for any text [begin, end) that is a decimal number.
double slow_value(const char* begin, const char* end, char decimal);

inline const char* read_digits(const char* p, Decimal& number) {
  while (true) {
    const std::uint64_t values = load_digits(p);
    const int count = count_digits(values);
    if (count == 0) return p;
    number.digits = number.digits * kPowersOfTen[count] + join_digits(align_digits(values, count));
    number.count += count;
    p += count;
    if (count < 8) return p;
  }
}

/// Reads e±dd at `p`; nullptr where no digit follows. Beyond ±99999 the value is 0 or infinite
/// whatever the digits say, so larger exponents are held there.
inline const char* read_exponent(const char* p, int& exponent) {
  ++p;
  const bool negative = *p == '-';
  if (*p == '-' || *p == '+') ++p;
  if (*p < '0' || *p > '9') return nullptr;
  int value = 0;
  for (; *p >= '0' && *p <= '9'; ++p) {
    if (value < 100000) value = 10 * value + (*p - '0');
  }
  exponent += negative ? -value : value;
  return p;
}

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

/// Reads a decimal number (sign, digits, `decimal`, digits, e±dd) at `begin` and returns where it
/// ends, or nullptr when there is none. The value is correctly rounded. The text must be followed
/// by something that is no part of a number within its buffer, and by kTextPadding readable bytes.
inline const char* parse_number(const char* begin, char decimal, double& value) {
  const char* p = begin;
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  const char* const unsigned_begin = p;
  number::Decimal number;
  p = number::read_digits(p, number);
  if (*p == decimal) {
    const char* const fraction = ++p;
    p = number::read_digits(p, number);
    number.exponent = static_cast<int>(fraction - p);
    // "12, 13" is no place to take the comma for a decimal one.
    if (number.exponent == 0 && decimal != '.') return nullptr;
  }
  if (number.count == 0) return nullptr;
  if ((*p | 0x20) == 'e') {
    p = number::read_exponent(p, number.exponent);
    if (p == nullptr) return nullptr;
  }
  double magnitude = 0.0;
  if (number.count <= 19 && number.digits < (std::uint64_t{1} << 53U) && number.exponent >= -22 &&
      number.exponent <= 22) {
    // Both operands are exact doubles, so one rounding makes the result (Clinger 1990).
    magnitude = static_cast<double>(number.digits);
    if (number.exponent < 0) {
      magnitude /= number::kExactPowers[-number.exponent];
    } else {
      magnitude *= number::kExactPowers[number.exponent];
    }
  } else if (number.count <= 19 && number.digits != 0 && number.exponent < 0 &&
             number.exponent >= -number::kMostFives) {
    magnitude = number::divide(number.digits, -number.exponent);
  } else {
    magnitude = number::slow_value(unsigned_begin, p, decimal);
  }
  value = negative ? -magnitude : magnitude;
  return p;
}

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

}  // namespace bathyal
