// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/winding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/instances.hpp"
#include "bathyal/scene/internal/nearest.hpp"

namespace bathyal {

void WindingOptions::check() const { check_positive("accuracy", accuracy); }

namespace scene {

double solid_angle(const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const double volume = a.dot(b.cross(c));
  if (volume == 0.0) return 0.0;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double cosines = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2.0 * std::atan2(volume, cosines);
}

namespace {

/// Cluster of one triangle about its own centre, radius left out.
Cluster triangle_cluster(const std::array<Vec3, 3>& corners) {
  Cluster cluster;
  cluster.centre = (corners[0] + corners[1] + corners[2]) / 3.0;
  cluster.area_vector = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  cluster.area = cluster.area_vector.norm();
  double squares = 0.0;
  for (const Vec3& corner : corners) squares += (corner - cluster.centre).squaredNorm();
  cluster.spread = cluster.area * squares / 12.0;
  return cluster;
}

/// Joins clusters about their common centre: each is moved by the rule of parallel axes.
template <class Parts>
Cluster join(const Parts& parts) {
  Cluster whole;
  for (const Cluster& part : parts) {
    whole.area += part.area;
    whole.centre += part.area * part.centre;
  }
  if (!(whole.area > 0.0)) return {};
  whole.centre /= whole.area;
  for (const Cluster& part : parts) {
    const Vec3 shift = part.centre - whole.centre;
    whole.area_vector += part.area_vector;
    whole.moment += part.moment + shift * part.area_vector.transpose();
    whole.spread += part.spread + part.area * shift.squaredNorm();
  }
  return whole;
}

double farthest(const WideNode& node, int lane, const Vec3& centre) {
  Vec3 reach;
  for (int axis = 0; axis < 3; ++axis) {
    reach[axis] =
        std::max(centre[axis] - node.low[axis][lane], node.high[axis][lane] - centre[axis]);
  }
  return reach.norm();
}

Cluster block_cluster(const Scene::Hierarchy& hierarchy, std::int32_t block) {
  std::array<Cluster, kWidth> parts;
  for (int i = 0; i < kWidth; ++i) {
    const std::uint32_t primitive = hierarchy.blocks[static_cast<std::size_t>(block)].primitive[i];
    if (primitive == kNoPrimitive) break;
    std::array<Vec3, 3> corners = hierarchy.corners(primitive);
    for (Vec3& corner : corners) corner -= hierarchy.origin;
    parts[static_cast<std::size_t>(i)] = triangle_cluster(corners);
  }
  return join(parts);
}

std::vector<Cluster> make_clusters(const Scene::Hierarchy& hierarchy, int num_threads) {
  const std::size_t node_count = hierarchy.nodes.size();
  std::vector<Cluster> clusters(kWidth * node_count);
  constexpr std::size_t kGrain = 256;
  parallel_for(node_count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      for (std::size_t lane = 0; lane < kWidth; ++lane) {
        const std::int32_t child = hierarchy.nodes[n].child[lane];
        if (child < 0 && child != kNoChild) {
          clusters[kWidth * n + lane] = block_cluster(hierarchy, ~child);
        }
      }
    }
  });
  for (std::size_t n = node_count; n-- > 0;) {  // children come after their parent
    const WideNode& node = hierarchy.nodes[n];
    for (int lane = 0; lane < kWidth; ++lane) {
      if (node.child[lane] == kNoChild) continue;
      Cluster& cluster = clusters[kWidth * n + static_cast<std::size_t>(lane)];
      if (node.child[lane] >= 0) {
        std::array<Cluster, kWidth> parts;
        const auto first = kWidth * static_cast<std::size_t>(node.child[lane]);
        std::copy_n(clusters.begin() + static_cast<std::ptrdiff_t>(first), kWidth, parts.begin());
        cluster = join(parts);
      }
      cluster.radius = farthest(node, lane, cluster.centre);
    }
  }
  return clusters;
}

struct Winding {
  double number = 0.0;
  bool on_surface = false;
};

class WindingWalk {
 public:
  WindingWalk(const Scene::Hierarchy& hierarchy, const std::vector<Cluster>& clusters,
              double accuracy)
      : hierarchy_(hierarchy), clusters_(clusters), accuracy_(accuracy) {}

  /// `rounding`: how far the query may be off what was asked for [m].
  Winding at(const Vec3& query, double rounding = 0.0) const {
    const Vec3 local = query - hierarchy_.origin;
    double angle = 0.0;
    bool on_surface = false;
    std::array<std::int32_t, kStackSize> stack;
    std::size_t depth = 0;
    if (!hierarchy_.nodes.empty()) stack[depth++] = 0;
    while (depth > 0) {
      const auto n = static_cast<std::size_t>(stack[--depth]);
      const WideNode& node = hierarchy_.nodes[n];
      for (std::size_t lane = 0; lane < kWidth; ++lane) {
        const std::int32_t child = node.child[lane];
        if (child == kNoChild) continue;
        const Cluster& cluster = clusters_[kWidth * n + lane];
        const Vec3 r = cluster.centre - local;
        const double distance = r.norm();
        if (is_far(cluster, distance)) {
          angle += far_angle(cluster, r, distance);
        } else if (child >= 0) {
          stack[depth++] = child;
        } else {
          angle += near_angle(hierarchy_.blocks[static_cast<std::size_t>(~child)], query, rounding,
                              on_surface);
        }
      }
    }
    return {angle / (4.0 * std::numbers::pi), on_surface};
  }

