// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/chain_derivatives.hpp"

#include <cmath>
#include <span>

#include "bathyal/geometry/rotation_vector.hpp"

namespace bathyal {

ChainDerivatives::ChainDerivatives(const ArmParameters& parameters, const Eigen::VectorXd& x,
                                   std::vector<int> wanted)
    : parameters_(parameters), wanted_(std::move(wanted)), state_(state_at(parameters, x)) {
  for (const Joint& joint : state_.arm.joints()) {
    const double beta = joint.row.beta;
    steps_.push_back(
        {row_pose(joint.row, joint.type, 0.0), Vec3(std::cos(beta), 0.0, std::sin(beta))});
  }
  for (const Pose& tool : state_.tools) row_from_tool_.push_back(state_.arm.flange() * tool);
  find_turn_axes(x);
  find_effect_terms(x);
}

void ChainDerivatives::find_turn_axes(const Eigen::VectorXd& x) {
  turn_axes_.assign(wanted_.size(), Vec3::Zero());
  for (std::size_t w = 0; w < wanted_.size(); ++w) {
    const auto [kind, index, axis] = parameters_.slots[wanted_[w]];
    if (kind != ParameterKind::kBaseTurn && kind != ParameterKind::kToolTurn &&
        kind != ParameterKind::kPlaneTurn)
      continue;
    Vec3 turn = Vec3::Zero();
    for (std::size_t i = 0; i < parameters_.slots.size(); ++i) {
      const ParameterSlot& other = parameters_.slots[i];
      if (other.kind == kind && other.index == index) turn[other.axis] = x[static_cast<Index>(i)];
    }
    if (kind == ParameterKind::kBaseTurn) {
      turn_axes_[w] = left_jacobian(turn).col(axis);
    } else if (kind == ParameterKind::kToolTurn) {
      turn_axes_[w] = parameters_.tools[index].linear() * left_jacobian(turn).col(axis);
    } else {
      const std::array<Vec3, 2> tilts = tilt_axes(parameters_.planes[index]);
      turn_axes_[w] = left_jacobian(turn[0] * tilts[0] + turn[1] * tilts[1]) * tilts[axis];
    }
  }
}

Pose ChainDerivatives::forward(const ChainPose& pose, Index row, int tool, int station,
                               ChainFrames& frames) const {
  if (!acts(row)) {
    forward_rigid(pose, station, frames);
    return frames.world_from_row.back() * row_from_tool_[tool];
  }
  forward_with_effects(pose.q, row, station, frames);
  return frames.behind.back() * state_.tools[tool];
}

/// As compute_row_frames, with everything that all poses share precomputed.
void ChainDerivatives::forward_rigid(const ChainPose& pose, int station,
                                     ChainFrames& frames) const {
  const std::vector<Joint>& joints = state_.arm.joints();
  const auto coordinates = static_cast<std::size_t>(state_.arm.size());
  frames.world_from_row.resize(joints.size() + 1);
  frames.world_from_row[0] = state_.bases[station] * state_.arm.root();
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const JointMotion motion =
        pose.motions != nullptr
            ? pose.motions[k]
            : motion_of(joints[k], joint_value(joints[k], {pose.q, coordinates}));
    pass_row(k, motion, frames.world_from_row[k], frames.world_from_row[k + 1]);
  }
}

JointMotion motion_of(const Joint& joint, double value) {
  if (joint.type != JointType::kRevolute) return {value, 0.0};
  return {std::cos(value), std::sin(value)};
}

void ChainDerivatives::pass_row(std::size_t k, const JointMotion& motion, const Pose& before,
                                Pose& behind) const {
  Pose moved = before;
  if (state_.arm.joints()[k].type == JointType::kRevolute) {
    const auto [cosine, sine] = motion;
    const Vec3 x = moved.linear().col(0), y = moved.linear().col(1);
    moved.linear().col(0) = cosine * x + sine * y;
    moved.linear().col(1) = cosine * y - sine * x;
  } else {
    moved.translation() += motion.first * moved.linear().col(2);
  }
  const Pose& step = steps_[k].behind_from_moved;
  behind.linear().noalias() = moved.linear() * step.linear();
  behind.translation() = moved.linear() * step.translation() + moved.translation();
}

