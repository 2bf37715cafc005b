// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/compensation/effect_sum.hpp"

#include <cmath>
#include <span>

#include "bathyal/geometry/rotation_vector.hpp"

namespace bathyal {
namespace {

double share_of(const EffectSum& sum, Index row) {
  return sum.lengths.size() == 0 ? 0.0 : sum.lengths[row];
}

Pose perturbed(const Pose& before, const RowMatrix& twists, Index row) {
  if (twists.rows() == 0) return before;
  const Vec3 shift = twists.row(row).head(3).transpose();
  const Vec3 turn = twists.row(row).tail(3).transpose();
  Pose behind = before;
  behind.translation() = before * shift;
  behind.linear() = before.linear() * rotation_of(turn);
  return behind;
}

/// Motion of the tip, accumulated over everything that a coordinate moves.
struct TipMotion {
  Vec3 tip;
  Vec3 shift = Vec3::Zero();
  Vec3 turn = Vec3::Zero();

  void turn_about(const Vec3& axis, const Vec3& center) {
    turn += axis;
    shift += axis.cross(tip - center);
  }
};

/// A row whose lengths grow: d along the joint's axis, a along x before the row's last turn,
/// Ry(beta).
void grow_rows(const Arm& arm, const CorrectedFrames& frames, double share, TipMotion& motion) {
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const DhRow& row = arm.joints()[k].row;
    const Vec3 x_of_row(std::cos(row.beta), 0.0, std::sin(row.beta));
    motion.shift += share * row.d * frames.start_of_row(arm, k).linear().col(2);
    motion.shift += share * row.a * (frames.before[k + 1].linear() * x_of_row);
  }
}

}  // namespace

EffectSum::EffectSum(const Arm& arm, Index rows)
    : q(JointMatrix::Zero(rows, arm.size())),
      frames(arm.joints().size() + 2),
      chained(static_cast<std::size_t>(rows), 0) {}

void EffectSum::add(const std::vector<std::vector<Perturbation>>& perturbations,
                    const Eigen::VectorXd& values) {
  for (std::size_t p = 0; p < perturbations.size(); ++p) {
    for (const Perturbation& perturbation : perturbations[p])
      add(perturbation, values[static_cast<Index>(p)]);
  }
}

void EffectSum::add(const Perturbation& perturbation, double value) {
  const Index rows = perturbation.values.rows();
  switch (perturbation.site) {
    case PerturbationSite::kJoint:
      q.col(perturbation.index) += value * perturbation.values.col(0);
      return;
    case PerturbationSite::kFrame:
      if (frames[perturbation.index].rows() == 0)
        frames[perturbation.index] = RowMatrix::Zero(rows, 6);
      frames[perturbation.index] += value * perturbation.values;
      break;
    case PerturbationSite::kLength:
      if (lengths.size() == 0) lengths.setZero(rows);
      lengths += value * perturbation.values.col(0);
      break;
  }
  for (Index i = 0; i < rows; ++i) {
    if (!perturbation.values.row(i).isZero(0.0)) chained[static_cast<std::size_t>(i)] = 1;
  }
}

void compute_corrected_frames(const Arm& arm, const double* q, const EffectSum& sum, Index row,
                              CorrectedFrames& frames) {
  const std::size_t rows = arm.joints().size();
  frames.before.resize(rows + 2);
  frames.behind.resize(rows + 2);
  const auto add_frame = [&](std::size_t k, const Pose& pose) {
    frames.before[k] = pose;
    frames.behind[k] = perturbed(pose, sum.frames[k], row);
  };
  const Eigen::VectorXd moved =
      Eigen::Map<const Eigen::VectorXd>(q, arm.size()) + sum.q.row(row).transpose();
  const std::span<const double> values(moved.data(), static_cast<std::size_t>(moved.size()));
  const double grown = 1.0 + share_of(sum, row);
  add_frame(0, arm.base());
  for (std::size_t k = 0; k < rows; ++k) {
    const Joint& joint = arm.joints()[k];
    DhRow table = joint.row;
    table.a *= grown;
    table.d *= grown;
    add_frame(k + 1, frames.start_of_row(arm, k) *
                         row_pose(table, joint.type, joint_value(joint, values)));
  }
  add_frame(rows + 1, frames.behind[rows] * arm.flange());
  frames.world_from_tool = frames.behind[rows + 1] * arm.tool();
}

Eigen::MatrixXd corrected_jacobian(const Arm& arm, const CorrectedFrames& frames,
                                   const EffectSum& sum, const std::vector<EffectSum>& by_joint,
                                   Index row) {
  const Vec3 tip = frames.world_from_tool.translation();
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(6, arm.size());
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const Joint& joint = arm.joints()[k];
    if (joint.type == JointType::kFixed) continue;
    const Pose start = frames.start_of_row(arm, k);
    const Vec3 axis = joint.multiplier * start.linear().col(2);
    if (joint.type == JointType::kPrismatic) {
      rigid.col(joint.coordinate).head(3) += axis;
    } else {
      rigid.col(joint.coordinate).head(3) += axis.cross(tip - start.translation());
      rigid.col(joint.coordinate).tail(3) += axis;
    }
  }
  Eigen::MatrixXd jacobian = rigid;
  for (Index j = 0; j < arm.size(); ++j) {
    const EffectSum& change = by_joint[j];
    TipMotion motion{tip};
    for (std::size_t k = 0; k < frames.before.size(); ++k) {
      if (change.frames[k].rows() == 0) continue;
      const Eigen::Matrix3d& axes = frames.before[k].linear();
      const Vec3 turn = sum.frames[k].row(row).tail(3).transpose();
      motion.shift += axes * change.frames[k].row(row).head(3).transpose();
      motion.turn_about(
          axes * (left_jacobian(turn) * change.frames[k].row(row).tail(3).transpose()),
          frames.behind[k].translation());
    }
    grow_rows(arm, frames, share_of(change, row), motion);
    jacobian.col(j) += rigid * change.q.row(row).transpose();
    jacobian.col(j).head(3) += motion.shift;
    jacobian.col(j).tail(3) += motion.turn;
  }
  return jacobian;
}

}  // namespace bathyal
