// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal::scene {

/// Where the boxes of a tree are counted from, and how far they reach.
struct LocalFrame {
  Vec3 origin = Vec3::Zero();  ///< whole metres, in the frame that the tree is in
  Vec3 low = Vec3::Zero();     ///< box of all that it contains, less `origin`, exact up to double
  Vec3 high = Vec3::Zero();

  /// Largest coordinate of that box [m].
  double reach() const { return std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()); }
};

}  // namespace bathyal::scene
