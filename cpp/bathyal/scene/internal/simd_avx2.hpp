// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Included by kernels compiled with -mavx2 -mfma, for machines that have them (base/simd.hpp).

#include <immintrin.h>

#include <cstdint>

namespace bathyal::scene {
namespace {

struct Avx2 {
  using F = __m256;
  using P = F;  ///< rays of a packet
  using D = double __attribute__((vector_size(32)));
  using I = std::int64_t __attribute__((vector_size(32)));
  static constexpr int kRays = 8;
  static constexpr int kDoubles = 4;

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
  static unsigned at_least(F x, F y) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(x, y, _CMP_GE_OQ)));
  }
  static F divide(F x, F y) { return _mm256_div_ps(x, y); }
  static P all_rays(float x) { return all(x); }
  static P load_rays(const float* p) { return load(p); }

  static D root(D x) { return _mm256_sqrt_pd(x); }
  static D product_error(D a, D b, D product) { return _mm256_fmsub_pd(a, b, product); }
  static void store_narrow(float* p, D x) { _mm_storeu_ps(p, _mm256_cvtpd_ps(x)); }
  static unsigned bits(I truth) {
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(truth)));
  }
  static I lanes(unsigned bits) {
    const I bit = {1, 2, 4, 8};
    return (bit & static_cast<std::int64_t>(bits)) != 0;
  }
};

}  // namespace
}  // namespace bathyal::scene
