// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/timing.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/toolpath/internal/frames.hpp"

namespace bathyal::toolpath {
namespace {

/// The stretch from one sample to the next.
struct TimedSegment {
  double length = 0.0;  ///< [m]
  double turn = 0.0;    ///< [rad]
  double speed = 0.0;   ///< the fastest it allows [m/s]; 0 where the tool turns in place
};

std::vector<TimedSegment> stretches_of(const ToolPath& path, const MotionLimits& limits) {
  std::vector<TimedSegment> stretches(path.size() - 1);
  for (std::size_t j = 0; j < stretches.size(); ++j) {
    TimedSegment& s = stretches[j];
    s.length = (path.position[j + 1] - path.position[j]).norm();
    s.turn = turn_between(path, j, j + 1);
    if (s.length <= kCoincident) {
      s.length = 0.0;
      s.speed = s.turn > 1e-9 ? 0.0 : limits.speed;
    } else {
      s.speed = s.turn > 0.0 ? std::min(limits.speed, limits.angular_rate * s.length / s.turn)
                             : limits.speed;
    }
  }
  return stretches;
}

/// The fastest speed at each sample: what the stretches on both sides allow, then what can be
/// reached from behind and slowed down from ahead.
std::vector<double> speeds_at(const ToolPath& path, const std::vector<TimedSegment>& stretches,
                              double acceleration) {
  const std::size_t count = path.size();
  std::vector<double> speed(count, 0.0);
  for (std::size_t j = 1; j + 1 < count; ++j) {
    if (path.gap[j - 1] || path.gap[j]) continue;
    speed[j] = std::min(stretches[j - 1].speed, stretches[j].speed);
  }
  const auto reached = [&](double from, const TimedSegment& s) {
    return std::sqrt(from * from + 2.0 * acceleration * s.length);
  };
  for (std::size_t j = 1; j < count; ++j) {
    speed[j] = std::min(speed[j], reached(speed[j - 1], stretches[j - 1]));
  }
  for (std::size_t j = count - 1; j-- > 0;) {
    speed[j] = std::min(speed[j], reached(speed[j + 1], stretches[j]));
  }
  return speed;
}

/// Time over a stretch entered at v0 and left at v1: up to a peak, along at it, and down.
double duration(const TimedSegment& s, double v0, double v1, const MotionLimits& limits) {
  const double turning = s.turn / limits.angular_rate;
  if (s.length == 0.0) return s.turn > 1e-9 ? turning : 0.0;
  const double a = limits.acceleration;
  const double meeting = std::sqrt(0.5 * (v0 * v0 + v1 * v1) + a * s.length);
  const double peak = std::max({std::min(meeting, s.speed), v0, v1});
  const double ramps = (2.0 * peak * peak - v0 * v0 - v1 * v1) / (2.0 * a);
  const double time = (2.0 * peak - v0 - v1) / a + std::max(0.0, s.length - ramps) / peak;
  return std::max({time, turning, s.length / limits.speed});  // the last two guard against rounding
}

}  // namespace

void set_times(ToolPath& path, const MotionLimits& limits) {
  const std::size_t count = path.size();
  path.arc_length.assign(count, 0.0);
  path.time.assign(count, 0.0);
  if (count < 2) return;
  const std::vector<TimedSegment> stretches = stretches_of(path, limits);
  const std::vector<double> speed = speeds_at(path, stretches, limits.acceleration);
  for (std::size_t j = 0; j + 1 < count; ++j) {
    path.arc_length[j + 1] = path.arc_length[j] + (path.position[j + 1] - path.position[j]).norm();
    path.time[j + 1] = path.time[j] + duration(stretches[j], speed[j], speed[j + 1], limits);
  }
}

}  // namespace bathyal::toolpath
