// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/navigation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/sonar/vehicle_motion.hpp"

namespace bathyal {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kMostReadings = 1e8;

enum Sensor : std::uint64_t { kReading = 1, kFix, kAltimeter };

/// The numbers of a sensor's reading, whichever other readings there are.
RandomStream reading_stream(std::uint64_t seed, Sensor sensor, std::int64_t number) {
  return RandomStream(RandomStream(seed, sensor).next(), static_cast<std::uint64_t>(number));
}

double wrapped_heading(double angle) {
  const double turned = std::fmod(angle, kTurn);
  return turned < 0.0 ? turned + kTurn : turned;
}

struct Attitude {
  double heading = 0.0, pitch = 0.0, roll = 0.0;
};

Attitude attitude_of(const Pose& world_from_vehicle) {
  const Eigen::Matrix3d turn = world_from_vehicle.linear();
  return {wrapped_heading(std::atan2(turn(0, 0), turn(1, 0))),
          std::asin(std::clamp(turn(2, 0), -1.0, 1.0)), std::atan2(turn(2, 1), turn(2, 2))};
}

/// Reads the sensors one reading after another and keeps what is reckoned from them.
class Reckoning {
 public:
  Reckoning(const NavigationErrors& errors, const Trajectory& trajectory, double start,
            std::uint64_t seed)
      : errors_(errors), trajectory_(trajectory), start_(start), seed_(seed) {}

  /// Everything is read at a time, the next in order.
  void read(double time) {
    RandomStream random = reading_stream(seed_, kReading, readings_);
    const Pose pose = trajectory_.at(time);
    const double passed = readings_ == 0 ? 0.0 : time - time_;
    read_attitude(time, passed, random);
    reckon(pose.translation(), passed, random);
    height_error_ = -errors_.depth_bias - errors_.depth_noise * random.normal();
    take_fix(time);
    position_ = pose.translation();
    speed_ = motion_at(trajectory_, time).velocity.head<2>().norm() * (1.0 + errors_.speed_scale);
    time_ = time;
    ++readings_;
  }

  Vec3 position() const { return position_ + Vec3(drift_.x(), drift_.y(), height_error_); }
  const Attitude& attitude() const { return attitude_; }
  double speed() const { return speed_; }

 private:
  void read_attitude(double time, double passed, RandomStream& random) {
    attitude_ = attitude_of(trajectory_.at(time - errors_.attitude_lag));
    gyro_ += errors_.heading_walk * std::sqrt(passed) * random.normal();
    const double before = attitude_of(trajectory_.at(time)).heading;
    attitude_.heading = wrapped_heading(attitude_.heading + errors_.heading_bias + gyro_ +
                                        errors_.heading_noise * random.normal());
    heading_error_ = attitude_.heading - before;
    attitude_.pitch += errors_.pitch_bias + errors_.attitude_noise * random.normal();
    attitude_.roll += errors_.roll_bias + errors_.attitude_noise * random.normal();
  }

  /// The way since the last reading is turned by the error of the heading, and longer by the log's.
  void reckon(const Vec3& place, double passed, RandomStream& random) {
    const double east = random.normal(), north = random.normal();
    drift_ += errors_.position_walk * std::sqrt(passed) * Eigen::Vector2d(east, north);
    if (readings_ == 0) return;
    const Eigen::Vector2d way = (place - position_).head<2>();
    const double cosine = std::cos(heading_error_), sine = std::sin(heading_error_);
    const double scale = 1.0 + errors_.speed_scale;
    drift_ += Eigen::Vector2d((scale * cosine - 1.0) * way.x() + scale * sine * way.y(),
                              (scale * cosine - 1.0) * way.y() - scale * sine * way.x());
  }

  void take_fix(double time) {
    if (errors_.fix_interval == 0.0) return;
    const auto number = static_cast<std::int64_t>((time - start_) / errors_.fix_interval + 1e-9);
    if (number == fix_) return;
    fix_ = number;
    RandomStream random = reading_stream(seed_, kFix, number);
    const double east = random.normal(), north = random.normal();
    drift_ = errors_.fix_noise * Eigen::Vector2d(east, north);
  }

  const NavigationErrors& errors_;
  const Trajectory& trajectory_;
  double start_;
  std::uint64_t seed_;
  std::int64_t readings_ = 0, fix_ = -1;
  double time_ = 0.0;
  Vec3 position_ = Vec3::Zero();  ///< where it is
  Eigen::Vector2d drift_ = Eigen::Vector2d::Zero();
  double gyro_ = 0.0, heading_error_ = 0.0, height_error_ = 0.0, speed_ = 0.0;
  Attitude attitude_;
};

void check_times(const std::vector<double>& time) {
  for (std::size_t i = 0; i < time.size(); ++i) {
    check_finite("time", time[i]);
    if (i > 0 && time[i] < time[i - 1]) {
      throw_argument("time", "times that rise",
                     to_text(time[i]) + " after " + to_text(time[i - 1]));
    }
  }
}

}  // namespace

ReportedNavigation report_navigation(const NavigationErrors& errors,
                                     const Trajectory& world_from_vehicle,
                                     const std::vector<double>& time, std::optional<double> surface,
                                     std::uint64_t seed) {
  errors.check();
  check_times(time);
  ReportedNavigation reported;
  reported.position.resize(static_cast<Index>(time.size()), 3);
  if (time.empty()) return reported;
  const double start = time.front();
  if ((time.back() - start) * errors.rate > kMostReadings) {
    throw_argument("rate", "no more than 10⁸ readings", to_text(errors.rate) + " Hz");
  }
  Reckoning reckoning(errors, world_from_vehicle, start - errors.latency, seed);
  std::int64_t next = 0;  // reading at `rate`
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (errors.rate == 0.0) {
      reckoning.read(time[k] - errors.latency);
    } else {
      const double passed = (time[k] - start) * errors.rate + 1e-9;
      for (; static_cast<double>(next) <= passed; ++next) {
        reckoning.read(start - errors.latency + static_cast<double>(next) / errors.rate);
      }
    }
    const Vec3 position = reckoning.position();
    reported.position.row(static_cast<Index>(k)) = position.transpose();
    reported.heading.push_back(reckoning.attitude().heading);
    reported.pitch.push_back(reckoning.attitude().pitch);
    reported.roll.push_back(reckoning.attitude().roll);
    reported.depth.push_back(surface ? *surface - position.z()
                                     : std::numeric_limits<double>::quiet_NaN());
    reported.speed.push_back(reckoning.speed());
  }
  return reported;
}

double report_altitude(const NavigationErrors& errors, double altitude, std::int64_t ping,
                       std::uint64_t seed) {
  RandomStream random = reading_stream(seed, kAltimeter, ping);
  return altitude + errors.altitude_bias + errors.altitude_noise * random.normal();
}

}  // namespace bathyal
