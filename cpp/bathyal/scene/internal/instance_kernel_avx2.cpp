// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx2 -mfma, for machines that have them (base/simd.hpp).
#include "bathyal/scene/internal/instance_walk.hpp"
#include "bathyal/scene/internal/simd_avx2.hpp"

namespace bathyal::scene {

InstanceKernels avx2_instance_kernels() { return {cast_instances<Avx2>, occluded_instances<Avx2>}; }

}  // namespace bathyal::scene
