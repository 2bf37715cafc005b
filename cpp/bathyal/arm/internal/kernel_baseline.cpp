// SPDX-License-Identifier: BSD-3-Clause
// Two poses at a time: SSE on x86-64, and whatever the machine has elsewhere.
#include "bathyal/arm/internal/forward_lanes.hpp"

namespace bathyal::arm {
namespace {

struct Baseline {
  using D = double __attribute__((vector_size(16)));
  using I = std::int64_t __attribute__((vector_size(16)));
  static constexpr int kLanes = 2;
};

}  // namespace

void baseline_forward(const ForwardProgram& program, const ForwardBatch& batch) {
  forward<Baseline>(program, batch);
}

}  // namespace bathyal::arm
