// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx512f -mavx512vl -mavx512dq -mavx512bw and AVX2, for machines that have them
// (base/simd.hpp).
#include <immintrin.h>

#include "bathyal/scene/ray_walk.hpp"

namespace bathyal::scene {
namespace {

struct Avx512 {
  using F = __m256;

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
  static int at_least(F x, F y) { return _mm256_cmp_ps_mask(x, y, _CMP_GE_OQ); }
};

}  // namespace

CastKernels avx512_kernels() { return {cast<Avx512>, occluded<Avx512>}; }

}  // namespace bathyal::scene
