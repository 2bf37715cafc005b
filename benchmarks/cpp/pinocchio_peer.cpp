// SPDX-License-Identifier: BSD-3-Clause
#include "pinocchio_peer.hpp"

#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/config.hpp>
#include <pinocchio/multibody.hpp>

namespace bathyal {
namespace {

pinocchio::SE3 to_pinocchio(const Pose& pose) { return {pose.linear(), pose.translation()}; }

Pose turned_row(const DhRow& row) {
  return Eigen::AngleAxisd(row.theta, Vec3::UnitZ()) * Eigen::Translation3d(row.a, 0.0, row.d) *
         Eigen::AngleAxisd(row.alpha, Vec3::UnitX());
}

}  // namespace

struct PinocchioPeer::State {
  pinocchio::Model model;
  pinocchio::Data data;
  pinocchio::JointIndex last = 0;
  pinocchio::FrameIndex tip = 0;
};

PinocchioPeer::PinocchioPeer(const Arm& arm) : state_(std::make_unique<State>()) {
  Pose before = arm.base() * arm.root();
  for (const Joint& joint : arm.joints()) {
    state_->last = state_->model.addJoint(state_->last, pinocchio::JointModelRZ(),
                                          to_pinocchio(before), joint.name);
    before = turned_row(joint.row);
  }
  const pinocchio::SE3 tip = to_pinocchio(before * arm.flange() * arm.tool());
  state_->tip = state_->model.addFrame(
      pinocchio::Frame("tip", state_->last, 0, tip, pinocchio::FrameType::OP_FRAME));
  state_->data = pinocchio::Data(state_->model);
}

PinocchioPeer::~PinocchioPeer() = default;

void PinocchioPeer::forward_and_jacobian(JointView q, double* poses, double* jacobians) {
  using Pose4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  auto& [model, data, last, tip] = *state_;
  Eigen::VectorXd row(q.cols());
  pinocchio::Data::Matrix6x columns = pinocchio::Data::Matrix6x::Zero(6, q.cols());
  for (Index i = 0; i < q.rows(); ++i) {
    row = q.row(i).transpose();
    pinocchio::computeJointJacobians(model, data, row);
    const pinocchio::SE3& pose = pinocchio::updateFramePlacement(model, data, tip);
    pinocchio::getFrameJacobian(model, data, tip, pinocchio::LOCAL_WORLD_ALIGNED, columns);
    Eigen::Map<Pose4> out(poses + 16 * i);
    out.topLeftCorner<3, 3>() = pose.rotation();
    out.topRightCorner<3, 1>() = pose.translation();
    out.row(3) << 0.0, 0.0, 0.0, 1.0;
    Eigen::Map<JointMatrix>(jacobians + 6 * q.cols() * i, 6, q.cols()) = columns;
  }
}

const char* PinocchioPeer::version() { return PINOCCHIO_VERSION; }

}  // namespace bathyal
