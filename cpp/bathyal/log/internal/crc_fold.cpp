// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mpclmul, for machines that have it.
#include "bathyal/log/internal/crc_fold.hpp"

#include <emmintrin.h>
#include <wmmintrin.h>

namespace bathyal::crc {
namespace {

__m128i load(const unsigned char* at) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
}

/// `to` and what `from` contributes to it, `by` = (x^(n+32), x^(n−32)) mod P for n bits between.
__m128i folded_into(__m128i to, __m128i from, __m128i by) {
  const __m128i low = _mm_clmulepi64_si128(from, by, 0x00);
  const __m128i high = _mm_clmulepi64_si128(from, by, 0x11);
  return _mm_xor_si128(to, _mm_xor_si128(low, high));
}

}  // namespace

bool can_fold() { return __builtin_cpu_supports("pclmul"); }

// Gopal and others (2009), Fast CRC computation for generic polynomials using PCLMULQDQ: steps 1
// and 2 with the constants of ISO 3309, bits reflected; the rest of it is the tables' work.
void fold(const unsigned char* bytes, std::size_t size, std::uint32_t crc, unsigned char* folded) {
  const __m128i by_512 = _mm_set_epi64x(0x01c6e41596, 0x0154442bd4);
  const __m128i by_128 = _mm_set_epi64x(0x00ccaa009e, 0x01751997d0);
  __m128i a = _mm_xor_si128(load(bytes), _mm_cvtsi32_si128(static_cast<int>(crc)));
  __m128i b = load(bytes + 16), c = load(bytes + 32), d = load(bytes + 48);
  const unsigned char* at = bytes + kLeastFolded;
  std::size_t left = size - kLeastFolded;
  for (; left >= kLeastFolded; left -= kLeastFolded, at += kLeastFolded) {
    a = folded_into(load(at), a, by_512);
    b = folded_into(load(at + 16), b, by_512);
    c = folded_into(load(at + 32), c, by_512);
    d = folded_into(load(at + 48), d, by_512);
  }
  a = folded_into(d, folded_into(c, folded_into(b, a, by_128), by_128), by_128);
  for (; left >= 16; left -= 16, at += 16) a = folded_into(load(at), a, by_128);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(folded), a);
}

}  // namespace bathyal::crc