Pose ChainDerivatives::tip(const ChainPose& joints, Index row, int tool, int station,
                           ChainFrames& frames, double* shift, double* turn, Index stride) const {
  const Pose world_from_tool = forward(joints, row, tool, station, frames);
  if (shift == nullptr) return world_from_tool;

  const Vec3 tip = world_from_tool.translation();
  const bool effects = acts(row);
  if (effects) find_unit_moves(tip, turn != nullptr, frames);
  const std::vector<Pose>& behind_row = effects ? frames.before : frames.world_from_row;
  const double growth = effects ? 1.0 + frames.growth : 1.0;
  const Eigen::Matrix3d flange =
      effects
          ? Eigen::Matrix3d(frames.behind.back().linear())
          : Eigen::Matrix3d(frames.world_from_row.back().linear() * state_.arm.flange().linear());
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const auto [kind, index, axis] = parameters_.slots[wanted_[i]];
    Vec3 move = Vec3::Zero();
    Vec3 turned = Vec3::Zero();
    const auto about = [&](const Vec3& direction, const Vec3& center) {
      turned = direction;
      move = direction.cross(tip - center);
    };
    switch (kind) {
      case ParameterKind::kTheta: {
        const Pose& before = frames.world_from_row[index];
        about(before.linear().col(2), before.translation());
        break;
      }
      case ParameterKind::kD:
        move = growth * frames.world_from_row[index].linear().col(2);
        break;
      case ParameterKind::kA:
      case ParameterKind::kAlpha: {
        const Pose& behind = behind_row[index + 1];
        const Vec3 x = behind.linear() * steps_[index].x_of_row;
        if (kind == ParameterKind::kA) move = growth * x;
        if (kind == ParameterKind::kAlpha) about(x, behind.translation());
        break;
      }
      case ParameterKind::kBeta: {
        // Ry(beta) is the last turn of the row, and leaves y.
        const Pose& behind = behind_row[index + 1];
        about(behind.linear().col(1), behind.translation());
        break;
      }
      case ParameterKind::kToolShift:
        if (index == tool) move = flange.col(axis);
        break;
      case ParameterKind::kToolTurn:
        if (index == tool) turned = flange * turn_axes_[i];
        break;
      case ParameterKind::kBaseShift:
        if (index == station) move = Vec3::Unit(axis);
        break;
      case ParameterKind::kBaseTurn:
        if (index == station) about(turn_axes_[i], state_.bases[station].translation());
        break;
      case ParameterKind::kEffect:
        if (effects) {
          const Eigen::Matrix<double, 6, 1> both = move_of_effect(i, row, frames);
          move = both.head<3>();
          turned = both.tail<3>();
        }
        break;
      case ParameterKind::kPlaneTurn:
      case ParameterKind::kPlaneShift:
        break;
    }
    Eigen::Map<Vec3>(shift + static_cast<Index>(i) * stride) = move;
    if (turn != nullptr) Eigen::Map<Vec3>(turn + static_cast<Index>(i) * stride) = turned;
  }
  return world_from_tool;
}

Eigen::Matrix3Xd ChainDerivatives::joint_jacobian(const double* q, Index row, int tool, int station,
                                                  ChainFrames& frames, Vec3& tip) const {
  tip = forward(q, row, tool, station, frames).translation();
  Eigen::Matrix3Xd jacobian = Eigen::Matrix3Xd::Zero(3, state_.arm.size());
  for (std::size_t k = 0; k < state_.arm.joints().size(); ++k) {
    const Joint& joint = state_.arm.joints()[k];
    if (joint.type == JointType::kFixed) continue;
    const Pose& before = frames.world_from_row[k];
    const Vec3 z = before.linear().col(2);
    const Vec3 move =
        joint.type == JointType::kPrismatic ? z : Vec3(z.cross(tip - before.translation()));
    jacobian.col(joint.coordinate) += joint.multiplier * move;
  }
  return jacobian;
}

}  // namespace bathyal
