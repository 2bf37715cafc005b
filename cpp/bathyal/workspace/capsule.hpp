// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/geometry/pose.hpp"
#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

/// All points within `radius` of the segment from `start` to `end`, its axis; a ball where the two
/// are one point, the segment itself where the radius is 0.
struct Capsule {
  Vec3 start = Vec3::Zero();  ///< [m]
  Vec3 end = Vec3::Zero();    ///< [m]
  double radius = 0.0;        ///< [m], 0 or more

  /// \throw std::invalid_argument for an end that is not finite, a radius that is negative or not.
  void check(std::string_view name = "capsule") const;
};

/// The capsule in another frame.
Capsule in_frame(const Capsule& capsule, const Pose& new_from_capsule);

/// Where two segments come nearest to each other.
struct SegmentPair {
  double distance = 0.0;  ///< [m]
  double first = 0.0;     ///< fraction along the first segment, 0 to 1
  double second = 0.0;    ///< along the second
};

/// Segments of no length are points. Of parallel ones that overlap, the pair with the lowest
/// `first`.
SegmentPair nearest_of_segments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);

/// From surface to surface; below 0 where they overlap: minus the depth by which the axes' nearest
/// points lie too near.
double distance(const Capsule& one, const Capsule& other);

/// A capsule that contains every point, small in volume: among the principal axes of the points and
/// directions near to the best of them. Not always the smallest there is.
/// \throw std::invalid_argument for no point, or one that is not finite.
Capsule fit_capsule(PointView points);

}  // namespace bathyal
