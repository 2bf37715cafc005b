// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <memory>

#include "bathyal/vehicle/tree/body_tree.hpp"

namespace bathyal {

/// A hull with revolute joints about z as a model of Pinocchio, without water.
class PinocchioTree {
 public:
  explicit PinocchioTree(const BodyTreeOptions& options);
  ~PinocchioTree();

  /// q: position, quaternion (x, y, z, w), joints. The result stays until the next call.
  const Eigen::VectorXd& accelerations(const Eigen::VectorXd& q, const Eigen::VectorXd& velocity,
                                       const Eigen::VectorXd& efforts);

  static const char* version();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bathyal
