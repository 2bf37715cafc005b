// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bathyal/navigation/navigation_options.hpp"

namespace bathyal {

/// Errors the filter keeps a covariance of, in order; true = estimate + error, attitudes
/// true = exp(error) · estimate, in the world:
///   0 position, 3 velocity, 6 attitude, 9 gyro bias, 12 accelerometer bias, 15 log scale,
///   16 log mount, 19 current, 21 fix lever
inline constexpr int kNavigationErrors = 24;
using NavigationMatrix = Eigen::Matrix<double, kNavigationErrors, kNavigationErrors>;
using NavigationVector = Eigen::Matrix<double, kNavigationErrors, 1>;

/// What the filter believes at one moment: plain numbers.
struct NavigationEstimate {
  double time = 0.0;                     ///< [s]
  Vec3 position = Vec3::Zero();          ///< of the vehicle's origin in the world [m]
  Vec3 velocity = Vec3::Zero();          ///< over ground, in the world [m/s]
  Eigen::Vector4d attitude{0, 0, 0, 1};  ///< world_from_vehicle, a quaternion x y z w
  Vec3 gyro_bias = Vec3::Zero();         ///< in the vehicle [rad/s]
  Vec3 accel_bias = Vec3::Zero();        ///< in the vehicle [m/s²]
  double log_scale = 0.0;                ///< the log reads 1 + this times the speed
  Vec3 log_mount = Vec3::Zero();  ///< by which the log is turned more than its mount says [rad]
  Eigen::Vector2d current{0, 0};  ///< of the water in the world [m/s]
  Vec3 fix_lever = Vec3::Zero();  ///< from where fixes should belong to, in the vehicle [m]
  NavigationMatrix covariance = NavigationMatrix::Zero();

  // The last input of predict(), which holds until the next one.
  int input = 0;                         ///< 0 none yet, 1 inertial, 2 motion
  double input_time = 0.0;               ///< of it [s]
  Vec3 rate = Vec3::Zero();              ///< of turn, as measured [rad/s]
  Vec3 force = Vec3::Zero();             ///< specific, as measured [m/s²]; or velocity [m/s]
  Eigen::Vector4d reported{0, 0, 0, 1};  ///< the last attitude of predict_motion
  std::int64_t steps = 0;                ///< of the record, so far

  Pose world_from_vehicle() const;
  /// Where position fixes belong to, in the world [m]: the origin, and the fix lever off it.
  Vec3 fix_point() const;
};

/// An inertial sample, a motion or a reading, kept for the time that readings may be late.
struct NavigationInput {
  int kind = 0;  ///< 1 inertial, 2 motion, 3 reading
  double time = 0.0;
  Vec3 first = Vec3::Zero();             ///< rate; of a motion its walk, 0, 0
  Vec3 second = Vec3::Zero();            ///< force, or velocity
  Eigen::Vector4d attitude{0, 0, 0, 1};  ///< of a motion
  SensorReading reading;
  int device = -1;
};

struct NavigationSnapshot {
  NavigationEstimate estimate;
  std::int64_t next_input = 0;  ///< the first that is not in it, counted from the start
};

/// All a filter remembers: plain numbers, so that a run can be saved and resumed.
struct NavigationState {
  NavigationEstimate now;
  std::int64_t dropped = 0;  ///< inputs that are no longer kept
  std::vector<NavigationInput> inputs;
  std::vector<NavigationSnapshot> snapshots;
};

/// What became of a reading.
struct NavigationUpdate {
  bool used = false;      ///< it says something of the motion, was valid and not too late
  bool accepted = false;  ///< and passed the gate
  int count = 0;          ///< of channels
  std::array<double, kSensorChannels> innovation{};  ///< reading − predicted
  Eigen::Matrix<double, kSensorChannels, kSensorChannels> covariance =
      Eigen::Matrix<double, kSensorChannels,
                    kSensorChannels>::Zero();  ///< of it, the first `count`
  double nis = 0.0;  ///< its square by that covariance; mean `count` where the filter is right
};

struct NavigationStep;  // internal/filter_steps.hpp

/// Error-state Kalman filter on a unit quaternion (Solà 2017, "Quaternion kinematics for the
/// error-state Kalman filter", global errors), covariances updated in Joseph's form. The world is
/// flat and does not turn; z is up. Two ways to predict, one a filter: by inertial samples, or by a
/// reported attitude and a velocity log.
class NavigationFilter {
 public:
  /// \throw std::invalid_argument as options.check()
  explicit NavigationFilter(NavigationOptions options);

  const NavigationOptions& options() const { return options_; }

  /// \param velocity over ground, in the world [m/s]
  /// \throw std::invalid_argument for a pose that is not rigid, or numbers that are not finite
  NavigationState start(double time, const Pose& world_from_vehicle,
                        const Vec3& velocity = Vec3::Zero()) const;

  /// By a sample of rates of turn [rad/s] and specific forces [m/s²] at the vehicle's origin, in
  /// its frame; between samples they change linearly. The first one only begins.
  /// \throw std::invalid_argument for a time that does not rise, or numbers that are not finite
  void predict(NavigationState& state, double time, const Vec3& rate, const Vec3& force,
               std::vector<NavigationStep>* record = nullptr) const;

  /// By an attitude as reported (its turn since the last one counts) and a velocity over ground in
  /// the vehicle [m/s], or through the water where the option `current` is above 0; between times
  /// the velocity in the world changes linearly.
  /// \param walk of the position beyond the options', of a velocity that is not measured [m/√s]
  /// \throw std::invalid_argument likewise
  void predict_motion(NavigationState& state, double time, const Eigen::Quaterniond& attitude,
                      const Vec3& velocity, std::vector<NavigationStep>* record = nullptr,
                      double walk = 0.0) const;

  /// By a reading of a device, at the reading's own time: what came since is done again; until a
  /// time ahead of the last input, that input holds. One of an imu predicts. Kinds that say nothing
  /// of the motion, and readings that are not valid or older than the lag, change nothing.
  /// \throw std::invalid_argument for a device that is none of the options', a reading of another
  ///        kind, one more than a second ahead, or values that are not finite
  NavigationUpdate update(NavigationState& state, int device, const SensorReading& reading,
                          std::vector<NavigationStep>* record = nullptr) const;

  /// Row of a device by its name. \throw std::invalid_argument that lists them for another.
  int device(const std::string& name) const;

 private:
  /// By a sample of an imu that is mounted off the vehicle's origin, or turned.
  void predict_reading(NavigationState& state, const Pose& mount, const SensorReading& reading,
                       std::vector<NavigationStep>* record) const;

  NavigationOptions options_;
};

}  // namespace bathyal
