// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

struct DelaunayOptions {
  /// Longest edge a triangle may have, measured in the horizontal plane [m], above 0; infinity
  /// keeps the whole convex hull. Unset: 5 times the median over all triangles of their longest
  /// horizontal edge, and infinity below 50 distinct points, too few for a median.
  std::optional<double> max_edge = std::nullopt;
  int num_threads = 0;  ///< 0 = all; the result is the same for any number

  /// \throw std::invalid_argument that names the field.
  void check() const;
};

struct Delaunay {
  Triangles triangles;      ///< rows of the points, counter-clockwise seen from above
  double max_edge = 0.0;    ///< the longest edge allowed [m], infinity when none was cut
  Index cut_triangles = 0;  ///< triangles left out because an edge was longer
  Index merged_points = 0;  ///< points left out because another has the same (x, y)
};

/// The 2.5-D Delaunay triangulation of soundings: that of their (x, y), in the frame of the points
/// with z up, decided exactly on the doubles as given. Co-circular points are settled by the rule
/// of in_perturbed_circle, so the triangles depend on the points alone, not on their order or on
/// the number of threads. Of points with the same (x, y) only the lowest, then the first row, is
/// used. Triangles with an edge above `max_edge` are dropped after the triangulation is complete:
/// gaps in the coverage stay gaps. Neighbouring triangles are close to each other in the list.
/// \throw std::invalid_argument for points that are not finite or above 1e75, and when there are
/// not three that differ in (x, y) and are not on one line.
Delaunay delaunay(PointView points, const DelaunayOptions& options = {});

}  // namespace bathyal
