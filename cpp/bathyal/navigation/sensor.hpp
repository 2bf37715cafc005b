// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

using Vec6 = Eigen::Matrix<double, 6, 1>;

inline constexpr int kSensorChannels = 12;

/// What a sensor measures. Its channels, in order; "in its frame" is the frame of the mount:
///   depth      below the mean surface [m]
///   imu        angular rate x y z [rad/s], specific force x y z [m/s²], in its frame
///   dvl        velocity over ground x y z, in its frame [m/s]
///   compass    roll, pitch, yaw of the vehicle about x, y, z [rad]: world_from_vehicle = Rz Ry Rx;
///              yaw counts from the world's x, counterclockwise; pitch is positive bow down
///   gps        position of the antenna in the world x y z [m]; only above the surface
///   usbl       position of the transponder in the world x y z [m]
///   lbl        range to each beacon [m]
///   altimeter  altitude [m]
///   current    velocity of the water past the sensor x y z, in its frame [m/s]
///   rpm        turns of the propeller [1/s]
///   leak       water in the hull [kg]
///   modem      one-way travel time from the beacon [s]
enum class SensorKind {
  depth,
  imu,
  dvl,
  compass,
  gps,
  usbl,
  lbl,
  altimeter,
  current,
  rpm,
  leak,
  modem
};

/// Errors of one channel: standard deviations in its unit unless said otherwise; all 0 or more.
struct SensorChannel {
  double noise = 0.0;         ///< of each sample, normal
  double bias = 0.0;          ///< of a constant, drawn once a seed
  double scale = 0.0;         ///< of a scale error, drawn once a seed, as a part of the value
  double walk = 0.0;          ///< of a random walk from 0 on, per √s
  double markov = 0.0;        ///< of a first-order Gauss–Markov drift, stationary from the start
  double markov_time = 0.0;   ///< its correlation time [s]; above 0 where `markov` is
  double outlier_rate = 0.0;  ///< part of the samples, 0 to 1
  double outlier_size = 0.0;  ///< of what is added to them
  double quantum = 0.0;       ///< values are multiples of it; 0: as they are
};

struct SensorOptions {
  std::string name;  ///< keys the noise: two sensors of one name have the same
  SensorKind kind = SensorKind::depth;
  double rate = 1.0;     ///< of samples [Hz], above 0; sample k is due at k / rate
  double latency = 0.0;  ///< from validity to arrival [s]
  double dropout = 0.0;  ///< part of the samples that never come, 0 to 1
  double range = std::numeric_limits<double>::infinity();  ///< beyond it nothing is heard [m]; of a
                                                           ///< dvl, an altimeter: altitude
  double sound_speed = 1500.0;                             ///< [m/s]; of usbl, lbl and modem
  Pose vehicle_from_sensor = Pose::Identity();
  std::vector<Vec3> beacons;  ///< in the world [m]: the ship of usbl, modem; 1 to 12 of lbl
  std::array<SensorChannel, kSensorChannels> channels{};

  /// \throw std::invalid_argument that names the field
  void check() const;
  int channel_count() const;
};

/// The truth at one moment, as far as a sensor may feel it.
struct SensorTruth {
  double time = 0.0;  ///< [s]
  Pose world_from_vehicle = Pose::Identity();
  Vec6 velocity = Vec6::Zero();        ///< over ground and of turn, in the vehicle [m/s, rad/s]
  Vec6 acceleration = Vec6::Zero();    ///< change of the numbers of `velocity` [m/s², rad/s²]
  Vec3 water_velocity = Vec3::Zero();  ///< in the world [m/s]
  double altitude = std::numeric_limits<double>::quiet_NaN();  ///< [m]; NaN: no bottom
  double surface = 0.0;         ///< z of the surface above the vehicle, with its waves [m]
  double mean_surface = 0.0;    ///< z of the mean surface [m]
  double gravity = 9.81;        ///< [m/s²]
  double propeller_rate = 0.0;  ///< [1/s]
  double leak = 0.0;            ///< [kg]
};

struct SensorReading {
  SensorKind kind = SensorKind::depth;
  double time = 0.0;     ///< at which the values were so [s]
  double arrival = 0.0;  ///< at which they are known on board [s]
  std::int64_t index = 0;
  std::array<double, kSensorChannels> values{};
  int count = 0;      ///< of channels in use
  bool valid = true;  ///< false: the sensor says itself that it measured nothing
};

/// What a sensor remembers: plain numbers.
struct SensorState {
  std::int64_t index = -1;  ///< of the last sample; −1: none yet
  double time = 0.0;        ///< of the last sample [s]
  std::array<double, kSensorChannels> walk{};
  std::array<double, kSensorChannels> markov{};
};

/// Of the next sample [s].
double next_time(const SensorOptions& options, const SensorState& state);

/// What a sensor measures without any error; NaN where there is nothing (no bottom).
SensorReading ideal_reading(const SensorOptions& options, const SensorTruth& truth);

/// The sample due at truth.time; none before it is due, and none for a dropout. Noise is keyed by
/// (seed, name, channel, index), so that no other sensor changes it. A sensor that has nothing to
/// measure (no bottom in range, gps under water) returns a reading that is not valid. A fix of a
/// usbl comes late by the two-way travel time to its ship. \pre options.check() passed
std::optional<SensorReading> sample(const SensorOptions& options, SensorState& state,
                                    const SensorTruth& truth, std::uint64_t seed);

/// The kind of a name as above. \throw std::invalid_argument that lists them for another.
SensorKind sensor_kind(const std::string& name);
std::string sensor_kind_name(SensorKind kind);

}  // namespace bathyal
