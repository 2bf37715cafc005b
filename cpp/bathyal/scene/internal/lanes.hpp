// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>

#include "bathyal/scene/internal/boxes.hpp"

// Eight lanes at a time in two vectors of four, for the sieves that run once per node and block:
// what eight lanes on one instruction would add there is not worth a kernel per instruction set.

namespace bathyal::scene {

inline Float4 all4(float x) { return Float4{x, x, x, x}; }
inline Float4 load4(const float* p) { return Float4{p[0], p[1], p[2], p[3]}; }

/// A yes or no for each of eight lanes: all bits of it, or none.
struct LaneMask {
  Int4 first, last;

  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) {
    return {a.first & b.first, a.last & b.last};
  }

  /// A bit for each lane that says yes.
  unsigned bits() const {
    using Long2 = std::int64_t __attribute__((vector_size(16)));
    const auto joined =
        reinterpret_cast<Long2>((first & Int4{1, 2, 4, 8}) | (last & Int4{16, 32, 64, 128}));
    const std::int64_t folded = joined[0] | joined[1];
    return static_cast<unsigned>((folded | folded >> 32) & 0xff);
  }
};

/// Calls `work(lane)` for each bit that is set, lowest first.
template <class Work>
void for_each_lane(unsigned lanes, const Work& work) {
  for (; lanes != 0; lanes &= lanes - 1) work(std::countr_zero(lanes));
}

}  // namespace bathyal::scene
