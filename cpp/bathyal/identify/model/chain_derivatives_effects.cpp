// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <span>

#include "bathyal/geometry/rotation_vector.hpp"
#include "bathyal/identify/model/chain_derivatives.hpp"

// The kinematic chain with effects.

namespace bathyal {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

}  // namespace

void ChainDerivatives::find_effect_terms(const Eigen::VectorXd& x) {
  const auto append_terms = [&](int column, std::vector<EffectTerm>& out) {
    for (const Perturbation& perturbation :
         *parameters_.perturbations[parameters_.slots[column].index]) {
      out.push_back({perturbation.site, perturbation.index, perturbation.values.data(), x[column]});
    }
  };
  for (int i = 0; i < static_cast<int>(parameters_.slots.size()); ++i) {
    if (parameters_.slots[i].kind == ParameterKind::kEffect && x[i] != 0.0)
      append_terms(i, active_terms_);
  }
  frame_wanted_.assign(state_.arm.joints().size() + 2, 0);
  for (const int column : wanted_) {
    first_term_.push_back(wanted_terms_.size());
    if (parameters_.slots[column].kind == ParameterKind::kEffect)
      append_terms(column, wanted_terms_);
  }
  first_term_.push_back(wanted_terms_.size());
  for (const EffectTerm& term : wanted_terms_) {
    if (term.site == PerturbationSite::kJoint) joint_wanted_ = true;
    if (term.site == PerturbationSite::kLength) length_wanted_ = true;
    if (term.site == PerturbationSite::kFrame) frame_wanted_[term.index] = 1;
  }
  has_effects_ = !active_terms_.empty() || !wanted_terms_.empty();
}

void ChainDerivatives::forward_with_effects(const double* q, Index row, int station,
                                            ChainFrames& frames) const {
  const std::vector<Joint>& joints = state_.arm.joints();
  const std::size_t rows = joints.size();
  frames.q.assign(q, q + state_.arm.size());
  frames.growth = 0.0;
  frames.perturbation.setZero(6, static_cast<Index>(rows) + 2);
  for (const EffectTerm& term : active_terms_) {
    switch (term.site) {
      case PerturbationSite::kJoint:
        frames.q[term.index] += term.size * term.values[row];
        break;
      case PerturbationSite::kLength:
        frames.growth += term.size * term.values[row];
        break;
      case PerturbationSite::kFrame:
        frames.perturbation.col(term.index) +=
            term.size * Eigen::Map<const Vector6>(term.values + 6 * row);
        break;
    }
  }

  frames.world_from_row.resize(rows + 1);
  frames.before.resize(rows + 2);
  frames.behind.resize(rows + 2);
  perturb_frame(0, state_.bases[station], frames);
  frames.world_from_row[0] = frames.behind[0] * state_.arm.root();
  for (std::size_t k = 0; k < rows; ++k) {
    const Pose& before = frames.world_from_row[k];
    Pose behind;
    pass_row(k, motion_of(joints[k], joint_value(joints[k], frames.q)), before, behind);
    if (frames.growth != 0.0) {
      const Vec3 x = behind.linear() * steps_[k].x_of_row;
      const DhRow& nominal = joints[k].row;
      behind.translation() += frames.growth * (nominal.a * x + nominal.d * before.linear().col(2));
    }
    perturb_frame(k + 1, behind, frames);
    frames.world_from_row[k + 1] = frames.behind[k + 1];
  }
  perturb_frame(rows + 1, frames.behind[rows] * state_.arm.flange(), frames);
}

/// Appends shift, then rotation, to a frame.
void ChainDerivatives::perturb_frame(std::size_t frame, const Pose& before,
                                     ChainFrames& frames) const {
  frames.before[frame] = before;
  Pose& behind = frames.behind[frame];
  behind = before;
  const auto both = frames.perturbation.col(static_cast<Index>(frame));
  if (both.isZero(0.0)) return;
  behind.translation() += before.linear() * both.head<3>();
  behind.linear() = before.linear() * rotation_of(both.tail<3>());
}

/// Derivatives by a unit of each wanted perturbation, for all its parameters together.
void ChainDerivatives::find_unit_moves(const Vec3& tip, bool turns, ChainFrames& frames) const {
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
      frames.by_length += joints[k].row.a * (frames.before[k + 1].linear() * steps_[k].x_of_row) +
                          joints[k].row.d * frames.world_from_row[k].linear().col(2);
    }
  }
  frames.by_frame.resize(frame_wanted_.size());
  for (std::size_t f = 0; f < frame_wanted_.size(); ++f) {
    if (frame_wanted_[f] == 0) continue;
    const Vec3 turn = frames.perturbation.col(static_cast<Index>(f)).tail<3>();
    const Eigen::Matrix3d axes = frames.before[f].linear() * left_jacobian(turn);
    const Vec3 lever = tip - frames.behind[f].translation();
    Eigen::Matrix<double, 6, 6>& unit = frames.by_frame[f];
    unit.topLeftCorner<3, 3>() = frames.before[f].linear();
    unit.bottomLeftCorner<3, 3>().setZero();
    for (int axis = 0; axis < 3; ++axis)
      unit.block<3, 1>(0, 3 + axis) = axes.col(axis).cross(lever);
    if (turns) unit.bottomRightCorner<3, 3>() = axes;
  }
}

Vector6 ChainDerivatives::move_of_effect(std::size_t i, Index row,
                                         const ChainFrames& frames) const {
  Vector6 move = Vector6::Zero();
  for (std::size_t p = first_term_[i]; p < first_term_[i + 1]; ++p) {
    const EffectTerm& term = wanted_terms_[p];
    switch (term.site) {
      case PerturbationSite::kJoint:
        move += term.values[row] * frames.by_joint.col(term.index);
        break;
      case PerturbationSite::kLength:
        move.head<3>() += term.values[row] * frames.by_length;
        break;
      case PerturbationSite::kFrame:
        move += frames.by_frame[term.index] * Eigen::Map<const Vector6>(term.values + 6 * row);
        break;
    }
  }
  return move;
}

}  // namespace bathyal
