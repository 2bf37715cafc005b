// SPDX-License-Identifier: BSD-3-Clause
// Two rows at a time: SSE on x86-64, and whatever the machine has elsewhere.
#include "bathyal/estimation/internal/gram_lanes.hpp"

namespace bathyal::estimation {
namespace {

struct Baseline {
  using D = double __attribute__((vector_size(16)));
  static constexpr int kLanes = 2;
  static constexpr int kInnerA = 3, kInnerB = 4;
  static constexpr int kCombineVectors = 3, kCombineColumns = 4;
};

}  // namespace

extern const Kernels kBaseline{inner<Baseline>, combine<Baseline>};

}  // namespace bathyal::estimation
