// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/internal/observation.hpp"

#include <cmath>
#include <numbers>

namespace bathyal {
namespace {

using Eigen::Matrix3d;

/// What the observations of all kinds are made of.
struct Frame {
  Matrix3d turn;   ///< world_from_vehicle
  Matrix3d mount;  ///< vehicle_from_sensor
  Vec3 arm;        ///< of the sensor, in the vehicle
  const NavigationEstimate& estimate;
};

Vec3 first_three(const SensorReading& reading) {
  return {reading.values[0], reading.values[1], reading.values[2]};
}

void observe_depth(const NavigationOptions& options, const Frame& frame,
                   const SensorReading& reading, Observation& got) {
  const Vec3 arm = frame.turn * frame.arm;
  const double predicted = options.mean_surface - frame.estimate.position.z() - arm.z();
  got.innovation[0] = reading.values[0] - predicted;
  got.slope(0, kPosition + 2) = -1.0;
  got.slope.block<1, 3>(0, kAttitude) = cross_matrix(arm).row(2);
}

/// (1 + scale) (1 − [mount]×) h, h the sensor's velocity over ground in its own frame.
void observe_dvl(const Frame& frame, const SensorReading& reading, Observation& got) {
  const NavigationEstimate& e = frame.estimate;
  const Vec3 spin = e.input == 1 ? Vec3(e.rate - e.gyro_bias) : e.rate;
  const Matrix3d vehicle_from_world = frame.turn.transpose();
  const Matrix3d sensor_from_vehicle = frame.mount.transpose();
  const Vec3 h = sensor_from_vehicle * (vehicle_from_world * e.velocity + spin.cross(frame.arm));
  const Matrix3d outer = (1.0 + e.log_scale) * (Matrix3d::Identity() - cross_matrix(e.log_mount));
  const Matrix3d inner = outer * sensor_from_vehicle;
  got.innovation = first_three(reading) - outer * h;
  got.slope.block<3, 3>(0, kVelocity) = inner * vehicle_from_world;
  got.slope.block<3, 3>(0, kAttitude) = inner * vehicle_from_world * cross_matrix(e.velocity);
  if (e.input == 1) got.slope.block<3, 3>(0, kGyroBias) = inner * cross_matrix(frame.arm);
  got.slope.col(kLogScale) = outer * h / (1.0 + e.log_scale);
  got.slope.block<3, 3>(0, kLogMount) = (1.0 + e.log_scale) * cross_matrix(h);
}

/// The velocity of the water past the sensor; the vertical current is taken for 0.
void observe_current(const Frame& frame, const SensorReading& reading, Observation& got) {
  const NavigationEstimate& e = frame.estimate;
  const Vec3 spin = e.input == 1 ? Vec3(e.rate - e.gyro_bias) : e.rate;
  const Matrix3d sensor_from_vehicle = frame.mount.transpose();
  const Matrix3d sensor_from_world = sensor_from_vehicle * frame.turn.transpose();
  const Vec3 past = Vec3(e.current.x(), e.current.y(), 0.0) - e.velocity;
  got.innovation =
      first_three(reading) - sensor_from_world * past + sensor_from_vehicle * spin.cross(frame.arm);
  got.slope.block<3, 3>(0, kVelocity) = -sensor_from_world;
  got.slope.block<3, 3>(0, kAttitude) = sensor_from_world * cross_matrix(past);
  if (e.input == 1) {
    got.slope.block<3, 3>(0, kGyroBias) = -sensor_from_vehicle * cross_matrix(frame.arm);
  }
  got.slope.block<3, 2>(0, kCurrent) = sensor_from_world.leftCols<2>();
}

/// The measured attitude is a small turn in the world from the predicted one; its parts about x'',
/// y', z are what roll, pitch and yaw are wrong by.
void observe_compass(const Frame& frame, const SensorReading& reading, Observation& got) {
  const Matrix3d& r = frame.turn;
  const double roll = std::atan2(r(2, 1), r(2, 2));
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2)));
  const double yaw = std::atan2(r(1, 0), r(0, 0));
  const Vec3 angles(roll, pitch, yaw);
  for (int i = 0; i < 3; ++i) {
    got.innovation[i] = std::remainder(reading.values[static_cast<std::size_t>(i)] - angles[i],
                                       2.0 * std::numbers::pi);
  }
  Matrix3d axes;
  axes << std::cos(yaw) * std::cos(pitch), -std::sin(yaw), 0.0,  //
      std::sin(yaw) * std::cos(pitch), std::cos(yaw), 0.0,       //
      -std::sin(pitch), 0.0, 1.0;
  got.slope.block<3, 3>(0, kAttitude) = axes.inverse();
}

