// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <vector>

#include "bathyal/arm/inverse_problem.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/compensation/corrected_arm.hpp"
#include "bathyal/geometry/rotation_vector.hpp"

// Perturbations are small and change slowly with the pose, so that q of "target minus the effects
// at q" is a fixed point that a few iterations reach.

namespace bathyal {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr double kTolerance = 1e-9;  ///< [m] and [rad]
/// The rigid arm is solved to a tighter tolerance than the corrected one.
constexpr double kTighter = 0.1;
constexpr int kMaxRounds = 40;
constexpr int kMaxRoundsOutOfReach = 4;  ///< for a target out of reach of the rigid arm

Pose pose_at(const double* numbers) {
  Pose pose;
  pose.matrix() = Eigen::Map<const RowMajor4>(numbers);
  return pose;
}

/// The remaining rotation from a tool to its target.
Eigen::Matrix3d remaining_rotation(const Pose& target, const Pose& tool,
                                   const InverseOptions& options) {
  switch (options.task) {
    case InverseTask::kPosition:
      return Eigen::Matrix3d::Identity();
    case InverseTask::kPositionAxis:
      return Eigen::Quaterniond::FromTwoVectors(tool.linear() * options.axis,
                                                target.linear() * options.axis)
          .toRotationMatrix();
    case InverseTask::kPose:
      break;
  }
  return target.linear() * tool.linear().transpose();
}

/// The state of the iteration: targets of the rigid arm and its solutions.
class FixedPointIteration {
 public:
  FixedPointIteration(const CorrectedArm& model, std::span<const double> targets,
                      const Covariates& covariates, const InverseOptions& options)
      : model_(model),
        targets_(targets),
        covariates_(covariates),
        options_(options),
        position_tolerance_(options.position_tolerance.value_or(kTolerance)),
        angle_tolerance_(options.angle_tolerance.value_or(kTolerance)),
        length_of_radian_(arm::InverseProblem(model.arm(), options).task.length),
        sent_(targets.begin(), targets.end()),
        done_(targets.size() / 16, 0) {
    options_.position_tolerance = kTighter * position_tolerance_;
    options_.angle_tolerance = kTighter * angle_tolerance_;
  }

  CorrectedInverse solve(JointView starts) {
    answer_.result = inverse(model_.arm(), sent_, starts, options_);
    // From here on each target starts from the previous solution.
    options_.candidates = 1;
    options_.centering_steps = 0;
    for (int round = 1; compare(round) && round < kMaxRounds; ++round) solve_again();
    for (std::size_t i = 0; i < done_.size(); ++i) {
      InverseStatus& status = answer_.result.status[i];
      if (!done_[i] && status == InverseStatus::kReached) status = InverseStatus::kSingular;
    }
    return std::move(answer_);
  }

 private:
  /// Compares the corrected tip with the target and updates `sent_`; true until all have converged.
  bool compare(int round) {
    const JointMatrix& q = answer_.result.q;
    CorrectedPoses corrected = model_.forward(view_of(q), covariates_, options_.num_threads);
    const std::vector<double> rigid = forward(model_.arm(), view_of(q), options_.num_threads);
    answer_.uses = std::move(corrected.uses);
    bool more = false;
    for (std::size_t i = 0; i < done_.size(); ++i) {
      if (done_[i]) continue;
      const Pose target = pose_at(&targets_[16 * i]);
      const Pose tool = pose_at(&corrected.poses[16 * i]);
      const Eigen::Matrix3d turn = remaining_rotation(target, tool, options_);
      const Vec3 miss = target.translation() - tool.translation();
      note_error(i, miss.norm(), vector_of(turn).norm());
      const bool reached = answer_.result.status[i] == InverseStatus::kReached;
      const bool agrees = answer_.result.position_error[i] <= position_tolerance_ &&
                          answer_.result.angle_error[i] <= angle_tolerance_;
      done_[i] = (reached && agrees) || (!reached && round > kMaxRoundsOutOfReach);
      if (done_[i]) continue;
      more = true;
      const Pose from = pose_at(&rigid[16 * i]);
      Pose next;
      next.translation() = from.translation() + miss;
      next.linear() = Eigen::Quaterniond(turn * from.linear()).normalized().toRotationMatrix();
      Eigen::Map<RowMajor4>{&sent_[16 * i]} = next.matrix();
    }
    return more;
  }

  void note_error(std::size_t i, double distance, double angle) {
    InverseResult& result = answer_.result;
    result.position_error[i] = distance;
    result.angle_error[i] = angle;
    result.error[i] = std::hypot(distance, length_of_radian_ * angle);
  }

  void solve_again() {
    InverseResult& result = answer_.result;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < done_.size(); ++i) {
      if (!done_[i]) rows.push_back(i);
    }
    std::vector<double> poses;
    JointMatrix starts(static_cast<Index>(rows.size()), result.q.cols());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double* sent = &sent_[16 * rows[k]];
      poses.insert(poses.end(), sent, sent + 16);
      starts.row(static_cast<Index>(k)) = result.q.row(static_cast<Index>(rows[k]));
    }
    const InverseResult found = inverse(model_.arm(), poses, view_of(starts), options_);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::size_t i = rows[k];
      result.q.row(static_cast<Index>(i)) = found.q.row(static_cast<Index>(k));
      result.status[i] = found.status[k];
      result.iterations[i] += found.iterations[k];
      result.starts[i] += found.starts[k] - 1;
    }
  }

  const CorrectedArm& model_;
  std::span<const double> targets_;
  const Covariates& covariates_;
  InverseOptions options_;
  double position_tolerance_;
  double angle_tolerance_;
  double length_of_radian_;  ///< as in the errors of bathyal::inverse
  std::vector<double> sent_;
  std::vector<char> done_;
  CorrectedInverse answer_;
};

}  // namespace

CorrectedInverse CorrectedArm::inverse(std::span<const double> targets, JointView starts,
                                       const Covariates& covariates,
                                       const InverseOptions& options) const {
  options.check();
  if (options.method != InverseMethod::kDampedLeastSquares) {
    throw_argument("method", "damped least squares", "the pseudo-inverse");
  }
  return FixedPointIteration(*this, targets, covariates, options).solve(starts);
}

}  // namespace bathyal
