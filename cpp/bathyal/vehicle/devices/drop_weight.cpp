// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/devices/drop_weight.hpp"

#include "bathyal/base/check.hpp"

namespace bathyal {

void DropWeightOptions::check() const {
  if (!position.allFinite()) throw_argument("position", "finite numbers", "others");
  check_not_negative("mass", mass);
  check_not_negative("volume", volume);
}

Vec6 drop_weight_wrench(const DropWeightOptions& weight, const DropWeightState& state,
                        const VehicleOptions& vehicle, const Pose& world_from_vehicle) {
  Vec6 wrench = Vec6::Zero();
  if (state.released != 0) return wrench;
  const double size = (weight.mass - vehicle.water_density * weight.volume) * vehicle.gravity;
  const Vec3 force = -size * world_from_vehicle.linear().row(2).transpose();
  wrench << force, weight.position.cross(force);
  return wrench;
}

}  // namespace bathyal
