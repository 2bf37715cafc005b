// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/triangulate.hpp"

#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal {

Triangulation triangulate(const PointCloud& cloud, const DelaunayOptions& options) {
  const Points points = cloud.shared_points().snapshot();
  check_clean("cloud", points.view());
  const Delaunay result = delaunay(points.view(), options);
  FindSheetsOptions sheet_options;
  sheet_options.num_threads = options.num_threads;
  return {TriangleMesh(cloud.shared_points(), result.triangles, cloud.attributes(), cloud.datum()),
          find_sheets(points.view(), sheet_options), result.max_edge, result.cut_triangles,
          result.merged_points};
}

void check_clean(std::string_view name, PointView points) {
  Index bad = 0;
  Index first = 0;
  for (Index i = points.rows() - 1; i >= 0; --i) {
    if (points.row(i).allFinite()) continue;
    ++bad;
    first = i;
  }
  if (bad == 0) return;
  throw_argument(name, "finite coordinates (clean_cloud drops the others)",
                 std::to_string(bad) + (bad == 1 ? " point that is" : " points that are") +
                     " not, the first in row " + std::to_string(first));
}

}  // namespace bathyal
