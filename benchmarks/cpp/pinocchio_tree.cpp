// SPDX-License-Identifier: BSD-3-Clause
#include "pinocchio_tree.hpp"

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/config.hpp>
#include <pinocchio/multibody.hpp>

namespace bathyal {
namespace {

pinocchio::Inertia inertia_of(const RigidBody& body) {
  return {body.mass, body.center_of_mass, body.inertia};
}

}  // namespace

struct PinocchioTree::State {
  pinocchio::Model model;
  pinocchio::Data data;
};

PinocchioTree::PinocchioTree(const BodyTreeOptions& options) : state_(std::make_unique<State>()) {
  pinocchio::Model& model = state_->model;
  model.gravity.linear(Vec3(0.0, 0.0, -options.vehicle.gravity));
  pinocchio::JointIndex last =
      model.addJoint(0, pinocchio::JointModelFreeFlyer(), pinocchio::SE3::Identity(), "hull");
  model.appendBodyToJoint(last, inertia_of(options.vehicle.body));
  for (const TreeLink& link : options.links) {
    const pinocchio::SE3 at(link.parent_from_link.linear(), link.parent_from_link.translation());
    last = model.addJoint(last, pinocchio::JointModelRZ(), at, link.name);
    model.appendBodyToJoint(last, inertia_of(link.body));
  }
  state_->data = pinocchio::Data(model);
}

PinocchioTree::~PinocchioTree() = default;

const Eigen::VectorXd& PinocchioTree::accelerations(const Eigen::VectorXd& q,
                                                    const Eigen::VectorXd& velocity,
                                                    const Eigen::VectorXd& efforts) {
  return pinocchio::aba(state_->model, state_->data, q, velocity, efforts);
}

const char* PinocchioTree::version() { return PINOCCHIO_VERSION; }

}  // namespace bathyal
