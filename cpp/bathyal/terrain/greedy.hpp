// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {

/// PCL's parameters under names that say what they are.
struct GreedyOptions {
  /// Radius within which a point looks for neighbours, so also the longest edge [m]; 0 takes 6
  /// times the median distance of a point to its nearest neighbour.
  double search_radius = 0.0;
  /// The radius of each point is at most so many times the distance to its nearest neighbour; above
  /// 0. PCL's mu, 2.5 in its tutorial.
  double mu = 2.5;
  int max_neighbours = 100;  ///< candidates considered around a point, 3 or more
  /// Points whose normals differ by more are not joined [rad], above 0 to π.
  double max_surface_angle = std::numbers::pi / 4;
  double min_angle = std::numbers::pi / 18;       ///< preferred in a triangle [rad], 0 to max_angle
  double max_angle = 2.0 * std::numbers::pi / 3;  ///< preferred in a triangle [rad], up to π
  /// Whether the normals are all taken as turned to the same side. Ours are estimated without a
  /// viewpoint, so the default compares them up to their sign.
  bool normal_consistency = false;
  int normal_neighbours = 20;  ///< points that a normal is fitted to, 3 or more

  void check() const;
};

struct Greedy {
  Triangles triangles;         ///< rows of the points
  double search_radius = 0.0;  ///< the one used [m]
  Index merged_points = 0;     ///< left out: another lies at the same place, in float32 about the
                               ///< local origin
};

/// Greedy projection triangulation (Marton, Rusu, Beetz 2009) as PCL has it, made safe: the surface
/// model of Filaretov, Konoplin, Konoplin 2018. It takes overhangs, which `delaunay` cannot; it
/// leaves holes where sampling is uneven, and it is slow.
///
/// PCL crashes on an empty cloud, aborts on a NaN and works in float32, where survey coordinates
/// lose their centimetres: points are checked first and a local origin is subtracted in double. Of
/// points at one place the first row is used. PCL sees the points moved by up to a thousandth of
/// their spacing, without which it leaves holes in grids. Triangles without area and repeated ones
/// are dropped. The rest are turned up where the cloud is a height field (find_sheets); elsewhere
/// consistently across every edge that two of them share, where that is possible at all, and each
/// connected piece so that it faces up on balance (outward, when it is closed or nearly so).
///
/// One thread; the same triangles every time.
/// \throw std::invalid_argument for points that are not finite, and when there are not three that
/// differ and are not on one line.
Greedy greedy(PointView points, const GreedyOptions& options = {});

}  // namespace bathyal
