// SPDX-License-Identifier: BSD-3-Clause
// Compiled for AVX-512, for machines that have it (base/simd.hpp).
#include "bathyal/estimation/internal/gram_lanes.hpp"

namespace bathyal::estimation {
namespace {

struct Avx512 {
  using D = double __attribute__((vector_size(64)));
  static constexpr int kLanes = 8;
  static constexpr int kInnerA = 4, kInnerB = 6;
  static constexpr int kCombineVectors = 3, kCombineColumns = 8;
};

}  // namespace

extern const Kernels kAvx512{inner<Avx512>, combine<Avx512>};

}  // namespace bathyal::estimation
