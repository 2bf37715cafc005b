// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

namespace bathyal {

/// The instruction sets a kernel may be built for. `kBaseline` is x86-64-v2 (SSE4.2).
enum class SimdLevel { kBaseline = 0, kAvx2 = 1, kAvx512 = 2 };

/// The best level of this machine, or the lower one named by the environment variable
/// BATHYAL_SIMD ("baseline", "avx2", "avx512") or by set_simd_level. Every level gives the same
/// bytes; the choice is for tests and benchmarks.
SimdLevel simd_level();

/// Levels that this machine can run, lowest first.
std::vector<SimdLevel> available_simd_levels();

/// \throw std::invalid_argument when the machine cannot run `level`.
void set_simd_level(SimdLevel level);

std::string_view to_text(SimdLevel level);

}  // namespace bathyal
