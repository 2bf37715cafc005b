// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/scene/internal/cutter.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/instance_nearest.hpp"
#include "bathyal/scene/internal/instances.hpp"
#include "bathyal/scene/internal/nearest_walk.hpp"
#include "bathyal/scene/internal/ray_rows.hpp"
#include "bathyal/scene/internal/segment_nearness.hpp"
#include "bathyal/scene/internal/segment_triangle.hpp"
#include "bathyal/scene/scene.hpp"

namespace bathyal {

void NearestSegmentOptions::check() const {
  if (!(within >= 0.0)) throw_argument("within", "a distance of 0 or more", to_text(within));
}

namespace scene {
namespace {

/// The walk's query where it is a segment.
class SegmentQuery {
 public:
  using Found = SegmentApproach;

  SegmentQuery(const LocalFrame& frame, const Vec3& start, const Vec3& end)
      : start_(start),
        end_(end),
        nearness_(frame, start - frame.origin, end - frame.origin),
        rounding_(32.0 * std::numeric_limits<double>::epsilon() *
                  (reach(start) + reach(end) + reach(frame.origin))) {}

  template <class Lanes>
  void bound(const Lanes& lanes, LaneDistances& bounds) const {
    nearness_.bound(lanes, bounds);
  }
  float limit(double distance) const { return nearness_.limit(distance + rounding_); }
  Found measure(const std::array<Vec3, 3>& corners) const {
    return closest_to_segment(corners, start_, end_);
  }

 private:
  Vec3 start_, end_;
  SegmentNearness nearness_;
  double rounding_;  ///< how far it may carry a closest point out of its triangle's box [m]
};

Vec3 row_of(PointView rows, std::size_t i) {
  return rows.row(rows.rows() == 1 ? 0 : static_cast<Index>(i)).transpose();
}

/// \throw std::invalid_argument that names the first row beyond kLargestSegmentReach.
void check_ends(std::string_view name, PointView ends) {
  for (Index i = 0; i < ends.rows(); ++i) {
    if (ends.row(i).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kLargestSegmentReach) continue;
    throw_bad_row(ends, ends, i, name, name, "coordinates up to 1e25 m");
  }
}

NearestToSegment nearest_to_segment(const Scene::Hierarchy& hierarchy, const Vec3& start,
                                    const Vec3& end, double within) {
  NearestWalk walk(hierarchy, SegmentQuery(hierarchy, start, end), within);
  walk.run();
  if (walk.primitive() == kNoPrimitive) return {};
  const PrimitiveName name = hierarchy.name(walk.primitive());
  const SegmentApproach& best = walk.found();
  return {std::sqrt(best.squared_distance),
          name.mesh,
          name.triangle,
          best.u,
          best.v,
          best.point,
          best.fraction,
          best.on_segment};
}

/// Found in the frame of a mesh, and as it is in the world.
NearestToSegment in_world(const SegmentApproach& found, const InstanceFrame& frame,
                          const Vec3& start, const Vec3& end) {
  NearestToSegment nearest;
  nearest.u = found.u;
  nearest.v = found.v;
  nearest.fraction = found.fraction;
  if (frame.at_identity) {
    nearest.point = found.point;
    nearest.segment_point = found.on_segment;
    return nearest;
  }
  nearest.point = to_world(frame, found.point);
  nearest.segment_point = found.squared_distance == 0.0 ? nearest.point
                          : found.fraction == 0.0       ? start
                          : found.fraction == 1.0       ? end
                                                        : to_world(frame, found.on_segment);
  return nearest;
}

NearestToSegment nearest_to_segment(const Scene::Instances& instances, const Vec3& start,
                                    const Vec3& end, double within) {
  InstanceNearest walk(instances, SegmentQuery(instances, start, end), within);
  walk.run([&](const Scene::Hierarchy& hierarchy, const InstanceFrame& frame) {
    return frame.at_identity ? SegmentQuery(hierarchy, start, end)
                             : SegmentQuery(hierarchy, to_mesh(frame, start), to_mesh(frame, end));
  });
  if (walk.row() < 0) return {};
  NearestToSegment nearest = in_world(walk.found(), instances.frame(walk.row()), start, end);
  nearest.distance = walk.distance();
  nearest.mesh = walk.row();
  nearest.triangle = static_cast<std::int32_t>(walk.triangle());
  return nearest;
}

}  // namespace
}  // namespace scene

NearestToSegment Scene::nearest_segment(const Vec3& start, const Vec3& end,
                                        const NearestSegmentOptions& options) const {
  const PointView from(start.data(), 1, 3), to(end.data(), 1, 3);
  return nearest_segments(from, to, options, 1).front();
}

std::vector<NearestToSegment> Scene::nearest_segments(PointView start, PointView end,
                                                      const NearestSegmentOptions& options,
                                                      int num_threads) const {
  options.check();
  scene::check_rows(start, end, "start", "end");
  scene::check_ends("start", start);
  scene::check_ends("end", end);
  std::vector<NearestToSegment> found(static_cast<std::size_t>(end.rows()));
  constexpr std::size_t kGrain = 64;
  parallel_for(found.size(), kGrain, num_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 from = scene::row_of(start, i), to = scene::row_of(end, i);
      found[i] = instances_ ? scene::nearest_to_segment(*instances_, from, to, options.within)
                            : scene::nearest_to_segment(*hierarchy_, from, to, options.within);
    }
  });
  return found;
}

}  // namespace bathyal
