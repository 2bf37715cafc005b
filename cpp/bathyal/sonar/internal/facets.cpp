// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/facets.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal::sonar {

Facets::Facets(const Scene& scene) {
  const std::vector<Pose> poses = scene.poses();
  const std::vector<double> scales = scene.scales();
  for (std::int32_t row = 0; row < scene.row_count(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    const TriangleMesh& mesh = scene.meshes()[at];
    meshes_.push_back({mesh.vertices().data(), mesh.triangles().data(), scales[at]});
    if (scene.is_at_identity(row)) continue;
    meshes_.back().turned = static_cast<std::ptrdiff_t>(turns_.size());
    turns_.push_back(poses[at].linear());
  }
}

Vec3 Facets::normal(const RayHit& hit) const {
  const Mesh& mesh = meshes_[static_cast<std::size_t>(hit.mesh)];
  const std::int32_t* index = mesh.triangles + 3 * std::int64_t{hit.triangle};
  const auto corner = [&](int c) {
    return Eigen::Map<const Vec3>(mesh.vertices + 3 * std::int64_t{index[c]});
  };
  const Vec3 first = corner(0);
  const Vec3 area = (corner(1) - first).cross(corner(2) - first);
  const double length = area.norm();
  if (!(length > 0.0)) return Vec3::Zero();
  const Vec3 normal = area / length;
  return mesh.turned < 0 ? normal : turns_[static_cast<std::size_t>(mesh.turned)] * normal;
}

double Facets::longest_edge(const RayHit& hit) const {
  const Mesh& mesh = meshes_[static_cast<std::size_t>(hit.mesh)];
  const std::int32_t* index = mesh.triangles + 3 * std::int64_t{hit.triangle};
  double longest = 0.0;
  for (int c = 0; c < 3; ++c) {
    const Eigen::Map<const Vec3> from(mesh.vertices + 3 * std::int64_t{index[c]});
    const Eigen::Map<const Vec3> to(mesh.vertices + 3 * std::int64_t{index[(c + 1) % 3]});
    longest = std::max(longest, (to - from).squaredNorm());
  }
  return mesh.scale * std::sqrt(longest);
}

}  // namespace bathyal::sonar
