// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "bathyal/soundings/internal/digits.hpp"
#include "bathyal/soundings/internal/round_decimal.hpp"

namespace bathyal::soundings {

/// Bytes that must be readable behind any text that is parsed: digits are loaded eight at a time,
/// and the ends of fields are looked for in 64 bytes at once.
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

}  // namespace bathyal::soundings
