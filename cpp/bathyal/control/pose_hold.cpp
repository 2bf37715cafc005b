// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/control/pose_hold.hpp"

#include <utility>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

Vec3 rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

}  // namespace

void PoseHoldOptions::check() const {
  for (const double value : frequency) check_positive("frequency", value);
  check_positive("damping", damping);
  check_not_negative("integral", integral);
}

PoseHold::PoseHold(Vehicle vehicle, PoseHoldOptions options)
    : vehicle_(std::move(vehicle)), options_(options) {
  options_.check();
}

Vec3 PoseHold::watched(const Vec3& in_world) const {
  const bool level = options_.axes[0] || options_.axes[1];
  return {level ? in_world.x() : 0.0, level ? in_world.y() : 0.0,
          options_.axes[2] ? in_world.z() : 0.0};
}

Vec6 PoseHold::step(PoseHoldState& state, const VehicleState& measured, const PoseTarget& target,
                    const Vec3& current, double time) const {
  check_positive("time", time);
  const Eigen::Matrix3d world_from_vehicle = measured.world_from_vehicle.linear();
  const Eigen::Matrix3d vehicle_from_world = world_from_vehicle.transpose();
  Vec6 error, gathered = state.integral;
  error << vehicle_from_world * watched(target.world_from_vehicle.translation() -
                                        measured.world_from_vehicle.translation()),
      rotation_vector(vehicle_from_world * target.world_from_vehicle.linear());
  gathered.head<3>() = vehicle_from_world * state.integral.head<3>();
  Vec6 rate = target.velocity - measured.velocity;
  rate.head<3>() = vehicle_from_world * watched(world_from_vehicle * rate.head<3>());
  const Vec6 lacking = vehicle_.mass_matrix().ldlt().solve(state.shortfall);
  Vec6 acceleration = Vec6::Zero(), growth = Vec6::Zero();
  for (int axis = 0; axis < 6; ++axis) {
    if (!options_.axes[static_cast<std::size_t>(axis)]) continue;
    const double w = options_.frequency[static_cast<std::size_t>(axis)], zeta = options_.damping;
    const double third = options_.integral;
    acceleration[axis] = w * w * (1.0 + 2.0 * zeta * third) * error[axis] +
                         w * (2.0 * zeta + third) * rate[axis] + gathered[axis];
    if (third > 0.0) growth[axis] = third * w * w * w * error[axis] + w * lacking[axis];
  }
  Vec6 water = Vec6::Zero();
  water.head<3>() = vehicle_from_world * current;
  Vec6 forward =
      -vehicle_.hydrostatic(measured.world_from_vehicle) - vehicle_.drag(target.velocity - water);
  for (int axis = 0; axis < 6; ++axis) {
    if (!options_.axes[static_cast<std::size_t>(axis)]) forward[axis] = 0.0;
  }
  state.integral.head<3>() += time * (world_from_vehicle * growth.head<3>());
  state.integral.tail<3>() += time * growth.tail<3>();
  Vec6 wrench = vehicle_.mass_matrix() * acceleration + forward;
  for (int axis = 0; axis < 6; ++axis) {
    if (!options_.axes[static_cast<std::size_t>(axis)]) wrench[axis] = 0.0;
  }
  return wrench;
}

}  // namespace bathyal
