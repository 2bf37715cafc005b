// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/kinematics.hpp"

// A geometric path in joint space becomes a motion: corners rounded, timed within limits.

namespace bathyal {

/// Of each coordinate, [rad] or [m] with s, s², s³ below; an empty list: default_limits.
struct MotionLimits {
  std::vector<double> velocity;
  std::vector<double> acceleration;
  std::vector<double> jerk;
};

/// Speeds: of the arm's joints, 1 rad/s, 0.25 m/s where a joint has none; accelerations:
/// default_acceleration; jerks: such that an acceleration is reached in 0.1 s.
MotionLimits default_limits(const Arm& arm);

/// `limits` with the empty lists filled in.
/// \throw std::invalid_argument for a list of another length than the arm's coordinates, a value
///        that is not finite or not above 0.
MotionLimits complete_limits(const Arm& arm, const MotionLimits& limits);

struct TimingOptions {
  double step = 0.02;  ///< at most, between two rows handed out [s], above 0
  /// How far any coordinate may leave the path given, at corners and where rows are dropped that
  /// lie on a straight line as near as that [rad], [m]; 0: the motion stops at every corner.
  double tolerance = 0.05;
  /// In place of `tolerance` of each row given; 0: the motion stops there.
  std::vector<double> row_tolerance = {};

  /// \throw std::invalid_argument
  void check() const;
};

struct TimedMotion {
  JointMatrix q;             ///< (K, n)
  std::vector<double> time;  ///< (K,) from 0, equal steps [s]
  /// (K,) where on the path given: row and fraction of the way to the next; at a rounded corner of
  /// the nearest point along it.
  std::vector<double> along;
};

/// The path along the rows of `path`, (M, n), joined by straight lines, from rest to rest.
///
/// Corners are rounded with continuous curvature: between two legs of directions u and w the
/// direction turns as u + (3x² − 2x³)(w − u) with the way, at a constant speed that keeps every
/// coordinate within its limits; where stopping is faster the motion stops. On straight legs the
/// speed is jerk-limited, as fast as the limits allow for the speeds at its ends (seven phases,
/// Biagiotti and Melchiorri 2008, section 3.4), and without acceleration at them; the speeds at the
/// ends are the largest from which each leg can be done. One leg by itself is timed optimally.
/// Speeds, accelerations and jerks are within the limits at every moment, so are the first, second
/// and third differences of the rows, to rounding. One row, or several that are equal, give one row
/// at time 0. \throw std::invalid_argument as check_joint_values, complete_limits and
/// TimingOptions::check,
///        for no row, another count of row tolerances, a motion of more than 10⁷ rows.
TimedMotion time_motion(const Arm& arm, JointView path, const MotionLimits& limits = {},
                        const TimingOptions& options = {});

}  // namespace bathyal
