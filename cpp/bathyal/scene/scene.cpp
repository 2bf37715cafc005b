// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/scene.hpp"

#include <array>
#include <limits>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/instances.hpp"

namespace bathyal {
namespace {

const Vec3 kNowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

/// The unit vector across the longest edge that points up most; of a triangle without area.
Vec3 across_longest_edge(const std::array<Vec3, 3>& corners) {
  Vec3 longest = Vec3::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 edge = corners[(c + 1) % 3] - corners[c];
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  }
  const Vec3 along = longest.stableNormalized();
  const Vec3 across = Vec3::UnitZ() - along.z() * along;
  if (across.norm() > 1e-8) return across.normalized();
  return (Vec3::UnitX() - along.x() * along).normalized();
}

std::vector<TriangleMesh> some_meshes(std::vector<TriangleMesh> meshes) {
  if (meshes.empty()) throw_argument("meshes", "one mesh or more", "none");
  return meshes;
}

}  // namespace

Scene::Scene(std::vector<TriangleMesh> meshes, int num_threads)
    : hierarchy_(std::make_shared<const Hierarchy>(some_meshes(std::move(meshes)), num_threads)) {}

Scene::Scene(std::vector<TriangleMesh> meshes, const std::vector<Pose>& poses,
             const std::vector<double>& scales, int num_threads)
    : instances_(std::make_shared<const Instances>(
          std::make_shared<const scene::InstanceMeshes>(some_meshes(std::move(meshes)), nullptr,
                                                        num_threads),
          poses, scales, num_threads)) {}

Scene::Scene(std::shared_ptr<const Instances> instances) : instances_(std::move(instances)) {}

Scene Scene::with_poses(const std::vector<Pose>& poses, int num_threads) const {
  if (instances_) {
    return Scene(
        std::make_shared<const Instances>(instances_->shared, poses, scales(), num_threads));
  }
  const bool is_one = hierarchy_->meshes.size() == 1;
  auto shared = std::make_shared<const scene::InstanceMeshes>(
      hierarchy_->meshes, is_one ? hierarchy_ : nullptr, num_threads);
  return Scene(std::make_shared<const Instances>(std::move(shared), poses, std::vector<double>(),
                                                 num_threads));
}

const std::vector<TriangleMesh>& Scene::meshes() const {
  return instances_ ? instances_->shared->meshes : hierarchy_->meshes;
}

std::vector<Pose> Scene::poses() const {
  std::vector<Pose> poses(meshes().size(), Pose::Identity());
  if (!instances_) return poses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i] = scene::pose_of(instances_->frames[i]);
  }
  return poses;
}

std::vector<double> Scene::scales() const {
  std::vector<double> scales(meshes().size(), 1.0);
  if (!instances_) return scales;
  for (std::size_t i = 0; i < scales.size(); ++i) scales[i] = instances_->frames[i].scale;
  return scales;
}

bool Scene::is_at_identity(std::int32_t mesh) const {
  return !instances_ || instances_->frame(mesh).at_identity;
}

TriangleMesh Scene::mesh_in_world(std::int32_t mesh) const {
  const TriangleMesh& own = meshes()[static_cast<std::size_t>(mesh)];
  if (is_at_identity(mesh)) return own;
  PointMatrix vertices(own.vertex_count(), 3);
  for (Index i = 0; i < vertices.rows(); ++i) {
    vertices.row(i) = scene::to_world(instances_->frame(mesh), own.vertices().row(i).transpose());
  }
  return {Points(std::move(vertices)), own.shared_triangles(), own.attributes()};
}

Vec3 Scene::corner(std::int32_t mesh, Index triangle, int corner) const {
  const Vec3 own = meshes()[static_cast<std::size_t>(mesh)].corner(triangle, corner);
  return is_at_identity(mesh) ? own : scene::to_world(instances_->frame(mesh), own);
}

Vec3 Scene::area_vector(std::int32_t mesh, Index triangle) const {
  const Vec3 own = meshes()[static_cast<std::size_t>(mesh)].area_vector(triangle);
  if (is_at_identity(mesh)) return own;
  const scene::InstanceFrame& frame = instances_->frame(mesh);
  return frame.scale * frame.scale * scene::turn_to_world(frame, own);
}

Vec3 Scene::turn_to_world(std::int32_t mesh, const Vec3& direction) const {
  return is_at_identity(mesh) ? direction
                              : scene::turn_to_world(instances_->frame(mesh), direction);
}

std::size_t Scene::memory() const {
  return instances_ ? instances_->memory() : hierarchy_->memory();
}

Vec3 hit_point(const TriangleMesh& mesh, const RayHit& hit) {
  if (hit.triangle < 0) return kNowhere;
  const Vec3 v0 = mesh.corner(hit.triangle, 0);
  return v0 + hit.u * (mesh.corner(hit.triangle, 1) - v0) +
         hit.v * (mesh.corner(hit.triangle, 2) - v0);
}

Vec3 hit_normal(const TriangleMesh& mesh, const RayHit& hit) {
  if (hit.triangle < 0) return kNowhere;
  const Vec3 normal = mesh.area_vector(hit.triangle).stableNormalized();
  if (!normal.isZero()) return normal;
  return across_longest_edge(
      {mesh.corner(hit.triangle, 0), mesh.corner(hit.triangle, 1), mesh.corner(hit.triangle, 2)});
}

Vec3 hit_point(const Scene& scene, const RayHit& hit) {
  if (hit.triangle < 0) return kNowhere;
  const Vec3 v0 = scene.corner(hit.mesh, hit.triangle, 0);
  return v0 + hit.u * (scene.corner(hit.mesh, hit.triangle, 1) - v0) +
         hit.v * (scene.corner(hit.mesh, hit.triangle, 2) - v0);
}

Vec3 hit_normal(const Scene& scene, const RayHit& hit) {
  if (hit.triangle < 0) return kNowhere;
  const TriangleMesh& own = scene.meshes()[static_cast<std::size_t>(hit.mesh)];
  const Vec3 normal = own.area_vector(hit.triangle).stableNormalized();
  if (!normal.isZero()) return scene.turn_to_world(hit.mesh, normal);
  return across_longest_edge({scene.corner(hit.mesh, hit.triangle, 0),
                              scene.corner(hit.mesh, hit.triangle, 1),
                              scene.corner(hit.mesh, hit.triangle, 2)});
}

}  // namespace bathyal
