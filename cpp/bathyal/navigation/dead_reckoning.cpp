// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/dead_reckoning.hpp"

#include "bathyal/navigation/internal/rising_times.hpp"

namespace bathyal {

Eigen::Matrix3d rotation_of_angles(const Vec3& roll_pitch_yaw) {
  return (Eigen::AngleAxisd(roll_pitch_yaw.z(), Vec3::UnitZ()) *
          Eigen::AngleAxisd(roll_pitch_yaw.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(roll_pitch_yaw.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

PointMatrix dead_reckon(const std::vector<double>& time, const PointMatrix& attitude,
                        const PointMatrix& velocity) {
  if (time.empty()) throw_argument("time", "at least one time", "none");
  check_rising_times("time", time);
  check_rows("attitude", attitude, time.size());
  check_rows("velocity", velocity, time.size());
  PointMatrix position(velocity.rows(), 3);
  position.row(0).setZero();
  Vec3 before;
  for (Eigen::Index i = 0; i < velocity.rows(); ++i) {
    const Vec3 now = rotation_of_angles(attitude.row(i).transpose()) * velocity.row(i).transpose();
    if (i > 0) {
      const auto k = static_cast<std::size_t>(i);
      position.row(i) =
          position.row(i - 1) + 0.5 * (time[k] - time[k - 1]) * (before + now).transpose();
    }
    before = now;
  }
  return position;
}

}  // namespace bathyal
