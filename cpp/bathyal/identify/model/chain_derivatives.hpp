// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/identify/model/arm_parameters.hpp"

// The tip of an arm whose columns have values, and what each column does to it. For use inside the
// room.

namespace bathyal {

/// Frames of one pose of a TipWalk, whose memory is used again.
struct WalkFrames : RowFrames {
  // Of a walk with effects only:
  /// Where the frames stand before what effects put in behind them: [0] is the base, [k] the frame
  /// behind row k - 1, [rows + 1] the flange.
  std::vector<Pose> reached;
  std::vector<Pose> left;                           ///< the same with what was put in
  Eigen::Matrix<double, 6, Eigen::Dynamic> put_in;  ///< shift and turn of each
  std::vector<double> q;                            ///< true joint values
  double growth = 0.0;                              ///< of a and d
  // What a unit of an action does to the tip (3 rows) and to the axis it turns about (3 more).
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_joint;
  std::vector<Eigen::Matrix<double, 6, 6>> by_frame;
  Vec3 by_length = Vec3::Zero();
};

/// What a joint does by itself: the cosine and the sine of its turn, or its shift and nothing.
struct JointMotion {
  double first = 0.0;
  double second = 0.0;
};

JointMotion motion_of(const Joint& joint, double value);

/// Joint values of a pose; beside them the motion of each joint, where poses that are walked many
/// times had it worked out before.
struct PoseJoints {
  const double* q;
  const JointMotion* motions;

  PoseJoints(const double* values, const JointMotion* known = nullptr)
      : q(values), motions(known) {}
};

/// The row of a pose that is none of the measurement: no effect acts there.
inline constexpr Index kNoRow = -1;

/// The tip at each pose of a measurement and how it moves with each of `wanted` columns. Effects
/// act as they stand: joints first, then lengths, then frames, each with the sum of all that acts
/// on it.
class TipWalk {
 public:
  /// `columns` must outlive it.
  TipWalk(const ArmColumns& columns, const Eigen::VectorXd& x, std::vector<int> wanted);

  const ArmState& state() const { return state_; }

  /// One pose; world_from_tool. `row` is the row of effects' actions, or kNoRow. `shift` and `turn`
  /// are (3, wanted), column after column with `stride` between them: d tip / d column, and the
  /// axis about which the tool turns per unit of the column; each may be null. `frames` is scratch.
  Pose tip(const PoseJoints& joints, Index row, int tool, int station, WalkFrames& frames,
           double* shift, double* turn, Index stride) const;

  /// The axis about which the i-th wanted column, a plane's tilt, turns that plane's normal.
  Vec3 plane_turn(std::size_t i) const { return turn_axes_[i]; }

  /// d tip / d q, (3, n), and the tip; what effects do is held as it is at `row`.
  Eigen::Matrix3Xd joint_jacobian(const double* q, Index row, int tool, int station,
                                  WalkFrames& frames, Vec3& tip) const;

 private:
  /// A row as Rz(value) or Tz(value), then what does not change from pose to pose.
  struct Step {
    Pose behind_from_moved;
    Vec3 x_of_row;  ///< x before the row's last turn, Ry(beta), in the frame behind it
  };
  /// An action of a column that stands at `size`.
  struct Pull {
    Site site;
    int index;
    const double* values;  ///< as Action::values
    double size;
  };
  void find_turn_axes(const Eigen::VectorXd& x);
  void find_pulls(const Eigen::VectorXd& x);
  bool acts(Index row) const { return has_effects_ && row != kNoRow; }

  Pose walk(const PoseJoints& joints, Index row, int tool, int station, WalkFrames& frames) const;
  void walk_plain(const PoseJoints& joints, int station, WalkFrames& frames) const;
  void walk_with_effects(const double* q, Index row, int station, WalkFrames& frames) const;
  void pass_row(std::size_t k, const JointMotion& motion, const Pose& before, Pose& behind) const;
  void put_in(std::size_t frame, const Pose& reached, WalkFrames& frames) const;
  void find_unit_moves(const Vec3& tip, bool turns, WalkFrames& frames) const;
  Eigen::Matrix<double, 6, 1> move_of_effect(std::size_t i, Index row,
                                             const WalkFrames& frames) const;

  const ArmColumns& columns_;
  std::vector<int> wanted_;
  ArmState state_;
  std::vector<Step> steps_;
  std::vector<Pose> row_from_tool_;  ///< of each tool, from the frame behind the last row
  std::vector<Vec3> turn_axes_;      ///< of each wanted turn, in the frame that it turns in

  bool has_effects_ = false;             ///< some that are not zero, or wanted
  std::vector<Pull> active_;             ///< of columns that are not zero
  std::vector<Pull> wanted_pulls_;       ///< of wanted columns, one after the other
  std::vector<std::size_t> first_pull_;  ///< of each wanted column, and the end
  std::vector<char> frame_wanted_;       ///< of each site of kFrame
  bool joint_wanted_ = false;
  bool length_wanted_ = false;
};

}  // namespace bathyal
