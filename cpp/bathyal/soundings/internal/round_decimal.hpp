// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

/// From decimal digits and a power of ten to the nearest double, ties to even.
namespace bathyal::soundings::number {

__extension__ using Wide = unsigned __int128;

inline constexpr double kExactPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                          1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// 5^k as a divisor: digits / 10^k = digits / 5^k / 2^k.
struct Five {
  std::uint64_t value = 0;       ///< 5^k, moved left until its top bit is set
  std::uint64_t reciprocal = 0;  ///< 2^127 / value, rounded down
  int exponent = 0;              ///< 2^exponent makes up for both
};

inline constexpr int kMostFives = 27;  ///< 5^27 is the last power of five below 2^64

constexpr std::array<Five, kMostFives + 1> make_fives() {
  std::array<Five, kMostFives + 1> fives{};
  std::uint64_t power = 5;
  for (int k = 1; k <= kMostFives; ++k, power *= 5) {
    const int shift = std::countl_zero(power);
    const std::uint64_t value = power << shift;
    const auto reciprocal = static_cast<std::uint64_t>((Wide{1} << 127U) / value);
    fives[static_cast<std::size_t>(k)] = {value, reciprocal, shift - 63 - k};
  }
  return fives;
}

inline constexpr std::array<Five, kMostFives + 1> kFives = make_fives();

/// quotient · 2^exponent for a quotient with its bit 62 or 63 set, whose lowest bit is sticky: set
/// where any digit below it is not 0. Far from the ends of double's range.
inline double scale_quotient(std::uint64_t quotient, int exponent) {
  // One bit less lets it convert as a signed number. Of the 62 or 63 bits left, nine or more are
  // below the 53 that the conversion keeps, so the lowest one decides ties and nothing else; and
  // the scale is a power of two: nothing is rounded again.
  const auto half = static_cast<std::int64_t>(quotient >> 1U | (quotient & 1U));
  const auto biased = static_cast<std::uint64_t>(exponent + 1 + 1023);
  return static_cast<double>(half) * std::bit_cast<double>(biased << 52U);
}

/// digits / 10^power for any digits but 0 and power from 1 to 27, by long division.
double divide_exactly(std::uint64_t digits, int power);

/// The same, by a multiplication wherever that settles it.
inline double divide(std::uint64_t digits, int power) {
  const Five& five = kFives[static_cast<std::size_t>(power)];
  const int shift = std::countl_zero(digits);
  const auto quotient =
      static_cast<std::uint64_t>(Wide{digits << shift} * Wide{five.reciprocal} >> 64U);
  // The reciprocal is less than one too small, and the product is cut off: the true quotient lies
  // in [quotient, quotient + 2), and rounds as `quotient` and a bit does unless a tie lies there
  // too; ties are multiples of 512.
  if (((quotient + 1) & 0x1ffU) <= 1) return divide_exactly(digits, power);
  return scale_quotient(quotient | 1U, five.exponent - shift);
}

/// The same for what has `count` (1 to 16) digits, zeros in front and 0 included, and power from 1
/// to 8.
inline double divide_digits(std::uint64_t digits, int count, int power) {
  if (count == 16 && digits != 0) return divide(digits, power);
  // Two doubles that are exact make a quotient that is rounded once (Clinger 1990).
  return static_cast<double>(static_cast<std::int64_t>(digits)) / kExactPowers[power];
}

}  // namespace bathyal::soundings::number
