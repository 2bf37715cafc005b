// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "bathyal/base/error.hpp"
#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// A motion of finite numbers whose rotation is one to 1e-6.
inline void check_rigid(std::string_view name, const Pose& pose) {
  if (!pose.matrix().allFinite()) throw_argument(name, "finite numbers", "nan or inf");
  if (pose.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    throw_argument(name, "a rigid motion with last row 0 0 0 1", "another last row");
  }
  const Eigen::Matrix3d rotation = pose.linear();
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (error > 1e-6 || rotation.determinant() < 0.0) {
    throw_argument(name, "a rotation of determinant 1 beside the translation",
                   "one that is off by " + to_text(error));
  }
}

}  // namespace bathyal
