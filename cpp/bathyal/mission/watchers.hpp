// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/navigation/navigation_filter.hpp"
#include "bathyal/vehicle/vehicle_system.hpp"

namespace bathyal {

/// When watchers report.
struct WatcherOptions {
  double silence = 3.0;        ///< a sensor is off after so many of its periods, and 1 s
  double lost = 0.15;          ///< share of samples that do not come, beyond its dropouts
  double late = 0.3;           ///< beyond its latency [s]
  int repeats = 15;            ///< equal readings in a row: it is stuck
  double refused = 0.5;        ///< share of readings that the filter refuses, or that jump
  double suspected = 0.15;     ///< the same, from which on what rests on it is not assessed
  double rise = 0.02;          ///< between vertical speeds of depth sensor and velocity log [m/s]
  double turn = 0.01;          ///< between rates of turn of compass and gyro [rad/s]
  double turn_persist = 5.0;   ///< of that [s]
  double rolling = 0.03;       ///< mean rate of roll or pitch, that no vehicle keeps up [rad/s]
  double force = 0.15;         ///< of the mean specific force, from gravity [m/s²]
  double level = 0.1;          ///< of that along the level, by which the compass is wrong [m/s²]
  double mean = 0.3;           ///< of the normalised innovations of some 200 readings
  double speed_share = 0.2;    ///< of a propeller's expected speed
  double speed_least = 3.0;    ///< [1/s]
  double angle_least = 0.05;   ///< of a fin [rad]
  double voltage_least = 0.4;  ///< below the expected [V]
  double persist = 1.0;        ///< [s]
  double leak_least = 0.05;    ///< [kg]
};

/// A thruster, a fin, the battery or the hull, reported once.
struct DeviceWatch {
  double since = -1.0;  ///< of what is not right [s]; −1: all is right
  bool reported = false;
  double expected = 0.0;  ///< speed or angle
};

/// A sensor, reported once.
struct SensorWatch {
  double seen = 0.0;             ///< its last sign of life [s]
  std::int64_t index = -1;       ///< of its last sample
  std::int32_t repeats = 0;      ///< equal readings in a row
  double lost = 0.0;             ///< share, of the last 50 or so
  double late = 0.0;             ///< mean beyond its latency, of the last 20 or so [s]
  double refused = 0.0;          ///< share, of the last ten or so
  std::array<double, 3> mean{};  ///< of normalised innovations, of the last 200 or so
  bool reported = false;
};

/// A mean rate of some 40 s, from 0 on, by one device.
struct RateWatch {
  double time = -1.0;  ///< of its last value [s]; −1: none yet
  double value = 0.0;  ///< the last one, of a device that measures what changes
  double since = 0.0;  ///< [s]
  double mean = 0.0;
};

struct WatcherState {
  std::vector<SensorWatch> sensors;
  std::vector<DeviceWatch> thrusters, fins;
  DeviceWatch battery, hull;
  RateWatch depth_rise, log_rise, altimeter_rise;  ///< upwards [m/s]
  RateWatch compass_turn, gyro_turn;               ///< about the vertical [rad/s]
  RateWatch roll, pitch;                           ///< by the gyro [rad/s]
  RateWatch force;                                 ///< specific, beyond gravity [m/s²]
  RateWatch level_x, level_y;                      ///< specific force along the level [m/s²]
  double turn_since = -1.0;  ///< of compass and gyro apart [s]; −1: they are not
};

struct DeviceReport {
  std::string device, kind;
};

/// Looks at what is known on board, and names the device that it cannot explain. A sensor by
/// itself: silence, lost and late samples, equal readings, jumps that no vehicle makes. By others:
/// depth, velocity log and altimeter each know how fast the vehicle rises (of three the one apart
/// is wrong, of two the depth sensor), compass and gyro how fast it turns; no vehicle rolls on and
/// on, and an accelerometer measures gravity in the mean; the filter's innovations, as long as what
/// predicts is not suspected itself. Propellers and fins by what they turn against what their
/// commands ask for; the battery by its voltage; the hull by its leak sensor.
class Watchers {
 public:
  Watchers(const VehicleSystem& system, std::vector<SensorOptions> sensors,
           WatcherOptions options = {});

  WatcherState fresh() const;
  const WatcherOptions& options() const { return options_; }

  /// \param attitude world_from_vehicle, the last one reported \param update of the filter, if any
  void reading(WatcherState& state, int device, const SensorReading& before,
               const SensorReading& reading, const Eigen::Quaterniond& attitude,
               const NavigationUpdate* update, std::vector<DeviceReport>& reports) const;

  /// \param speeds, angles as the devices report them \param commands as the devices were asked
  void tick(WatcherState& state, double time, double step, const VehicleCommands& commands,
            const std::vector<double>& speeds, const std::vector<double>& angles, double voltage,
            double current, double charge, std::vector<DeviceReport>& reports) const;

 private:
  bool suspects(const WatcherState& state, std::size_t except) const;
  void compare_rates(WatcherState& state, std::size_t row, const SensorReading& reading,
                     const Eigen::Quaterniond& attitude, std::vector<DeviceReport>& reports) const;
  bool is_driven_wrong(const WatcherState& state) const;
  double turns_apart(const WatcherState& state) const;
  void blame(WatcherState& state, SensorKind kind, std::vector<DeviceReport>& reports) const;
  const char* own_fault(const SensorOptions& sensor, const SensorWatch& watch) const;

  std::vector<Thruster> thrusters_;
  std::vector<Fin> fins_;
  std::optional<Battery> battery_;
  double gravity_;
  std::vector<SensorOptions> sensors_;
  WatcherOptions options_;
};

}  // namespace bathyal
