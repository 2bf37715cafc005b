// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "bathyal/arm/inverse.hpp"
#include "bathyal/workspace/motion/motion_timing.hpp"

// Straight motions of an arm's tip. Points and directions are in the frame of the arm's base:
// the vehicle's.

namespace bathyal::workspace {

/// What of the tool's pose matters.
struct TipAim {
  InverseTask task = InverseTask::kPosition;  ///< or kPositionAxis
  Vec3 axis = Vec3::UnitZ();                  ///< of the tool, in its frame
  Vec3 direction = -Vec3::UnitZ();            ///< that the axis points along

  Pose at(const Vec3& point) const;
};

/// Postures whose tip is in the point, from each of the starts, (S, n); those that are not reached
/// left out.
JointMatrix reaching(const Arm& arm, const Vec3& point, const TipAim& aim,
                     const JointMatrix& starts, int num_threads);

/// Postures from `start`, whose tip is at `from`, in equal steps to `to`; none where one is not
/// reached from the one before within the limits and a small change of the coordinates.
std::optional<JointMatrix> follow_line(const Arm& arm, std::span<const double> start,
                                       const Vec3& from, const Vec3& to, const TipAim& aim,
                                       double tolerance);

/// The largest distance of the tip from the line through two points, at the rows and halfway
/// between them [m].
double line_error(const Arm& arm, const JointMatrix& q, const Vec3& from, const Vec3& to);

struct LineTiming {
  MotionLimits limits;
  double step = 0.02;       ///< [s]
  double speed = 0.02;      ///< of the tip, at most [m/s]
  double tolerance = 1e-3;  ///< of line_error [m]
};

/// Rows of follow_line as a motion from rest to rest, as fast as the limits allow or, uniformly,
/// slower; none where no rounding of corners keeps the line.
std::optional<TimedMotion> time_line(const Arm& arm, const JointMatrix& rows, const Vec3& from,
                                     const Vec3& to, const LineTiming& timing);

}  // namespace bathyal::workspace
