// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/identify/model/arm_parameters.hpp"

// The tip of an arm at given parameters, and its derivatives by each of them.

namespace bathyal {

/// Frames of one pose, with memory that is reused.
struct ChainFrames : RowFrames {
  // With effects only:
  /// Frames before their perturbation: [0] is the base, [k] the frame behind row k - 1, [rows + 1]
  /// the flange.
  std::vector<Pose> before;
  std::vector<Pose> behind;                               ///< the same after the perturbation
  Eigen::Matrix<double, 6, Eigen::Dynamic> perturbation;  ///< shift and turn of each
  std::vector<double> q;                                  ///< perturbed joint values
  double growth = 0.0;                                    ///< of a and d
  // Derivatives of the tip (3 rows) and of its rotation (3 more) by a unit of a perturbation.
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_joint;
  std::vector<Eigen::Matrix<double, 6, 6>> by_frame;
  Vec3 by_length = Vec3::Zero();
};

/// Motion of one joint: the cosine and the sine of its angle, or its displacement and 0.
struct JointMotion {
  double first = 0.0;
  double second = 0.0;
};

JointMotion motion_of(const Joint& joint, double value);

/// Joint values of a pose, optionally with the precomputed motion of each joint, for poses that are
/// evaluated many times.
struct ChainPose {
  const double* q;
  const JointMotion* motions;

  ChainPose(const double* values, const JointMotion* known = nullptr) : q(values), motions(known) {}
};

/// Row of a pose that does not belong to the measurement: no effect acts there.
inline constexpr Index kNoRow = -1;

/// The tip at each pose of a measurement and its derivatives by the `wanted` parameters. Effects
/// act at their current values: joints first, then lengths, then frames, each by the sum of all
/// perturbations of it.
class ChainDerivatives {
 public:
  /// `columns` must outlive it.
  ChainDerivatives(const ArmParameters& parameters, const Eigen::VectorXd& x,
                   std::vector<int> wanted);

  const ArmState& state() const { return state_; }

  /// world_from_tool of one pose. `row` is its row of perturbations, or kNoRow. `shift` and `turn`
  /// are (3, wanted), column after column with `stride` between them: d tip / d parameter, and the
  /// rotation of the tool per unit of the parameter; each may be null. `frames` is scratch.
  Pose tip(const ChainPose& joints, Index row, int tool, int station, ChainFrames& frames,
           double* shift, double* turn, Index stride) const;

  /// The axis about which the i-th wanted parameter, a tilt of a plane, rotates its normal.
  Vec3 plane_turn(std::size_t i) const { return turn_axes_[i]; }

  /// d tip / d q, (3, n), and the tip; the perturbations at `row` are held constant.
  Eigen::Matrix3Xd joint_jacobian(const double* q, Index row, int tool, int station,
                                  ChainFrames& frames, Vec3& tip) const;

 private:
  /// A row as Rz(value) or Tz(value), then what does not change from pose to pose.
  struct Step {
    Pose behind_from_moved;
    Vec3 x_of_row;  ///< x before the row's last turn, Ry(beta), in the frame behind it
  };
  /// A perturbation by a parameter of value `size`.
  struct EffectTerm {
    PerturbationSite site;
    int index;
    const double* values;  ///< as Action::values
    double size;
  };
  void find_turn_axes(const Eigen::VectorXd& x);
  void find_effect_terms(const Eigen::VectorXd& x);
  bool acts(Index row) const { return has_effects_ && row != kNoRow; }

  Pose forward(const ChainPose& joints, Index row, int tool, int station,
               ChainFrames& frames) const;
  void forward_rigid(const ChainPose& joints, int station, ChainFrames& frames) const;
  void forward_with_effects(const double* q, Index row, int station, ChainFrames& frames) const;
  void pass_row(std::size_t k, const JointMotion& motion, const Pose& before, Pose& behind) const;
  void perturb_frame(std::size_t frame, const Pose& before, ChainFrames& frames) const;
  void find_unit_moves(const Vec3& tip, bool turns, ChainFrames& frames) const;
  Eigen::Matrix<double, 6, 1> move_of_effect(std::size_t i, Index row,
                                             const ChainFrames& frames) const;

  const ArmParameters& parameters_;
  std::vector<int> wanted_;
  ArmState state_;
  std::vector<Step> steps_;
  std::vector<Pose> row_from_tool_;  ///< of each tool, from the frame behind the last row
  std::vector<Vec3> turn_axes_;      ///< of each wanted turn, in the frame that it turns in

  bool has_effects_ = false;              ///< nonzero or wanted ones
  std::vector<EffectTerm> active_terms_;  ///< of parameters that are not zero
  std::vector<EffectTerm> wanted_terms_;  ///< of wanted parameters, one after the other
  std::vector<std::size_t> first_term_;   ///< of each wanted parameter, and the end
  std::vector<char> frame_wanted_;        ///< of each site of kFrame
  bool joint_wanted_ = false;
  bool length_wanted_ = false;
};

}  // namespace bathyal
