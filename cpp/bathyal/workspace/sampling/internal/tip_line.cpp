// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/internal/tip_line.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bathyal/workspace/internal/postures.hpp"

namespace bathyal::workspace {
namespace {

constexpr double kLineStep = 5e-3;         // [m]
constexpr double kTipTolerance = 1e-6;     // [m]
constexpr double kTurnTolerance = 1e-5;    // [rad]
constexpr double kLargestChange = 0.3;     // of a coordinate in one step [rad], [m]
constexpr int kHalvings = 4;               // of the steps, until the tip keeps to the line
constexpr double kCornerTolerance = 2e-4;  // of a coordinate [rad], [m]

InverseOptions options_of(const TipAim& aim, int num_threads) {
  InverseOptions options{.task = aim.task, .axis = aim.axis};
  options.position_tolerance = kTipTolerance;
  options.angle_tolerance = kTurnTolerance;
  options.max_starts = 1;
  options.num_threads = num_threads;
  return options;
}

std::optional<JointMatrix> follow_in_steps(const Arm& arm, std::span<const double> start,
                                           const Vec3& from, const Vec3& to, const TipAim& aim,
                                           Index steps) {
  JointMatrix q(steps + 1, arm.size());
  q.row(0) = Eigen::Map<const Eigen::RowVectorXd>(start.data(), arm.size());
  for (Index i = 1; i <= steps; ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(steps);
    const JointMatrix before = q.row(i - 1);
    const JointMatrix found = reaching(arm, from + fraction * (to - from), aim, before, 1);
    if (found.rows() == 0) return std::nullopt;
    q.row(i) = found.row(0);
    if ((q.row(i) - q.row(i - 1)).cwiseAbs().maxCoeff() > kLargestChange) return std::nullopt;
  }
  return q;
}

/// Tips of all rows, in their order.
std::vector<Vec3> tips_of(const Arm& arm, const JointMatrix& q) {
  const std::vector<double> poses = forward(arm, view_of(q), 1);
  std::vector<Vec3> tips(static_cast<std::size_t>(q.rows()));
  for (std::size_t i = 0; i < tips.size(); ++i) {
    tips[i] = Vec3(poses[16 * i + 3], poses[16 * i + 7], poses[16 * i + 11]);
  }
  return tips;
}

double largest_speed(const Arm& arm, const TimedMotion& motion) {
  const std::vector<Vec3> tips = tips_of(arm, motion.q);
  double speed = 0.0;
  for (std::size_t i = 1; i < tips.size(); ++i) {
    const double duration = motion.time[i] - motion.time[i - 1];
    speed = std::max(speed, (tips[i] - tips[i - 1]).norm() / duration);
  }
  return speed;
}

}  // namespace

Pose TipAim::at(const Vec3& point) const {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(axis, direction).toRotationMatrix();
  pose.translation() = point;
  return pose;
}

JointMatrix reaching(const Arm& arm, const Vec3& point, const TipAim& aim,
                     const JointMatrix& starts, int num_threads) {
  return reached_postures(arm, aim.at(point), starts, options_of(aim, num_threads)).q;
}

std::optional<JointMatrix> follow_line(const Arm& arm, std::span<const double> start,
                                       const Vec3& from, const Vec3& to, const TipAim& aim,
                                       double tolerance) {
  auto steps = std::max<Index>(1, static_cast<Index>(std::ceil((to - from).norm() / kLineStep)));
  for (int i = 0; i < kHalvings; ++i, steps *= 2) {
    std::optional<JointMatrix> q = follow_in_steps(arm, start, from, to, aim, steps);
    if (!q || line_error(arm, *q, from, to) <= 0.5 * tolerance) return q;
  }
  return std::nullopt;
}

double line_error(const Arm& arm, const JointMatrix& q, const Vec3& from, const Vec3& to) {
  JointMatrix rows(std::max<Index>(1, 2 * q.rows() - 1), q.cols());
  for (Index i = 0; i < q.rows(); ++i) {
    rows.row(2 * i) = q.row(i);
    if (i + 1 < q.rows()) rows.row(2 * i + 1) = 0.5 * (q.row(i) + q.row(i + 1));
  }
  const Vec3 along = (to - from).normalized();
  double error = 0.0;
  for (const Vec3& tip : tips_of(arm, rows)) {
    error = std::max(error, (tip - from).cross(along).norm());
  }
  return error;
}

std::optional<TimedMotion> time_line(const Arm& arm, const JointMatrix& rows, const Vec3& from,
                                     const Vec3& to, const LineTiming& timing) {
  double corner = kCornerTolerance;
  for (int i = 0; i < kHalvings; ++i, corner *= 0.25) {
    TimedMotion motion =
        time_motion(arm, view_of(rows), timing.limits, {.step = timing.step, .tolerance = corner});
    if (line_error(arm, motion.q, from, to) > timing.tolerance) continue;
    const double slower = std::max(1.0, largest_speed(arm, motion) / timing.speed);
    for (double& time : motion.time) time *= slower;
    return motion;
  }
  return std::nullopt;
}

}  // namespace bathyal::workspace
