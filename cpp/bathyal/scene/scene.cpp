// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/scene.hpp"

#include <limits>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"

namespace bathyal {
namespace {

const Vec3 kNowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

/// The unit vector across the longest edge that points up most; some triangle without area.
Vec3 across_longest_edge(const TriangleMesh& mesh, Index triangle) {
  Vec3 longest = Vec3::Zero();
  for (int c = 0; c < 3; ++c) {
    const Vec3 edge = mesh.corner(triangle, (c + 1) % 3) - mesh.corner(triangle, c);
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  }
  const Vec3 along = longest.stableNormalized();
  const Vec3 across = Vec3::UnitZ() - along.z() * along;
  if (across.norm() > 1e-8) return across.normalized();
  return (Vec3::UnitX() - along.x() * along).normalized();
}

}  // namespace

Vec3 hit_point(const std::vector<TriangleMesh>& meshes, const RayHit& hit) {
  if (hit.triangle < 0) return kNowhere;
  const TriangleMesh& mesh = meshes[static_cast<std::size_t>(hit.mesh)];
  const Vec3 v0 = mesh.corner(hit.triangle, 0);
  return v0 + hit.u * (mesh.corner(hit.triangle, 1) - v0) +
         hit.v * (mesh.corner(hit.triangle, 2) - v0);
}

Vec3 hit_normal(const std::vector<TriangleMesh>& meshes, const RayHit& hit) {
  if (hit.triangle < 0) return kNowhere;
  const TriangleMesh& mesh = meshes[static_cast<std::size_t>(hit.mesh)];
  const Vec3 normal = mesh.area_vector(hit.triangle).stableNormalized();
  return normal.isZero() ? across_longest_edge(mesh, hit.triangle) : normal;
}

Scene::Scene(std::vector<TriangleMesh> meshes, int num_threads) {
  if (meshes.empty()) throw_argument("meshes", "one mesh or more", "none");
  hierarchy_ = std::make_shared<const Hierarchy>(std::move(meshes), num_threads);
}

const std::vector<TriangleMesh>& Scene::meshes() const { return hierarchy_->meshes; }

std::size_t Scene::memory() const { return hierarchy_->memory(); }

const Scene::Hierarchy& Scene::hierarchy() const { return *hierarchy_; }

}  // namespace bathyal
