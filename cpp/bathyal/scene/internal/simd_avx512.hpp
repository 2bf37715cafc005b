// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Included by kernels compiled with -mavx512f -mavx512vl -mavx512dq -mavx512bw and AVX2, for
// machines that have them (base/simd.hpp).

#include <immintrin.h>

#include <cstdint>

namespace bathyal::scene {
namespace {

struct Avx512 {
  using F = __m256;
  using P = __m512;  ///< rays of a packet
  using D = double __attribute__((vector_size(64)));
  using I = std::int64_t __attribute__((vector_size(64)));
  static constexpr int kRays = 16;
  static constexpr int kDoubles = 8;

  static F load(const float* p) { return _mm256_load_ps(p); }
  static void store(float* p, F x) { _mm256_store_ps(p, x); }
  static F all(float x) { return _mm256_set1_ps(x); }
  static F add(F x, F y) { return _mm256_add_ps(x, y); }
  static F subtract(F x, F y) { return _mm256_sub_ps(x, y); }
  static F multiply(F x, F y) { return _mm256_mul_ps(x, y); }
  static F add_product(F c, F x, F y) { return _mm256_fmadd_ps(x, y, c); }
  static F subtract_product(F c, F x, F y) { return _mm256_fnmadd_ps(x, y, c); }
  static F product_minus(F x, F y, F c) { return _mm256_fmsub_ps(x, y, c); }
  static F minimum(F x, F y) { return _mm256_min_ps(x, y); }
  static F maximum(F x, F y) { return _mm256_max_ps(x, y); }
  static F sign_of(F x) { return _mm256_and_ps(x, _mm256_set1_ps(-0.0F)); }
  static F absolute(F x) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), x); }
  static F exclusive_or(F x, F y) { return _mm256_xor_ps(x, y); }
  /// A bit for every lane with x ≥ y; NaN gives none.
  static unsigned at_least(F x, F y) { return _mm256_cmp_ps_mask(x, y, _CMP_GE_OQ); }

  static P load_rays(const float* p) { return _mm512_load_ps(p); }
  static void store(float* p, P x) { _mm512_store_ps(p, x); }
  static P all_rays(float x) { return _mm512_set1_ps(x); }
  static P add(P x, P y) { return _mm512_add_ps(x, y); }
  static P subtract(P x, P y) { return _mm512_sub_ps(x, y); }
  static P multiply(P x, P y) { return _mm512_mul_ps(x, y); }
  static P divide(P x, P y) { return _mm512_div_ps(x, y); }
  static P add_product(P c, P x, P y) { return _mm512_fmadd_ps(x, y, c); }
  static P subtract_product(P c, P x, P y) { return _mm512_fnmadd_ps(x, y, c); }
  static P product_minus(P x, P y, P c) { return _mm512_fmsub_ps(x, y, c); }
  static P minimum(P x, P y) { return _mm512_min_ps(x, y); }
  static P maximum(P x, P y) { return _mm512_max_ps(x, y); }
  static P sign_of(P x) { return _mm512_and_ps(x, _mm512_set1_ps(-0.0F)); }
  static P absolute(P x) { return _mm512_andnot_ps(_mm512_set1_ps(-0.0F), x); }
  static P exclusive_or(P x, P y) { return _mm512_xor_ps(x, y); }
  static unsigned at_least(P x, P y) { return _mm512_cmp_ps_mask(x, y, _CMP_GE_OQ); }

  static D root(D x) { return _mm512_sqrt_pd(x); }
  static D product_error(D a, D b, D product) { return _mm512_fmsub_pd(a, b, product); }
  static void store_narrow(float* p, D x) { _mm256_store_ps(p, _mm512_cvtpd_ps(x)); }
  static unsigned bits(I truth) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(truth)); }
  static I lanes(unsigned bits) {
    return reinterpret_cast<I>(_mm512_movm_epi64(static_cast<__mmask8>(bits)));
  }
};

}  // namespace
}  // namespace bathyal::scene
