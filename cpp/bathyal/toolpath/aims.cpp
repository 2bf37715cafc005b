// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/aims.hpp"

#include <cmath>
#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal {

void Vehicle::check() const {
  constexpr double kRigid = 1e-6;
  const Eigen::Matrix3d r = world_from_vehicle.linear();
  const bool rigid = world_from_vehicle.matrix().allFinite() &&
                     (r.transpose() * r).isIdentity(kRigid) && r.determinant() > 0.0 &&
                     world_from_vehicle.matrix().row(3) == Eigen::RowVector4d(0, 0, 0, 1);
  if (!rigid) {
    throw_argument("world_from_vehicle",
                   "a rigid motion: a right-handed rotation, finite, last row 0 0 0 1",
                   "a matrix with a rotation part of determinant " + to_text(r.determinant()));
  }
}

Vec3 Vehicle::up() const {
  if (vertical == Vertical::kGravity) return Vec3::UnitZ();
  return world_from_vehicle.linear().col(2).normalized();
}

Aims Vehicle::to_world(const Aims& aims) const {
  Aims world(aims.rows(), 6);
  for (Index i = 0; i < aims.rows(); ++i) {
    if (!aims.row(i).allFinite()) {
      throw_argument("aims", "finite numbers", "row " + std::to_string(i) + " that is not");
    }
    Vec3 point = aims.row(i).head<3>();
    Vec3 direction = aims.row(i).tail<3>();
    const double length = direction.stableNorm();
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw_argument("aims", "directions of a length above 0",
                     "row " + std::to_string(i) + " with length " + to_text(length));
    }
    direction /= length;
    direction.normalize();  // again: the quotient of denormal numbers is not of unit length
    if (frame == AimsFrame::kVehicle) {
      point = world_from_vehicle * point;
      direction = world_from_vehicle.linear() * direction;
    }
    world.row(i) << point.transpose(), direction.transpose();
  }
  return world;
}

}  // namespace bathyal
