// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/geometry/plane.hpp"
#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {

struct FitPlaneOptions {
  /// How far the ground may lie off the plane and still count as flat [m], above 0.
  double tolerance = 0.05;
  /// Soundings in a patch, whose median is the height of the ground there; 5 or more.
  int patch_points = 50;
  /// Share of the patches that must lie within `tolerance`, above 0 to 1.
  double flat_share = 0.99;
  int trials = 500;        ///< planes through three random points that are tried, 1 to 10⁶
  std::uint64_t seed = 1;  ///< of their choice
  int num_threads = 0;     ///< 0 = all; the result is the same for any number

  void check() const;
};

/// The plane of a bottom (Filaretov, Konoplin, Konoplin 2018, eq 1) and how far to trust it.
struct PlaneFit {
  Plane plane;       ///< unit normal up: z above 0 (a vertical plane: see fit_plane)
  double rms = 0.0;  ///< of the inliers about the plane, along its normal [m]
  std::vector<std::uint8_t> inliers;  ///< (N,) 1 for points the plane rests on
  Index inlier_count = 0;
  double tilt_std = 0.0;    ///< standard deviation of the normal's direction, its worst way [rad]
  bool flat = false;        ///< whether the plane may represent the bottom
  double flat_share = 0.0;  ///< share of the patches that lie within the tolerance
  double relief = 0.0;      ///< largest distance of a patch from the plane [m]
};

/// Fits a plane to a bottom, undisturbed by gross errors in up to 45 % of the points.
///
/// Planes through three random points are ranked by their median squared residual (least median of
/// squares, Rousseeuw 1984), the best one's scale is taken from the median absolute residual, and
/// the plane is refined by total least squares over the points within three times that scale until
/// they no longer change. Points count along the normal, so a tilted bottom is fitted as well as a
/// level one. Computed in double about a local origin. The order of the points may change the last
/// bits and, where two planes explain the cloud equally well, the choice between them.
///
/// Flat enough for its plane to represent it (`flat`): the plane is cut into square patches of
/// about `patch_points` points, and in `flat_share` of them the median distance from the plane is
/// within `tolerance`. Medians of patches, so that the noise of single soundings and spikes do not
/// count as relief, and boulders, trenches and waves wider than half a patch do. With fewer points
/// than two patches each point is its own patch.
///
/// A vertical plane has no up: its normal's first component that is not zero is positive.
/// \throw std::invalid_argument for points that are not finite or above 1e75; fewer than three
/// distinct points; points all on one line, or whose plane would rest on a line of them.
PlaneFit fit_plane(PointView points, const FitPlaneOptions& options = {});

}  // namespace bathyal
