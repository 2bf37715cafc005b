// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/lanes.hpp"
#include "bathyal/scene/internal/local_frame.hpp"

namespace bathyal::scene {

/// x ↦ direction · (x − anchor) over a local frame, the direction scaled to unit length, in
/// float and eight lanes at a time: finds what may lie in the slab [0, length]. It rules out and
/// decides nothing.
class SlabFilter {
 public:
  /// `length` [m]; `slack`, in the direction's own units, is what the rounding of vertices may be
  /// worth; that of the floats comes on top.
  SlabFilter(const LocalFrame& frame, const Vec3& direction, const Vec3& anchor, double length,
             double slack) {
    const double scale = 1.0 / direction.stableNorm();
    const double offset = scale * direction.dot(frame.origin - anchor);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      direction_[axis] = all4(static_cast<float>(scale * direction[static_cast<Index>(axis)]));
      rising_[axis] = direction_[axis][0] >= 0.0F;
    }
    offset_ = all4(static_cast<float>(offset));
    constexpr double kRounding = 16.0 * std::numeric_limits<float>::epsilon();
    const auto margin =
        static_cast<float>(kRounding * (frame.reach() + std::abs(offset)) + scale * slack);
    bottom_ = all4(-margin);
    top_ = all4(static_cast<float>(length) + margin);
  }

  /// The lanes whose box is not clear of the range. The box of an empty lane is infinite or NaN and
  /// never among them.
  LaneMask filter(const WideNode& node) const {
    std::array<const float*, 3> least, most;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = rising_[axis] ? node.low[axis] : node.high[axis];
      most[axis] = rising_[axis] ? node.high[axis] : node.low[axis];
    }
    const auto four = [&](std::size_t i) {
      return (value(least, i) <= top_) & (value(most, i) >= bottom_);
    };
    return {four(0), four(4)};
  }

  /// The lanes whose triangle is not clear of the range; never those without one, which hold NaN.
  LaneMask filter(const TriangleBlock& block) const {
    const auto four = [&](std::size_t i) {
      const Float4 h0 = value({block.v0[0], block.v0[1], block.v0[2]}, i);
      const Float4 h1 = h0 + slope({block.e1[0], block.e1[1], block.e1[2]}, i);
      const Float4 h2 = h0 + slope({block.e2[0], block.e2[1], block.e2[2]}, i);
      return (min4(h0, min4(h1, h2)) <= top_) & (max4(h0, max4(h1, h2)) >= bottom_);
    };
    return {four(0), four(4)};
  }

 private:
  using Columns = std::array<const float*, 3>;  // x, y, z

  Float4 slope(const Columns& x, std::size_t i) const {
    return direction_[0] * load4(x[0] + i) + direction_[1] * load4(x[1] + i) +
           direction_[2] * load4(x[2] + i);
  }
  Float4 value(const Columns& x, std::size_t i) const { return offset_ + slope(x, i); }

  std::array<Float4, 3> direction_;  // one number in all lanes each, as below
  std::array<bool, 3> rising_;
  Float4 offset_, bottom_, top_;
};

}  // namespace bathyal::scene