void observe_fix(const Frame& frame, const SensorReading& reading, Observation& got) {
  const Vec3 arm = frame.turn * (frame.arm + frame.estimate.fix_lever);
  got.innovation = first_three(reading) - frame.estimate.position - arm;
  got.slope.block<3, 3>(0, kPosition).setIdentity();
  got.slope.block<3, 3>(0, kAttitude) = -cross_matrix(arm);
  got.slope.block<3, 3>(0, kFixLever) = frame.turn;
}

void observe_ranges(const Frame& frame, const SensorOptions& device, const SensorReading& reading,
                    Observation& got) {
  const Vec3 arm = frame.turn * frame.arm;
  const Vec3 at = frame.estimate.position + arm;
  for (Eigen::Index i = 0; i < got.innovation.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 off = at - device.beacons[k];
    const double range = off.norm();
    got.innovation[i] = reading.values[k] - range;
    if (range == 0.0) continue;
    got.slope.block<1, 3>(i, kPosition) = off.transpose() / range;
    got.slope.block<1, 3>(i, kAttitude) = -off.transpose() / range * cross_matrix(arm);
  }
}

/// Noise, and what else spreads a sample about the truth, as if it were drawn anew each time. A
/// scale that is estimated is not counted twice.
double variance_of(const NavigationOptions& options, const SensorReading& reading,
                   const SensorChannel& c, double value) {
  const bool estimated = reading.kind == SensorKind::dvl && options.log_scale > 0.0;
  const double scale = estimated ? 0.0 : c.scale * value;
  return c.noise * c.noise + c.bias * c.bias + scale * scale + c.markov * c.markov +
         c.quantum * c.quantum / 12.0;
}

}  // namespace

Matrix3d cross_matrix(const Vec3& v) {
  Matrix3d cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return cross;
}

bool observes_motion(SensorKind kind) {
  switch (kind) {
    case SensorKind::depth:
    case SensorKind::dvl:
    case SensorKind::compass:
    case SensorKind::gps:
    case SensorKind::usbl:
    case SensorKind::lbl:
    case SensorKind::current:
      return true;
    default:
      return false;
  }
}

Observation observe(const NavigationOptions& options, const NavigationEstimate& estimate,
                    const SensorOptions& device, const SensorReading& reading) {
  const int count = reading.count;
  Observation got{ObservationVector::Zero(count), ObservationRows::Zero(count, kNavigationErrors),
                  ObservationVector::Zero(count)};
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    got.variance[i] = variance_of(options, reading, device.channels[k], reading.values[k]);
  }
  const Frame frame{estimate.world_from_vehicle().linear(), device.vehicle_from_sensor.linear(),
                    device.vehicle_from_sensor.translation(), estimate};
  switch (reading.kind) {
    case SensorKind::depth:
      observe_depth(options, frame, reading, got);
      break;
    case SensorKind::dvl:
      observe_dvl(frame, reading, got);
      break;
    case SensorKind::compass:
      observe_compass(frame, reading, got);
      break;
    case SensorKind::lbl:
      observe_ranges(frame, device, reading, got);
      break;
    case SensorKind::current:
      observe_current(frame, reading, got);
      break;
    default:
      observe_fix(frame, reading, got);
      break;
  }
  return got;
}

}  // namespace bathyal
