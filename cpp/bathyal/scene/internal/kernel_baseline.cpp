// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/packet_walk.hpp"
#include "bathyal/scene/internal/simd_baseline.hpp"

namespace bathyal::scene {

CastKernels baseline_kernels() { return {cast<Baseline>, occluded<Baseline>}; }

}  // namespace bathyal::scene
