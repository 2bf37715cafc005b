// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/targets.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/toolpath/internal/hole.hpp"

namespace bathyal {
namespace {

using namespace toolpath;

constexpr double kParallel = 1e-12;  // |m·d| of an axis that runs along the plane

Targets no_targets(std::size_t count) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Targets targets;
  targets.point.assign(count, Vec3::Constant(nan));
  targets.normal.assign(count, Vec3::Constant(nan));
  targets.mesh.assign(count, -1);
  targets.triangle.assign(count, -1);
  targets.barycentric.assign(count, Vec3::Constant(nan));
  targets.range.assign(count, std::numeric_limits<double>::infinity());
  targets.incidence.assign(count, nan);
  targets.status.assign(count, TargetStatus::kMiss);
  return targets;
}

/// Fills row i for an axis that meets the bottom at `range`.
void set_found(Targets& targets, std::size_t i, const Vec3& direction, const Vec3& point,
               const Vec3& normal, double range, double grazing_angle) {
  targets.point[i] = point;
  targets.normal[i] = normal;
  targets.range[i] = range;
  targets.incidence[i] = std::atan2(direction.cross(normal).norm(), -direction.dot(normal));
  targets.status[i] =
      targets.incidence[i] > grazing_angle ? TargetStatus::kGrazing : TargetStatus::kHit;
}

Targets find_on(const Plane& plane, const Aims& aims, const TargetOptions& options) {
  Targets targets = no_targets(static_cast<std::size_t>(aims.rows()));
  const Vec3 normal = outward_normal(plane, options.reference.up());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Vec3 origin = aims.row(static_cast<Index>(i)).head<3>();
    const Vec3 direction = aims.row(static_cast<Index>(i)).tail<3>();
    const double slope = plane.normal().dot(direction);
    if (std::abs(slope) <= kParallel) {
      targets.status[i] = TargetStatus::kParallel;
      continue;
    }
    const double t = -plane.distance(origin) / slope;  // eq 3
    if (t < 0.0) {
      targets.status[i] = TargetStatus::kBehind;
    } else if (t <= options.max_range) {
      set_found(targets, i, direction, origin + t * direction, normal, t, options.grazing_angle);
    }
  }
  return targets;
}

/// Why an axis met nothing ahead.
TargetStatus explain_miss(const Scene& scene, const Eigen::AlignedBox3d& bounds, const Vec3& origin,
                          const Vec3& direction, const Vec3& up) {
  if (passes_through_gap(scene, bounds, origin, direction, up)) return TargetStatus::kHole;
  const RayHit behind = scene.cast(origin, -direction);
  return behind.triangle >= 0 ? TargetStatus::kBehind : TargetStatus::kMiss;
}

void set_hit(Targets& targets, std::size_t i, const Scene& scene, const RayHit& hit,
             const Vec3& direction, double grazing_angle) {
  // eq 4, from the differences to V0: the sum of three weighted survey coordinates loses digits.
  set_found(targets, i, direction, hit_point(scene, hit),
            outward_normal(scene, hit.mesh, hit.triangle), hit.range, grazing_angle);
  targets.mesh[i] = hit.mesh;
  targets.triangle[i] = hit.triangle;
  targets.barycentric[i] = Vec3(hit.u, hit.v, 1.0 - hit.u - hit.v);
}

Targets find_on(const Scene& scene, const Aims& aims, const TargetOptions& options) {
  Targets targets = no_targets(static_cast<std::size_t>(aims.rows()));
  const Vec3 up = options.reference.up();
  const Eigen::AlignedBox3d bounds = bounds_of(scene);
  parallel_for(targets.size(), 64, options.num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 origin = aims.row(static_cast<Index>(i)).head<3>();
      const Vec3 direction = aims.row(static_cast<Index>(i)).tail<3>();
      const RayHit hit = scene.cast(origin, direction);
      if (hit.triangle < 0) {
        targets.status[i] = explain_miss(scene, bounds, origin, direction, up);
      } else if (hit.range <= options.max_range) {
        set_hit(targets, i, scene, hit, direction, options.grazing_angle);
      }
    }
  });
  return targets;
}

}  // namespace

std::string_view to_text(TargetStatus status) {
  switch (status) {
    case TargetStatus::kHit:
      return "hit";
    case TargetStatus::kMiss:
      return "miss";
    case TargetStatus::kParallel:
      return "parallel";
    case TargetStatus::kBehind:
      return "behind";
    case TargetStatus::kHole:
      return "hole";
    case TargetStatus::kGrazing:
      return "grazing";
  }
  return "miss";
}

void TargetOptions::check() const {
  reference.check();
  check_positive("grazing_angle", grazing_angle);
  check_range("grazing_angle", grazing_angle, 0.0, std::numbers::pi);
  if (!(max_range > 0.0)) throw_argument("max_range", "a number above 0", to_text(max_range));
  resolve_threads(num_threads);
}

Targets find_targets(const Surface& surface, const Aims& aims, const TargetOptions& options) {
  options.check();
  const Aims world = options.reference.to_world(aims);
  return std::visit([&](const auto& bottom) { return find_on(bottom, world, options); }, surface);
}

Vec3 outward_normal(const Plane& plane, const Vec3& up) {
  return plane.normal().dot(up) < -kParallel ? Vec3(-plane.normal()) : plane.normal();
}

Vec3 outward_normal(const TriangleMesh& mesh, std::int32_t triangle) {
  const Vec3 area = mesh.area_vector(triangle);
  const double length = area.norm();
  return length > 0.0 ? Vec3(area / length) : Vec3(Vec3::Zero());
}

Vec3 outward_normal(const Scene& scene, std::int32_t mesh, std::int32_t triangle) {
  const TriangleMesh& own = scene.meshes()[static_cast<std::size_t>(mesh)];
  return scene.turn_to_world(mesh, outward_normal(own, triangle));
}

}  // namespace bathyal
