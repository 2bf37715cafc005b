// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "bathyal/geometry/triangle_mesh.hpp"
#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

/// What a hull's mesh does not say.
struct FromMeshOptions {
  std::optional<double> mass = {};              ///< [kg]; unset: that of the water displaced
  std::optional<Vec3> center_of_mass = {};      ///< in the mesh's frame [m]; unset: that of volume
  std::optional<Eigen::Matrix3d> inertia = {};  ///< about it [kg m²]; unset: of an even solid
  Vec3 drag_coefficient = Vec3::Ones();  ///< of flow along x, y, z, by the ellipsoid's shadow
  double gravity = 9.80665;              ///< [m/s²]
  double water_density = 1025.0;         ///< [kg/m³]

  /// \throw std::invalid_argument
  void check() const;
};

struct VehicleFromMesh {
  VehicleOptions options;
  Pose vehicle_from_mesh = Pose::Identity();  ///< its origin is the centre of buoyancy
  Vec3 half_axes = Vec3::Zero();  ///< of the ellipsoid of equal volume and proportions [m]
};

/// A first model of a vehicle from its closed hull, axes x forward, y port, z up. Added mass and
/// drag are those of the ellipsoid whose volume is the hull's and whose half axes are as the roots
/// of the hull's principal second moments; it may lie askew. Drag is ½ ρ C A v², and across turning
/// axes the same by strips. \throw std::invalid_argument for a mesh that is not closed, or values
/// out of range
VehicleFromMesh vehicle_from_mesh(const TriangleMesh& mesh, const FromMeshOptions& options = {});

}  // namespace bathyal
