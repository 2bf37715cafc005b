// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace bathyal::scene {

/// Four floats in one register, on every compiler that we support.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }

/// An axis-aligned box in the local frame; the fourth lane of each corner is free for a whole
/// number of the owner's.
struct Box {
  Float4 low = {kInf, kInf, kInf, 0.0F};
  Float4 high = {-kInf, -kInf, -kInf, 0.0F};

  void add(const Box& other) {
    low = min4(low, other.low);
    high = max4(high, other.high);
  }

  /// Half of its surface.
  float area() const {
    const Float4 d = high - low;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }

  void set_tags(std::uint32_t first, std::uint32_t second) {
    low[3] = std::bit_cast<float>(first);
    high[3] = std::bit_cast<float>(second);
  }
  std::uint32_t first_tag() const { return std::bit_cast<std::uint32_t>(float{low[3]}); }
  std::uint32_t second_tag() const { return std::bit_cast<std::uint32_t>(float{high[3]}); }

 private:
  static constexpr float kInf = std::numeric_limits<float>::infinity();
};

/// A box given in double, rounded outwards by two units in the last place, which covers the
/// rounding of the differences that made it.
inline Box rounded_outwards(const double* low, const double* high) {
  constexpr float kOut = 0x1p-22F;
  constexpr float kTiny = std::numeric_limits<float>::min();
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto least = static_cast<float>(low[axis]);
    const auto most = static_cast<float>(high[axis]);
    box.low[axis] = least - std::abs(least) * kOut - kTiny;
    box.high[axis] = most + std::abs(most) * kOut + kTiny;
  }
  return box;
}

/// Twice the middle of a box. The tags are masked out: read as floats they may be denormal or NaN.
inline Float4 twice_middle(const Box& box) {
  const Float4 sum = box.low + box.high;
  constexpr Int4 kMask = {-1, -1, -1, 0};
  return reinterpret_cast<Float4>(reinterpret_cast<Int4>(sum) & kMask);
}

}  // namespace bathyal::scene
