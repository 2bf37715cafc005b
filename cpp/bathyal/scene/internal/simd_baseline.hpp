// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "bathyal/scene/internal/ray_triangle.hpp"

namespace bathyal::scene {
namespace {

/// Eight floats as two vectors of four, in the compiler's own notation: SSE on x86-64, and whatever
/// the machine has elsewhere.
struct Baseline {
  using Half = float __attribute__((vector_size(16)));
  using Bits = std::int32_t __attribute__((vector_size(16)));
  struct F {
    Half a, b;
  };
  using P = F;  ///< rays of a packet
  using D = double __attribute__((vector_size(16)));
  using I = std::int64_t __attribute__((vector_size(16)));
  static constexpr int kRays = 8;
  static constexpr int kDoubles = 2;

  static F load(const float* p) {
    F f;
    __builtin_memcpy(&f.a, p, sizeof f.a);
    __builtin_memcpy(&f.b, p + 4, sizeof f.b);
    return f;
  }
  static void store(float* p, F f) {
    __builtin_memcpy(p, &f.a, sizeof f.a);
    __builtin_memcpy(p + 4, &f.b, sizeof f.b);
  }
  static F all(float x) { return {Half{x, x, x, x}, Half{x, x, x, x}}; }
  static F add(F x, F y) { return {x.a + y.a, x.b + y.b}; }
  static F subtract(F x, F y) { return {x.a - y.a, x.b - y.b}; }
  static F multiply(F x, F y) { return {x.a * y.a, x.b * y.b}; }
  static F add_product(F c, F x, F y) { return {c.a + x.a * y.a, c.b + x.b * y.b}; }
  static F subtract_product(F c, F x, F y) { return {c.a - x.a * y.a, c.b - x.b * y.b}; }
  static F product_minus(F x, F y, F c) { return {x.a * y.a - c.a, x.b * y.b - c.b}; }
  static F minimum(F x, F y) { return {x.a < y.a ? x.a : y.a, x.b < y.b ? x.b : y.b}; }
  static F maximum(F x, F y) { return {x.a > y.a ? x.a : y.a, x.b > y.b ? x.b : y.b}; }
  static F sign_of(F x) { return {with_bits(x.a, kSign), with_bits(x.b, kSign)}; }
  static F absolute(F x) { return {with_bits(x.a, ~kSign), with_bits(x.b, ~kSign)}; }
  static F exclusive_or(F x, F y) {
    return {reinterpret_cast<Half>(reinterpret_cast<Bits>(x.a) ^ reinterpret_cast<Bits>(y.a)),
            reinterpret_cast<Half>(reinterpret_cast<Bits>(x.b) ^ reinterpret_cast<Bits>(y.b))};
  }
  /// A bit for every lane with x ≥ y; NaN gives none.
  static unsigned at_least(F x, F y) { return mask_of(x.a >= y.a) | mask_of(x.b >= y.b) << 4U; }

  static F divide(F x, F y) { return {x.a / y.a, x.b / y.b}; }
  static P all_rays(float x) { return all(x); }
  static P load_rays(const float* p) { return load(p); }

  static D root(D x) { return D{__builtin_sqrt(x[0]), __builtin_sqrt(x[1])}; }
  static D product_error(D a, D b, D product) {
    return D{scene::product_error(a[0], b[0], product[0]),
             scene::product_error(a[1], b[1], product[1])};
  }
  static void store_narrow(float* p, D x) {
    p[0] = static_cast<float>(x[0]);
    p[1] = static_cast<float>(x[1]);
  }
  static unsigned bits(I truth) {
    return static_cast<unsigned>(truth[0] & 1) | static_cast<unsigned>(truth[1] & 2);
  }
  static I lanes(unsigned bits) {
    return I{-static_cast<std::int64_t>(bits & 1U), -static_cast<std::int64_t>(bits >> 1U & 1U)};
  }

 private:
  static constexpr std::int32_t kSign = INT32_MIN;

  static Half with_bits(Half x, std::int32_t bits) {
    return reinterpret_cast<Half>(reinterpret_cast<Bits>(x) & Bits{bits, bits, bits, bits});
  }
  static unsigned mask_of(Bits truth) {
#if defined(__SSE2__)
    return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<Half>(truth)));
#else
    const Bits bits = truth & Bits{1, 2, 4, 8};
    return static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
  }
};

}  // namespace
}  // namespace bathyal::scene