 private:
  /// Whether the terms left out are small: at most 3 · spread / gap⁴ (the third derivative of 1/r
  /// is at most 6/r⁴), against the angle area / distance² of the cluster seen face on.
  bool is_far(const Cluster& cluster, double distance) const {
    const double gap = distance - cluster.radius;
    const double gap2 = gap * gap;
    return gap > 0.0 &&
           3.0 * cluster.spread * distance * distance <= accuracy_ * cluster.area * gap2 * gap2;
  }

  /// ∫ n · (x − q) / |x − q|³ dA with the integrand's first two terms about the centre.
  static double far_angle(const Cluster& cluster, const Vec3& r, double distance) {
    const double d2 = distance * distance;
    const double d3 = d2 * distance;
    return (cluster.area_vector.dot(r) + cluster.moment.trace() -
            3.0 * r.dot(cluster.moment * r) / d2) /
           d3;
  }

  double near_angle(const TriangleBlock& block, const Vec3& query, double rounding,
                    bool& on_surface) const {
    double angle = 0.0;
    for (const std::uint32_t primitive : block.primitive) {
      if (primitive == kNoPrimitive) break;
      const std::array<Vec3, 3> corners = hierarchy_.corners(primitive);
      if (touches(corners, query, rounding)) {  // adds the mean of its two sides: nothing
        on_surface = true;
        continue;
      }
      angle += solid_angle({corners[0] - query, corners[1] - query, corners[2] - query});
    }
    return angle;
  }

  /// Whether the query lies on the triangle to the rounding of its coordinates.
  static bool touches(const std::array<Vec3, 3>& corners, const Vec3& query, double rounding) {
    const Vec3 a = corners[0] - query;
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
    const double slack =
        kRounding * (query.lpNorm<Eigen::Infinity>() + a.lpNorm<Eigen::Infinity>()) + rounding;
    if (std::abs(a.dot(normal)) > slack * normal.lpNorm<1>()) return false;
    return closest_point(corners, query).squared_distance <= slack * slack;
  }

  const Scene::Hierarchy& hierarchy_;
  const std::vector<Cluster>& clusters_;
  double accuracy_;
};

/// Which hierarchies a point winds in, and where they lie: one without a frame, or instances.
class Windings {
 public:
  Windings(const Scene::Hierarchy* whole, const Scene::Instances* instances, double accuracy,
           int num_threads)
      : instances_(instances) {
    const auto add = [&](const Scene::Hierarchy& hierarchy) {
      walks_.emplace_back(hierarchy, hierarchy.clusters.of(hierarchy, num_threads), accuracy);
    };
    if (instances == nullptr) {
      add(*whole);
      return;
    }
    for (const auto& hierarchy : instances->shared->hierarchies) add(*hierarchy);
  }

  /// The sum over instances: moving, turning and scaling a mesh with the point changes no angle.
  Winding at(const Vec3& point) const {
    if (instances_ == nullptr) return walks_[0].at(point);
    Winding sum;
    for (const InstanceFrame& frame : instances_->frames) {
      const WindingWalk& walk = walks_[static_cast<std::size_t>(frame.mesh)];
      const Winding part = frame.at_identity
                               ? walk.at(point)
                               : walk.at(to_mesh(frame, point), rounding(frame, point));
      sum.number += part.number;
      sum.on_surface = sum.on_surface || part.on_surface;
    }
    return sum;
  }

 private:
  /// What moving the point into the frame may be off by, in it [m].
  static double rounding(const InstanceFrame& frame, const Vec3& point) {
    constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
    const Vec3 position(frame.position);
    return kRounding * frame.per_metre *
           (point.lpNorm<Eigen::Infinity>() + position.lpNorm<Eigen::Infinity>());
  }

  const Scene::Instances* instances_;
  std::vector<WindingWalk> walks_;  ///< of each distinct mesh
};

std::vector<Winding> find_windings(const Windings& windings, PointView points, int num_threads) {
  std::vector<Winding> found(static_cast<std::size_t>(points.rows()));
  constexpr std::size_t kGrain = 64;
  parallel_for(found.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      found[i] = windings.at(points.row(static_cast<Index>(i)).transpose());
    }
  });
  return found;
}

}  // namespace

const std::vector<Cluster>& Clusters::of(const Scene::Hierarchy& hierarchy, int num_threads) const {
  std::call_once(made_, [&] {
    clusters_ = make_clusters(hierarchy, num_threads);
    bytes_ = clusters_.size() * sizeof(Cluster);
  });
  return clusters_;
}

}  // namespace scene

std::vector<double> Scene::winding_number(PointView points, const WindingOptions& options,
                                          int num_threads) const {
  options.check();
  check_points_finite("points", points);
  const scene::Windings windings(hierarchy_.get(), instances_.get(), options.accuracy, num_threads);
  std::vector<double> numbers;
  numbers.reserve(static_cast<std::size_t>(points.rows()));
  for (const auto& found : scene::find_windings(windings, points, num_threads)) {
    numbers.push_back(found.number);
  }
  return numbers;
}

std::vector<bool> Scene::contains(PointView points, const WindingOptions& options,
                                  int num_threads) const {
  options.check();
  check_points_finite("points", points);
  const scene::Windings windings(hierarchy_.get(), instances_.get(), options.accuracy, num_threads);
  std::vector<bool> inside;
  inside.reserve(static_cast<std::size_t>(points.rows()));
  for (const auto& found : scene::find_windings(windings, points, num_threads)) {
    inside.push_back(found.on_surface || std::abs(found.number) > 0.5);
  }
  return inside;
}

}  // namespace bathyal
