// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/facets.hpp"

namespace bathyal::sonar {

Facets::Facets(const Scene& scene) {
  for (const TriangleMesh& mesh : scene.meshes()) {
    meshes_.push_back({mesh.vertices().data(), mesh.triangles().data()});
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
  return length > 0.0 ? Vec3(area / length) : Vec3::Zero();
}

}  // namespace bathyal::sonar
