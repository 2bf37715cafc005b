// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace bathyal::soundings {

/// Bytes that must be readable behind a text whose field ends are looked for: it is looked at so
/// many at a time.
inline constexpr std::size_t kFieldBlock = 64;

/// One bit for each of the 64 bytes at `p`, the first the lowest: whether it is a, b or c.
inline std::uint64_t find_bytes(const char* p, char a, char b, char c) {
  std::uint64_t found = 0;
#if defined(__SSE2__)
  for (int i = 0; i < 4; ++i) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p) + i);
    const __m128i is_a = _mm_cmpeq_epi8(bytes, _mm_set1_epi8(a));
    const __m128i is_b = _mm_cmpeq_epi8(bytes, _mm_set1_epi8(b));
    const __m128i is_c = _mm_cmpeq_epi8(bytes, _mm_set1_epi8(c));
    const int any = _mm_movemask_epi8(_mm_or_si128(_mm_or_si128(is_a, is_b), is_c));
    found |= static_cast<std::uint64_t>(any) << (16 * i);
  }
#else
  for (int i = 0; i < 64; ++i) {
    found |= static_cast<std::uint64_t>(p[i] == a || p[i] == b || p[i] == c) << i;
  }
#endif
  return found;
}

/// Walks from field end to field end: every separator, or the first blank of a run of them, and
/// every '\r' and '\n'. It runs ahead of the parsing, so that where one number ends is known before
/// its digits are looked at, and the processor has several numbers in hand at once.
template <bool kBlankSeparated>
class FieldEnds {
 public:
  FieldEnds(const char* line, char separator) : separator_(separator) { seek(line); }

  /// Begins anew at the beginning of a line.
  void seek(const char* line) {
    block_ = line;
    after_end_ = 1;
    ends_ = ends_in_block();
  }

  /// The next end. There must be one: not to be called after the end of the last line.
  const char* next() {
    while (ends_ == 0) {
      block_ += kFieldBlock;
      ends_ = ends_in_block();
    }
    const char* const end = block_ + __builtin_ctzll(ends_);
    ends_ &= ends_ - 1;
    return end;
  }

 private:
  std::uint64_t ends_in_block() {
    if constexpr (!kBlankSeparated) return find_bytes(block_, separator_, '\n', '\r');
    const std::uint64_t blanks = find_bytes(block_, ' ', '\t', '\t');
    const std::uint64_t line_ends = find_bytes(block_, '\n', '\r', '\r');
    const std::uint64_t either = blanks | line_ends;
    const std::uint64_t behind_either = either << 1 | after_end_;
    after_end_ = either >> (kFieldBlock - 1);
    return (blanks & ~behind_either) | line_ends;
  }

  char separator_;
  const char* block_ = nullptr;
  std::uint64_t ends_ = 0;       ///< of the block, those not yet given
  std::uint64_t after_end_ = 1;  ///< 1 where the byte before the block was a blank or a line's end
};

}  // namespace bathyal::soundings
