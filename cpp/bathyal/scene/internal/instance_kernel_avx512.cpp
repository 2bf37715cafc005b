// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx512f -mavx512vl -mavx512dq -mavx512bw and AVX2, for machines that have them
// (base/simd.hpp).
#include "bathyal/scene/internal/instance_walk.hpp"
#include "bathyal/scene/internal/simd_avx512.hpp"

namespace bathyal::scene {

InstanceKernels avx512_instance_kernels() {
  return {cast_instances<Avx512>, occluded_instances<Avx512>};
}

}  // namespace bathyal::scene
