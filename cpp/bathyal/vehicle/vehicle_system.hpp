// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bathyal/vehicle/devices/battery.hpp"
#include "bathyal/vehicle/devices/drop_weight.hpp"
#include "bathyal/vehicle/devices/fin.hpp"
#include "bathyal/vehicle/devices/tether.hpp"
#include "bathyal/vehicle/devices/thruster.hpp"
#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

namespace vehicle_system {
struct ThrusterCourse;
}

/// A vehicle with what moves it.
struct VehicleSystemOptions {
  VehicleOptions vehicle;
  std::vector<ThrusterOptions> thrusters = {};
  std::vector<FinOptions> fins = {};
  std::optional<BatteryOptions> battery = {};  ///< none: `supply_voltage`, whatever is drawn
  double supply_voltage = 16.0;                ///< [V], above 0
  double hotel_power = 0.0;                    ///< drawn by all that is no thruster [W], 0 or more
  std::vector<DropWeightOptions> drop_weights = {};
  std::optional<TetherOptions> tether = {};

  /// \throw std::invalid_argument that names the field, and the device's
  void check() const;
};

/// All that changes in time: numbers only.
struct VehicleSystemState {
  VehicleState motion = {};
  std::vector<ThrusterState> thrusters = {};
  std::vector<FinState> fins = {};
  BatteryState battery = {};
  std::vector<DropWeightState> drop_weights = {};
};

/// What the devices are asked for, held for a step.
struct VehicleCommands {
  std::vector<double> thrusters = {};  ///< −1 to 1
  std::vector<double> fins = {};       ///< [rad]
  std::vector<int> drop = {};          ///< 1 lets go; empty: none
};

/// What surrounds a vehicle at a moment of a step.
struct StepConditions {
  Flow flow = {};
  Vec6 wrench = Vec6::Zero();  ///< on the vehicle besides its devices', about its origin
};
/// \param time since the start of the step [s]
using StepConditionsFunction =
    std::function<StepConditions(double time, const VehicleState& state)>;

/// Vehicle, thrusters, fins and battery advanced together. In a step the battery and its loads are
/// solved for one voltage at its start, the devices' states follow their own laws exactly, and the
/// motion is integrated by Runge–Kutta's method of fourth order, with thrust and lift of each
/// stage from that stage's velocity. Nothing is allocated in a step.
class VehicleSystem {
 public:
  /// \throw std::invalid_argument as VehicleSystemOptions::check
  explicit VehicleSystem(VehicleSystemOptions options);

  const VehicleSystemOptions& options() const { return options_; }
  const Vehicle& vehicle() const { return vehicle_; }
  const std::vector<Thruster>& thrusters() const { return thrusters_; }
  const std::vector<Fin>& fins() const { return fins_; }

  /// At rest at the origin, the battery full.
  VehicleSystemState rest() const;

  /// The supply's voltage and current under commands: what is drawn at that voltage.
  BatteryLoad supply(const VehicleSystemState& state, const VehicleCommands& commands) const;

  /// Changes `state` by a step of `time`, in water that moves everywhere alike.
  /// \throw std::invalid_argument for commands of another number than the devices, or not finite
  /// \throw Error where the motion is no longer finite
  void step(VehicleSystemState& state, const VehicleCommands& commands, const Flow& flow,
            double time) const;

  /// The same, asking for flow and wrench at each of the four stages.
  void step(VehicleSystemState& state, const VehicleCommands& commands,
            const StepConditionsFunction& conditions, double time) const;

  /// Force and moment of all devices at a state, about the vehicle's origin, in its frame.
  Vec6 device_wrench(const VehicleSystemState& state, const VehicleCommands& commands,
                     const Flow& flow) const;

 private:
  void check_commands(const VehicleSystemState& state, const VehicleCommands& commands) const;
  void advance(VehicleSystemState& state, const VehicleCommands& commands,
               const StepConditionsFunction& around, double time) const;
  vehicle_system::ThrusterCourse thruster_course(const VehicleSystemState& state,
                                                 const VehicleCommands& commands, double voltage,
                                                 double time) const;
  Vec6 carried(const VehicleSystemState& state, const VehicleState& motion, const Flow& flow) const;

  VehicleSystemOptions options_;
  Vehicle vehicle_;
  std::vector<Thruster> thrusters_;
  std::vector<Fin> fins_;
  std::optional<Battery> battery_;
  bool tables_ = false;  // a thruster has one
};

}  // namespace bathyal
