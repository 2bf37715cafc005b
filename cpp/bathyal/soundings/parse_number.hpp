// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>

namespace bathyal {

/// Bytes that must be readable behind any text given to parse_number: it loads eight at a time.
inline constexpr std::size_t kTextPadding = 16;

namespace number {

/// The digits of a decimal number as a whole number, and the power of ten it is multiplied by.
struct Decimal {
  std::uint64_t digits = 0;
  int exponent = 0;
  int count = 0;  ///< how many digits were read, leading zeros included
};

/// digits · 10^exponent, correctly rounded, for any text [begin, end) that is a decimal number.
double slow_value(const char* begin, const char* end, char decimal);

/// digits / 10^power, correctly rounded, for 0 < digits and power from 1 to 27.
double divide_exactly(std::uint64_t digits, int power);

/// Number of leading digits (0 to 8) among the eight bytes at `p`, and their values, one a byte.
inline int leading_digits(const char* p, std::uint64_t& values) {
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, p, 8);
  values = bytes ^ 0x3030303030303030U;
  // 0x76 carries a value of ten or more into the byte's top bit; what that does to later bytes
  // does not matter, because only the first one that is no digit is asked for.
  const std::uint64_t other = ((values + 0x7676767676767676U) | values) & 0x8080808080808080U;
  return other == 0 ? 8 : __builtin_ctzll(other) >> 3;
}

/// The number that the first `count` (1 to 8) digit values make.
inline std::uint64_t join_digits(std::uint64_t values, int count) {
  values <<= 64 - 8 * count;  // right-aligned: what is missing in front becomes zeros
  values = (values * 10 + (values >> 8)) & 0x00ff00ff00ff00ffU;
  values = (values * 100 + (values >> 16)) & 0x0000ffff0000ffffU;
  return (values * 10000 + (values >> 32)) & 0xffffffffU;
}

inline constexpr std::uint64_t kPowersOfTen[] = {1,      10,      100,      1000,     10000,
                                                 100000, 1000000, 10000000, 100000000};
inline constexpr double kExactPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                          1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

inline const char* read_digits(const char* p, Decimal& number) {
  while (true) {
    std::uint64_t values = 0;
    const int count = leading_digits(p, values);
    if (count == 0) return p;
    number.digits = number.digits * kPowersOfTen[count] + join_digits(values, count);
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
             number.exponent >= -27) {
    magnitude = number::divide_exactly(number.digits, -number.exponent);
  } else {
    magnitude = number::slow_value(unsigned_begin, p, decimal);
  }
  value = negative ? -magnitude : magnitude;
  return p;
}

}  // namespace bathyal
