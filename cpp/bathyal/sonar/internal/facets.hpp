// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/scene/scene.hpp"

namespace bathyal::sonar {

/// The triangles of a scene, for the normals of what rays meet. The scene must outlive it.
class Facets {
 public:
  explicit Facets(const Scene& scene);

  /// Unit normal in the world of the triangle that was hit, as it is wound. Zero of one without
  /// area.
  Vec3 normal(const RayHit& hit) const;

  /// Its longest edge [m].
  double longest_edge(const RayHit& hit) const;

 private:
  struct Mesh {
    const double* vertices;
    const std::int32_t* triangles;
    double scale = 1.0;
    std::ptrdiff_t turned = -1;  ///< row of turns_; −1 at the identity
  };
  std::vector<Mesh> meshes_;
  std::vector<Eigen::Matrix3d> turns_;
};

}  // namespace bathyal::sonar
