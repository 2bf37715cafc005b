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
  int repeats = 15;            ///< equal readings in a row: it is stuck
  double refused = 0.5;        ///< share of readings that the filter refuses, or that jump
  double acceleration = 2.0;   ///< most that a velocity log can mean [m/s²]
  double mean = 0.3;           ///< of the normalised innovations of some 200 readings
  double speed_share = 0.2;    ///< of a propeller's expected speed
  double speed_least = 3.0;    ///< [1/s]
  double angle_least = 0.05;   ///< of a fin [rad]
  double voltage_least = 0.4;  ///< below the expected [V]
  double persist = 1.0;        ///< [s]
  double leak_least = 0.05;    ///< [kg]
};

/// A device that is reported once.
struct DeviceWatch {
  double since = -1.0;  ///< of what is not right [s]; −1: all is right
  double seen = 0.0;    ///< its last sign of life [s]
  std::int32_t repeats = 0;
  double refused = 0.0;          ///< share, of the last ten or so
  std::array<double, 3> mean{};  ///< of normalised innovations, of the last 200 or so
  bool reported = false;
  double expected = 0.0;  ///< speed or angle
};

struct WatcherState {
  std::vector<DeviceWatch> sensors, thrusters, fins;
  DeviceWatch battery, hull;
};

struct DeviceReport {
  std::string device, kind;
};

/// Looks at what is known on board, and names the device that it cannot explain: sensors by
/// silence, by equal readings and by the filter's innovations; propellers and fins by what they
/// turn against what their commands ask for; the battery by its voltage; the hull by its leak
/// sensor.
class Watchers {
 public:
  Watchers(const VehicleSystem& system, std::vector<SensorOptions> sensors,
           WatcherOptions options = {});

  WatcherState fresh() const;

  void reading(WatcherState& state, int device, const SensorReading& before,
               const SensorReading& reading, const NavigationUpdate* update,
               std::vector<DeviceReport>& reports) const;

  /// \param speeds, angles as the devices report them \param commands as the devices were asked
  void tick(WatcherState& state, double time, double step, const VehicleCommands& commands,
            const std::vector<double>& speeds, const std::vector<double>& angles, double voltage,
            double current, double charge, std::vector<DeviceReport>& reports) const;

 private:
  std::vector<Thruster> thrusters_;
  std::vector<Fin> fins_;
  std::optional<Battery> battery_;
  std::vector<SensorOptions> sensors_;
  WatcherOptions options_;
};

}  // namespace bathyal
