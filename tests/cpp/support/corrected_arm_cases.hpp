// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "bathyal/compensation/corrected_arm.hpp"
#include "bathyal/geometry/rotation_vector.hpp"
#include "support/arms.hpp"

// Poses and cases that tests of corrected arms share.

namespace bathyal {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline RowMatrix column(std::vector<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
}

/// Within ±1 of every joint, 10 … 30 °C, sessions 1 and 2, up to 200 s and 2 kg.
inline Support some_support(const Arm& arm) {
  RowMatrix q(2, arm.size());
  q.row(0).setConstant(-1.0);
  q.row(1).setConstant(1.0);
  return support_of(q, {{"temperature", column({10.0, 30.0})},
                        {"session", column({1.0, 2.0})},
                        {"time", column({0.0, 200.0})},
                        {"payload", column({0.0, 2.0})}});
}

inline JointMatrix poses_within(const Arm& arm, Index count, std::uint64_t seed) {
  RandomStream random(seed);
  JointMatrix q(count, arm.size());
  for (Index i = 0; i < q.size(); ++i) q.data()[i] = random.uniform(-0.99, 0.99);
  return q;
}

inline Covariates some_covariates() {
  return {{"temperature", column({26.0})},
          {"session", column({2.0})},
          {"time", column({150.0})},
          {"payload", column({1.5})}};
}

inline Pose pose_at(const std::vector<double>& poses, Index row) {
  Pose pose;
  pose.matrix() = Eigen::Map<const RowMajor4>(&poses[16 * static_cast<std::size_t>(row)]);
  return pose;
}

inline double difference(const std::vector<double>& one, const std::vector<double>& other) {
  const auto size = static_cast<Index>(one.size());
  return (Eigen::Map<const Eigen::VectorXd>(one.data(), size) -
          Eigen::Map<const Eigen::VectorXd>(other.data(), size))
      .lpNorm<Eigen::Infinity>();
}

inline Pose twist(const Eigen::Vector<double, 6>& numbers) {
  Pose pose;
  pose.matrix().setIdentity();
  pose.translation() = numbers.head(3);
  pose.linear() = rotation_of(numbers.tail(3));
  return pose;
}

}  // namespace bathyal
