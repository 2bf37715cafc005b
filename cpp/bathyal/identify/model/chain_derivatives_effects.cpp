// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <span>

#include "bathyal/geometry/rotation_vector.hpp"
#include "bathyal/identify/model/chain_derivatives.hpp"

// The walk along a chain in which effects act.

namespace bathyal {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

}  // namespace

void TipWalk::find_pulls(const Eigen::VectorXd& x) {
  const auto pulls_of = [&](int column, std::vector<Pull>& out) {
    for (const Action& action : *columns_.actions[columns_.places[column].index]) {
      out.push_back({action.site, action.index, action.values.data(), x[column]});
    }
  };
  for (int i = 0; i < static_cast<int>(columns_.places.size()); ++i) {
    if (columns_.places[i].part == Part::kEffect && x[i] != 0.0) pulls_of(i, active_);
  }
  frame_wanted_.assign(state_.arm.joints().size() + 2, 0);
  for (const int column : wanted_) {
    first_pull_.push_back(wanted_pulls_.size());
    if (columns_.places[column].part == Part::kEffect) pulls_of(column, wanted_pulls_);
  }
  first_pull_.push_back(wanted_pulls_.size());
  for (const Pull& pull : wanted_pulls_) {
    if (pull.site == Site::kJoint) joint_wanted_ = true;
    if (pull.site == Site::kLength) length_wanted_ = true;
    if (pull.site == Site::kFrame) frame_wanted_[pull.index] = 1;
  }
  has_effects_ = !active_.empty() || !wanted_pulls_.empty();
}

void TipWalk::walk_with_effects(const double* q, Index row, int station, WalkFrames& frames) const {
  const std::vector<Joint>& joints = state_.arm.joints();
  const std::size_t rows = joints.size();
  frames.q.assign(q, q + state_.arm.size());
  frames.growth = 0.0;
  frames.put_in.setZero(6, static_cast<Index>(rows) + 2);
  for (const Pull& pull : active_) {
    switch (pull.site) {
      case Site::kJoint:
        frames.q[pull.index] += pull.size * pull.values[row];
        break;
      case Site::kLength:
        frames.growth += pull.size * pull.values[row];
        break;
      case Site::kFrame:
        frames.put_in.col(pull.index) +=
            pull.size * Eigen::Map<const Vector6>(pull.values + 6 * row);
        break;
    }
  }

  frames.world_from_row.resize(rows + 1);
  frames.reached.resize(rows + 2);
  frames.left.resize(rows + 2);
  put_in(0, state_.bases[station], frames);
  frames.world_from_row[0] = frames.left[0] * state_.arm.root();
  for (std::size_t k = 0; k < rows; ++k) {
    const Pose& before = frames.world_from_row[k];
    Pose behind;
    pass_row(k, motion_of(joints[k], joint_value(joints[k], frames.q)), before, behind);
    if (frames.growth != 0.0) {
      const Vec3 x = behind.linear() * steps_[k].x_of_row;
      const DhRow& told = joints[k].row;
      behind.translation() += frames.growth * (told.a * x + told.d * before.linear().col(2));
    }
    put_in(k + 1, behind, frames);
    frames.world_from_row[k + 1] = frames.left[k + 1];
  }
  put_in(rows + 1, frames.left[rows] * state_.arm.flange(), frames);
}

/// Shift, then turn, behind a frame that was reached.
void TipWalk::put_in(std::size_t frame, const Pose& reached, WalkFrames& frames) const {
  frames.reached[frame] = reached;
  Pose& left = frames.left[frame];
  left = reached;
  const auto both = frames.put_in.col(static_cast<Index>(frame));
  if (both.isZero(0.0)) return;
  left.translation() += reached.linear() * both.head<3>();
  left.linear() = reached.linear() * rotation_of(both.tail<3>());
}

/// What a unit of each action that is wanted does, for all columns of it together.
void TipWalk::find_unit_moves(const Vec3& tip, bool turns, WalkFrames& frames) const {
  const std::vector<Joint>& joints = state_.arm.joints();
  if (joint_wanted_) {
    frames.by_joint.setZero(6, state_.arm.size());
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (joints[k].type == JointType::kFixed) continue;
      const Vec3 z = joints[k].multiplier * frames.world_from_row[k].linear().col(2);
      auto both = frames.by_joint.col(joints[k].coordinate);
      if (joints[k].type == JointType::kPrismatic) {
        both.head<3>() += z;
      } else {
        both.head<3>() += z.cross(tip - frames.world_from_row[k].translation());
        both.tail<3>() += z;
      }
    }
  }
  if (length_wanted_) {
    frames.by_length.setZero();
    for (std::size_t k = 0; k < joints.size(); ++k) {
      frames.by_length += joints[k].row.a * (frames.reached[k + 1].linear() * steps_[k].x_of_row) +
                          joints[k].row.d * frames.world_from_row[k].linear().col(2);
    }
  }
  frames.by_frame.resize(frame_wanted_.size());
  for (std::size_t f = 0; f < frame_wanted_.size(); ++f) {
    if (frame_wanted_[f] == 0) continue;
    const Vec3 turn = frames.put_in.col(static_cast<Index>(f)).tail<3>();
    const Eigen::Matrix3d axes = frames.reached[f].linear() * left_jacobian(turn);
    const Vec3 lever = tip - frames.left[f].translation();
    Eigen::Matrix<double, 6, 6>& unit = frames.by_frame[f];
    unit.topLeftCorner<3, 3>() = frames.reached[f].linear();
    unit.bottomLeftCorner<3, 3>().setZero();
    for (int axis = 0; axis < 3; ++axis)
      unit.block<3, 1>(0, 3 + axis) = axes.col(axis).cross(lever);
    if (turns) unit.bottomRightCorner<3, 3>() = axes;
  }
}

Vector6 TipWalk::move_of_effect(std::size_t i, Index row, const WalkFrames& frames) const {
  Vector6 move = Vector6::Zero();
  for (std::size_t p = first_pull_[i]; p < first_pull_[i + 1]; ++p) {
    const Pull& pull = wanted_pulls_[p];
    switch (pull.site) {
      case Site::kJoint:
        move += pull.values[row] * frames.by_joint.col(pull.index);
        break;
      case Site::kLength:
        move.head<3>() += pull.values[row] * frames.by_length;
        break;
      case Site::kFrame:
        move += frames.by_frame[pull.index] * Eigen::Map<const Vector6>(pull.values + 6 * row);
        break;
    }
  }
  return move;
}

}  // namespace bathyal
