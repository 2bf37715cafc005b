// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx2 -mfma, for machines that have them (base/simd.hpp).
#include "bathyal/arm/internal/forward_lanes.hpp"

namespace bathyal::arm {
namespace {

struct Avx2 {
  using D = double __attribute__((vector_size(32)));
  using I = std::int64_t __attribute__((vector_size(32)));
  static constexpr int kLanes = 4;
};

}  // namespace

void avx2_forward(const ForwardProgram& program, const ForwardBatch& batch) {
  forward<Avx2>(program, batch);
}

}  // namespace bathyal::arm
