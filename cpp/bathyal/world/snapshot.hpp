// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bathyal/scene/scene.hpp"
#include "bathyal/world/material.hpp"

namespace bathyal {

/// Which material the triangles of an instance are of.
struct SurfaceMaterial {
  std::int32_t whole = 0;  ///< of all of it, where `of_triangle` is empty

  /// Of each triangle, where it is painted; shared between clones.
  std::shared_ptr<const std::vector<std::int16_t>> of_triangle;

  std::int32_t at(std::int32_t triangle) const {
    return of_triangle ? (*of_triangle)[static_cast<std::size_t>(triangle)] : whole;
  }
};

/// A world at one moment: what rays meet, and of what it is made.
struct WorldSnapshot {
  Scene scene;
  std::vector<SurfaceMaterial> surfaces;  ///< of each row of the scene
  std::shared_ptr<const std::vector<Material>> materials;
  double time = 0.0;  ///< [s]

  /// Row of `materials`; −1 where nothing was hit.
  std::int32_t material(const RayHit& hit) const {
    return hit.mesh < 0 ? -1 : surfaces[static_cast<std::size_t>(hit.mesh)].at(hit.triangle);
  }
};

}  // namespace bathyal
