// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/ball.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bathyal::toolpath {
namespace {

Vec3 closest_on_edge_to_origin(const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double squared = edge.squaredNorm();
  if (!(squared > 0.0)) return a;
  return a + std::clamp(-edge.dot(a) / squared, 0.0, 1.0) * edge;
}

/// The point of the triangle nearest to the origin; one without area counts as its edges.
Vec3 closest_to_origin(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  const double u = -normal.dot(a.cross(ac)), v = -normal.dot(ab.cross(a));
  if (area > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= area) return normal.dot(a) / area * normal;
  Vec3 best = closest_on_edge_to_origin(a, b);
  for (const Vec3& other : {closest_on_edge_to_origin(b, c), closest_on_edge_to_origin(c, a)}) {
    if (other.squaredNorm() < best.squaredNorm()) best = other;
  }
  return best;
}

double reach_of(const Scene& scene) {
  double reach = 0.0;
  for (std::int32_t m = 0; m < scene.row_count(); ++m) {
    const TriangleMesh mesh = scene.mesh_in_world(m);
    if (mesh.vertex_count() > 0) reach = std::max(reach, mesh.vertices().cwiseAbs().maxCoeff());
  }
  return reach;
}

}  // namespace

Ball::Ball(const Scene& scene, double radius)
    : scene_(scene),
      radius_(radius),
      slack_(8.0 * std::numeric_limits<double>::epsilon() * (reach_of(scene) + radius)) {}

Touch Ball::nearest(const Vec3& centre) const {
  const NearestPoint found = scene_.nearest(centre);
  Touch touch{found.point, Vec3::Zero(), found.distance, found.mesh, found.triangle};
  if (found.distance > 0.0 && found.mesh >= 0) touch.toward = (centre - found.point).normalized();
  return touch;
}

Touch Ball::touch(std::int32_t mesh, std::int32_t triangle, const Vec3& centre) const {
  const Vec3 away = closest_to_origin(scene_.corner(mesh, triangle, 0) - centre,
                                      scene_.corner(mesh, triangle, 1) - centre,
                                      scene_.corner(mesh, triangle, 2) - centre);
  const double distance = away.norm();
  return {centre + away, distance > 0.0 ? Vec3(-away / distance) : Vec3(Vec3::Zero()), distance,
          mesh, triangle};
}

bool Ball::is_free(const Vec3& from, const Vec3& to) const {
  return !(scene_.nearest_segment(from, to, {2.0 * radius_}).distance < radius_);
}

std::optional<Vec3> Ball::lift(const Vec3& from, const Vec3& direction, double reach) const {
  const auto shortfall = [&](double t) {
    return rolling_radius() - nearest(from + t * direction).distance;
  };
  // The distance grows by no more than the way, so that no free centre lies within the shortfall;
  // the shortest step keeps a grazing direction from never arriving.
  const double shortest = 1e-4 * radius_;
  double low = 0.0, high = 0.0;
  double missing = shortfall(0.0);
  while (missing > 0.0) {
    low = high;
    high += std::max(missing, shortest);
    if (high > reach) return std::nullopt;
    missing = shortfall(high);
  }
  for (int i = 0; i < 60 && high - low > 0.25 * slack_ && missing < -0.25 * slack_; ++i) {
    const double middle = 0.5 * (low + high);
    const double there = shortfall(middle);
    if (there > 0.0) {
      low = middle;
    } else {
      high = middle;
      missing = there;
    }
  }
  return from + high * direction;
}

std::optional<Vec3> Ball::lay(const Vec3& near, const Vec3& direction) const {
  for (const double back : {0.0, 0.25, 0.5, 1.0, 1.5, 2.0}) {
    const Vec3 from = near - back * radius_ * direction;
    if (!is_free(from)) return lift(from, direction, 30.0 * radius_);
  }
  return near;
}

}  // namespace bathyal::toolpath
