// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx512f -mavx512vl -mavx512dq -mavx512bw and AVX2, for machines that have them
// (base/simd.hpp).
#include "bathyal/arm/internal/forward_lanes.hpp"

namespace bathyal::arm {
namespace {

struct Avx512 {
  using D = double __attribute__((vector_size(64)));
  using I = std::int64_t __attribute__((vector_size(64)));
  static constexpr int kLanes = 8;
};

}  // namespace

void avx512_forward(const ForwardProgram& program, const ForwardBatch& batch) {
  forward<Avx512>(program, batch);
}

}  // namespace bathyal::arm
