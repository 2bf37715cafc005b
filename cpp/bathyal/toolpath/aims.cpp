// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/aims.hpp"

#include <cmath>
#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal {

void AimsReference::check() const { check_rigid("world_from_vehicle", world_from_vehicle); }

Vec3 AimsReference::up() const {
  if (vertical == Vertical::kGravity) return Vec3::UnitZ();
  return world_from_vehicle.linear().col(2).normalized();
}

Aims AimsReference::to_world(const Aims& aims) const {
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
