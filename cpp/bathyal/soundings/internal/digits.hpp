// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <cstdint>
#include <cstring>

/// Decimal digits, eight at a time: eight bytes of text in one word, the first the lowest.
namespace bathyal::soundings::number {

inline constexpr std::uint64_t kPowersOfTen[] = {1,      10,      100,      1000,     10000,
                                                 100000, 1000000, 10000000, 100000000};

/// The eight bytes at `p`, each less '0': what a digit is worth, or ten and more.
inline std::uint64_t load_digits(const char* p) {
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, p, 8);
  return bytes ^ 0x3030303030303030U;
}

/// The top bit of the first byte that is no digit; above it, anything. 0 where all are digits.
inline std::uint64_t find_non_digit(std::uint64_t values) {
  // 0x76 carries a value of ten or more into the byte's top bit, and perhaps on into later bytes.
  return ((values + 0x7676767676767676U) | values) & 0x8080808080808080U;
}

/// Number of digits (0 to 8) in front of the first byte that is none.
inline int count_digits(std::uint64_t values) {
  const std::uint64_t found = find_non_digit(values);
  return found == 0 ? 8 : __builtin_ctzll(found) >> 3;
}

/// The first `count` (1 to 8) of eight values, moved to the end, with zeros in front of them.
inline std::uint64_t align_digits(std::uint64_t values, int count) {
  return values << (64 - 8 * count);
}

/// The number that eight digits make.
inline std::uint64_t join_digits(std::uint64_t values) {
  values = (values * 10 + (values >> 8)) & 0x00ff00ff00ff00ffU;
  values = (values * 100 + (values >> 16)) & 0x0000ffff0000ffffU;
  return (values * 10000 + (values >> 32)) & 0xffffffffU;
}

struct TwoNumbers {
  std::uint64_t first;
  std::uint64_t second;
};

/// The numbers that twice eight digits make.
inline TwoNumbers join_digits(std::uint64_t first, std::uint64_t second) {
#if defined(__SSE2__)
  const __m128i digits = _mm_set_epi64x(static_cast<std::int64_t>(second),  //
                                        static_cast<std::int64_t>(first));
  const __m128i tens = _mm_mullo_epi16(_mm_and_si128(digits, _mm_set1_epi16(0xff)),  //
                                       _mm_set1_epi16(10));
  const __m128i pairs = _mm_add_epi16(tens, _mm_srli_epi16(digits, 8));
  const __m128i fours = _mm_madd_epi16(pairs, _mm_set1_epi32(100 | 1 << 16));
  const __m128i packed = _mm_packs_epi32(fours, fours);
  const __m128i eights = _mm_madd_epi16(packed, _mm_set1_epi32(10000 | 1 << 16));
  const auto both = static_cast<std::uint64_t>(_mm_cvtsi128_si64(eights));
  return {both & 0xffffffffU, both >> 32U};
#else
  return {join_digits(first), join_digits(second)};
#endif
}

}  // namespace bathyal::soundings::number
