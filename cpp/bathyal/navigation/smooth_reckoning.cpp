// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/smooth_reckoning.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/navigation/dead_reckoning.hpp"
#include "bathyal/navigation/internal/filter_steps.hpp"
#include "bathyal/navigation/internal/rising_times.hpp"
#include "bathyal/navigation/navigation_smoother.hpp"

namespace bathyal {
namespace {

void check_input(const ReckonedTrack& track, const PositionFixes& fixes) {
  if (track.time.size() < 2) {
    throw_argument("time", "two times or more", std::to_string(track.time.size()));
  }
  check_rising_times("time", track.time);
  check_rows("attitude", track.attitude, track.time.size());
  check_rows("velocity", track.velocity, track.time.size());
  if (fixes.time.empty()) throw_argument("fix_time", "at least one time", "none");
  check_rising_times("fix_time", fixes.time);
  check_rows("fix_position", fixes.position, fixes.time.size());
  for (const double noise : fixes.noise) check_positive("fix_noise", noise);
  if (fixes.time.front() < track.time.front() || fixes.time.back() > track.time.back()) {
    throw_argument(
        "fix_time",
        "times from " + to_text(track.time.front()) + " to " + to_text(track.time.back()),
        to_text(fixes.time.front()) + " to " + to_text(fixes.time.back()));
  }
}

/// Held values replaced by what lies linearly between the fresh ones.
PointMatrix between_fresh(const std::vector<double>& time, const PointMatrix& rows) {
  const std::vector<bool> fresh = fresh_rows(rows);
  PointMatrix result = rows;
  Eigen::Index last = 0;
  for (Eigen::Index i = 1; i < rows.rows(); ++i) {
    if (!fresh[static_cast<std::size_t>(i)]) continue;
    const double from = time[static_cast<std::size_t>(last)];
    const double span = time[static_cast<std::size_t>(i)] - from;
    for (Eigen::Index k = last + 1; k < i; ++k) {
      const double share = (time[static_cast<std::size_t>(k)] - from) / span;
      result.row(k) = rows.row(last) + share * (rows.row(i) - rows.row(last));
    }
    last = i;
  }
  return result;
}

SensorOptions fix_device(const Vec3& noise) {
  SensorOptions device;
  device.name = "fix";
  device.kind = SensorKind::gps;
  for (std::size_t i = 0; i < 3; ++i) device.channels[i].noise = noise[static_cast<int>(i)];
  return device;
}

/// A fix between two rows is late for the second one.
NavigationOptions options_with(const NavigationOptions& given, const ReckonedTrack& track,
                               const PositionFixes& fixes) {
  constexpr double kUnknown = 1e4;  // [m]
  NavigationOptions options = given;
  options.initial_position.setConstant(kUnknown);
  options.devices = {fix_device(fixes.noise)};
  options.lag = 0.0;
  for (std::size_t i = 1; i < track.time.size(); ++i) {
    options.lag = std::max(options.lag, track.time[i] - track.time[i - 1]);
  }
  return options;
}

Vec3 row_of(const PointMatrix& rows, std::size_t i) {
  return rows.row(static_cast<Eigen::Index>(i)).transpose();
}

Eigen::Quaterniond attitude_of(const ReckonedTrack& track, std::size_t i) {
  return Eigen::Quaterniond(rotation_of_angles(row_of(track.attitude, i)));
}

Pose first_pose(const ReckonedTrack& track, const PositionFixes& fixes) {
  Pose pose = Pose::Identity();
  pose.linear() = attitude_of(track, 0).toRotationMatrix();
  pose.translation() = row_of(fixes.position, 0);
  return pose;
}

SensorReading fix_reading(double time, const Vec3& position) {
  SensorReading reading;
  reading.kind = SensorKind::gps;
  reading.time = reading.arrival = time;
  reading.count = 3;
  for (std::size_t i = 0; i < 3; ++i) reading.values[i] = position[static_cast<int>(i)];
  return reading;
}

}  // namespace

std::vector<bool> fresh_rows(const PointMatrix& rows) {
  std::vector<bool> fresh(static_cast<std::size_t>(rows.rows()), true);
  for (Eigen::Index i = 1; i < rows.rows(); ++i) {
    fresh[static_cast<std::size_t>(i)] = (rows.row(i).array() != rows.row(i - 1).array()).any();
  }
  return fresh;
}

NavigationOptions reckoning_options() {
  NavigationOptions options;
  options.initial_attitude = Vec3(0.0, 0.0, 0.035);
  options.gyro_noise = 1e-4;
  options.log_noise = 0.02;
  options.log_walk = 0.1;
  options.log_scale = 0.01;
  options.current = 0.1;
  options.current_time = 300.0;
  options.fix_lever = 2.0;
  return options;
}

SmoothedTrack smooth_reckoning(const ReckonedTrack& track, const PositionFixes& fixes,
                               const NavigationOptions& options) {
  check_input(track, fixes);
  const PointMatrix velocity = between_fresh(track.time, track.velocity);
  NavigationRecord record(options_with(options, track, fixes));
  const NavigationFilter& filter = record.filter();
  NavigationState state = filter.start(track.time.front(), first_pose(track, fixes));
  SmoothedTrack result;
  std::size_t next = 0;
  for (std::size_t i = 0; i < track.time.size(); ++i) {
    filter.predict_motion(state, track.time[i], attitude_of(track, i), row_of(velocity, i),
                          &record.steps());
    for (; next < fixes.time.size() && fixes.time[next] <= track.time[i]; ++next) {
      const SensorReading fix = fix_reading(fixes.time[next], row_of(fixes.position, next));
      result.fixes.push_back(filter.update(state, 0, fix, &record.steps()));
    }
  }
  result.estimate = record.smoothed();
  return result;
}

}  // namespace bathyal
