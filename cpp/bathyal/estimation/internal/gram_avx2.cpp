// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx2 -mfma, for machines that have them (base/simd.hpp).
#include "bathyal/estimation/internal/gram_lanes.hpp"

namespace bathyal::estimation {
namespace {

struct Avx2 {
  using D = double __attribute__((vector_size(32)));
  static constexpr int kLanes = 4;
  static constexpr int kInnerA = 3, kInnerB = 4;
  static constexpr int kCombineVectors = 3, kCombineColumns = 4;
};

}  // namespace

extern const Kernels kAvx2{inner<Avx2>, combine<Avx2>};

}  // namespace bathyal::estimation
