// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/pose.hpp"

#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal {

void check_rigid(std::string_view name, const Pose& pose) {
  constexpr double kRigid = 1e-6;
  const Eigen::Matrix3d r = pose.linear();
  const bool rigid = pose.matrix().allFinite() && (r.transpose() * r).isIdentity(kRigid) &&
                     r.determinant() > 0.0 &&
                     pose.matrix().row(3) == Eigen::RowVector4d(0, 0, 0, 1);
  if (rigid) return;
  std::string got = "a rotation part of determinant ";
  got += to_text(r.determinant());
  if (pose.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) got = "another last row";
  if (!pose.matrix().allFinite()) got = "numbers that are not finite";
  throw_argument(name, "a rigid motion: a right-handed rotation, finite, last row 0 0 0 1", got);
}

std::array<double, 16> row_major(const Pose& pose) {
  std::array<double, 16> numbers;
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data()) = pose.matrix();
  return numbers;
}

Pose pose_of_rows(const double* numbers) {
  Pose pose;
  pose.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers);
  return pose;
}

}  // namespace bathyal
