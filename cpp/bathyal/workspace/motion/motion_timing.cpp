// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/motion_timing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/workspace/motion/internal/rounded_path.hpp"
#include "bathyal/workspace/workspace.hpp"

namespace bathyal {
namespace {

constexpr double kMaxRows = 1e7;
constexpr double kTurningSpeed = 1.0;   // [rad/s] of joints without a limit
constexpr double kSlidingSpeed = 0.25;  // [m/s]
constexpr double kJerkTime = 0.1;       // [s]

std::vector<double> default_velocity(const Arm& arm) {
  std::vector<double> velocity(static_cast<std::size_t>(arm.size()),
                               std::numeric_limits<double>::infinity());
  for (const Joint& joint : arm.joints()) {
    if (joint.coordinate < 0) continue;
    double limit = joint.type == JointType::kPrismatic ? kSlidingSpeed : kTurningSpeed;
    if (joint.velocity > 0.0 && std::isfinite(joint.velocity)) limit = joint.velocity;
    double& value = velocity[static_cast<std::size_t>(joint.coordinate)];
    if (joint.multiplier != 0.0) value = std::min(value, limit / std::abs(joint.multiplier));
  }
  return velocity;
}

void check_list(const std::string& name, const std::vector<double>& values, Index count) {
  if (std::ssize(values) != count) {
    throw_argument(name, std::to_string(count) + " numbers, one a coordinate",
                   std::to_string(values.size()));
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    check_positive(name + "[" + std::to_string(k) + "]", values[k]);
  }
}

std::vector<double> tolerances(JointView path, const TimingOptions& options) {
  const auto count = static_cast<std::size_t>(path.rows());
  if (options.row_tolerance.empty()) return std::vector<double>(count, options.tolerance);
  if (options.row_tolerance.size() != count) {
    throw_argument("row_tolerance", std::to_string(count) + " numbers, one a row",
                   std::to_string(options.row_tolerance.size()));
  }
  return options.row_tolerance;
}

TimedMotion sampled(const workspace::RoundedPath& path, const std::vector<workspace::Phase>& phases,
                    JointView rows, double step) {
  const double whole = duration(phases), steps = std::ceil(whole / step);
  if (!(steps < kMaxRows)) {
    throw_argument("step", "a motion of at most 10⁷ rows",
                   to_text(step) + " s for a motion of " + to_text(whole) + " s");
  }
  const auto count = static_cast<Index>(std::max(1.0, steps)) + 1;
  TimedMotion motion;
  motion.q.resize(count, rows.cols());
  Eigen::RowVectorXd q(rows.cols());
  std::size_t phase = 0;
  for (Index i = 0; i < count; ++i) {
    const double time = whole * static_cast<double>(i) / static_cast<double>(count - 1);
    while (phase + 1 < phases.size() && time >= phases[phase + 1].start) ++phase;
    motion.along.push_back(path.at(phases[phase].piece, phases[phase].way_at(time), q));
    motion.q.row(i) = q;
    motion.time.push_back(time);
  }
  motion.q.row(0) = rows.row(0);
  motion.q.row(count - 1) = rows.row(rows.rows() - 1);
  motion.along.back() = static_cast<double>(rows.rows() - 1);
  return motion;
}

}  // namespace

MotionLimits default_limits(const Arm& arm) { return complete_limits(arm, {}); }

MotionLimits complete_limits(const Arm& arm, const MotionLimits& limits) {
  MotionLimits full = limits;
  if (full.velocity.empty()) full.velocity = default_velocity(arm);
  if (full.acceleration.empty()) full.acceleration = default_acceleration(arm);
  if (full.jerk.empty()) {
    for (const double acceleration : full.acceleration) {
      full.jerk.push_back(acceleration / kJerkTime);
    }
  }
  check_list("velocity", full.velocity, arm.size());
  check_list("acceleration", full.acceleration, arm.size());
  check_list("jerk", full.jerk, arm.size());
  return full;
}

void TimingOptions::check() const {
  check_positive("step", step);
  check_not_negative("tolerance", tolerance);
  for (const double value : row_tolerance) check_not_negative("row_tolerance", value);
}

TimedMotion time_motion(const Arm& arm, JointView path, const MotionLimits& limits,
                        const TimingOptions& options) {
  check_joint_values(arm, path, "path");
  if (path.rows() == 0) throw_argument("path", "one row or more", "none");
  options.check();
  const MotionLimits full = complete_limits(arm, limits);
  const workspace::RoundedPath rounded(path, full, tolerances(path, options));
  if (rounded.pieces().empty()) return {path.topRows(1), {0.0}, {0.0}};
  return sampled(rounded, workspace::speed_profile(rounded.pieces()), path, options.step);
}

}  // namespace bathyal
