// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx2 -mfma, for machines that have them (base/simd.hpp).
#include "bathyal/scene/internal/packet_walk.hpp"
#include "bathyal/scene/internal/simd_avx2.hpp"

namespace bathyal::scene {

CastKernels avx2_kernels() { return {cast<Avx2>, occluded<Avx2>}; }

}  // namespace bathyal::scene
