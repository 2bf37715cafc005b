// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/vehicle_motion.hpp"

#include <algorithm>
#include <cstddef>

#include "bathyal/base/check.hpp"

namespace bathyal {

void VehicleMotion::check() const {
  constexpr double kFastest = 100.0;
  for (int axis = 0; axis < 3; ++axis) {
    check_range("velocity", velocity[axis], -kFastest, kFastest);
    check_range("angular_velocity", rate[axis], -kFastest, kFastest);
  }
}

VehicleMotion motion_at(const Trajectory& world_from_vehicle, double time) {
  const std::vector<double>& times = world_from_vehicle.time();
  if (!world_from_vehicle.moves() || time < times.front() || time > times.back()) return {};
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  const auto next = std::min(static_cast<std::size_t>(after - times.begin()), times.size() - 1);
  const double span = times[next] - times[next - 1];
  const Pose& from = world_from_vehicle.pose()[next - 1];
  const Pose& to = world_from_vehicle.pose()[next];
  const Eigen::AngleAxisd turn(to.linear() * from.linear().transpose());
  return {(to.translation() - from.translation()) / span, turn.axis() * (turn.angle() / span)};
}

}  // namespace bathyal
