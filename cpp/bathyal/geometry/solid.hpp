// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <string_view>

#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal {

/// What a closed mesh holds.
struct SolidMoments {
  double volume = 0.0;                               ///< [m³]
  Vec3 centroid = Vec3::Zero();                      ///< [m]
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< ∫ r rᵀ dV about the centroid [m⁵]
};

/// By tetrahedra from the middle of the mesh; one turned inside out counts as turned right.
/// \param name of the argument in messages
/// \throw std::invalid_argument for a mesh that is not closed or holds no volume
SolidMoments solid_moments(const TriangleMesh& mesh, std::string_view name);

}  // namespace bathyal
