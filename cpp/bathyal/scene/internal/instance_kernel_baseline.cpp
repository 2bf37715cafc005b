// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/instance_walk.hpp"
#include "bathyal/scene/internal/simd_baseline.hpp"

namespace bathyal::scene {

InstanceKernels baseline_instance_kernels() {
  return {cast_instances<Baseline>, occluded_instances<Baseline>};
}

}  // namespace bathyal::scene
