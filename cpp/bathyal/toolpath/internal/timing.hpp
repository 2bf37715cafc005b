// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/toolpath/toolpath.hpp"

namespace bathyal::toolpath {

/// Limits of the tool's motion, all above 0.
struct MotionLimits {
  double speed;         ///< [m/s]
  double acceleration;  ///< along the path [m/s²]
  double angular_rate;  ///< [rad/s]
};

/// Sets arc_length and time. The feed is the fastest that keeps, between every two samples, the
/// speed, the acceleration along the path and the angular rate; the tool is at rest at both ends of
/// the path and of every gap, and where it turns in place (two samples at one position), which it
/// does at angular_rate. Between samples it speeds up, keeps its speed and slows down at constant
/// acceleration, so that also a path of two samples has a finite time.
void set_times(ToolPath& path, const MotionLimits& limits);

}  // namespace bathyal::toolpath
