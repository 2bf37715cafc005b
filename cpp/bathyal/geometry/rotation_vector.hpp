// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// exp: the rotation about `vector` by its length [rad].
inline Eigen::Matrix3d rotation_of(const Vec3& vector) {
  const double angle = vector.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

/// log: the vector of a rotation, of length 0 … pi.
inline Vec3 vector_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond turn(rotation);
  const double half_sine = turn.vec().norm();
  if (half_sine == 0.0) return Vec3::Zero();
  return 2.0 * std::atan2(half_sine, std::abs(turn.w())) *
         std::copysign(1.0 / half_sine, turn.w()) * turn.vec();
}

/// The left Jacobian of rotation vectors: exp(v + dv) = exp(J dv) exp(v) to first order.
inline Eigen::Matrix3d left_jacobian(const Vec3& vector) {
  Eigen::Matrix3d cross;
  cross << 0.0, -vector.z(), vector.y(), vector.z(), 0.0, -vector.x(), -vector.y(), vector.x(), 0.0;
  const double angle = vector.norm();
  if (angle < 1e-4) return Eigen::Matrix3d::Identity() + 0.5 * cross + cross * cross / 6.0;
  const double square = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / square * cross +
         (angle - std::sin(angle)) / (square * angle) * (cross * cross);
}

}  // namespace bathyal
