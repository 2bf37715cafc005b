// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/simd.hpp"

#include <atomic>
#include <cstdlib>
#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

bool runs_here(SimdLevel level) {
#if defined(__x86_64__)
  switch (level) {
    case SimdLevel::kBaseline:
      return true;
    case SimdLevel::kAvx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case SimdLevel::kAvx512:
      return runs_here(SimdLevel::kAvx2) && __builtin_cpu_supports("avx512f") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512bw");
  }
  return false;
#else
  return level == SimdLevel::kBaseline;
#endif
}

/// An unknown name, or one the machine cannot run, is an error and not a guess.
SimdLevel starting_level() {
  const char* requested = std::getenv("BATHYAL_SIMD");
  if (requested == nullptr || *requested == '\0') return available_simd_levels().back();
  for (const SimdLevel level : available_simd_levels()) {
    if (to_text(level) == requested) return level;
  }
  throw_argument("BATHYAL_SIMD", "one of baseline, avx2, avx512 that this machine can run",
                 requested);
}

std::atomic<SimdLevel>& current_level() {
  static std::atomic<SimdLevel> level{starting_level()};
  return level;
}

}  // namespace

SimdLevel simd_level() { return current_level(); }

std::vector<SimdLevel> available_simd_levels() {
  std::vector<SimdLevel> levels;
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (runs_here(level)) levels.push_back(level);
  }
  return levels;
}

void set_simd_level(SimdLevel level) {
  if (!runs_here(level)) {
    throw_argument("level", "an instruction set of this machine", to_text(level));
  }
  current_level() = level;
}

std::string_view to_text(SimdLevel level) {
  switch (level) {
    case SimdLevel::kBaseline:
      return "baseline";
    case SimdLevel::kAvx2:
      return "avx2";
    case SimdLevel::kAvx512:
      return "avx512";
  }
  return "unknown";
}

}  // namespace bathyal
