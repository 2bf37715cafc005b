// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx512f -mavx512vl -mavx512dq -mavx512bw and AVX2, for machines that have them
// (base/simd.hpp).
#include "bathyal/scene/internal/packet_walk.hpp"
#include "bathyal/scene/internal/simd_avx512.hpp"

namespace bathyal::scene {

CastKernels avx512_kernels() { return {cast<Avx512>, occluded<Avx512>}; }

}  // namespace bathyal::scene
