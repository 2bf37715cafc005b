// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bathyal/control/allocation.hpp"
#include "bathyal/control/cruise.hpp"
#include "bathyal/control/guidance.hpp"
#include "bathyal/control/pose_hold.hpp"
#include "bathyal/vehicle/vehicle_system.hpp"

namespace bathyal {

struct PilotOptions {
  /// A propeller, a rudder and a stern plane; unset: thrusters all round.
  std::optional<CruiseOptions> cruise = {};
  PoseHoldOptions hold = {};
  AllocationOptions allocation = {};
  double lookahead = 8.0;     ///< of the line of sight [m], above 0
  double los_integral = 0.3;  ///< [m/s], 0 or more
  double climb_speed = 0.3;   ///< of depth changes [m/s], above 0
  double turn_speed = 0.5;    ///< of heading changes on the spot [rad/s], above 0
  double most_ahead = 1.0;    ///< of the point followed before the vehicle [m], above 0

  /// \throw std::invalid_argument that names the field
  void check() const;
};

/// Where to go: along a line of the world at a height, then to stay at its end.
struct PilotTarget {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double z = 0.0;                      ///< of the vehicle's origin [m]
  double climb = 0.0;                  ///< of the path at z, height over way; of a cruise
  std::optional<double> heading = {};  ///< [rad]; unset: along the line
  double speed = 0.5;                  ///< [m/s]
  bool moves = false;                  ///< along the line; else at `to`
};

struct PilotState {
  PoseHoldState hold = {};
  CruiseState cruise = {};
  double along = 0.0;    ///< of the point followed, on the line [m]
  double z = 0.0;        ///< that is asked for now
  double heading = 0.0;  ///< likewise
  double drift = 0.0;    ///< integral of the line of sight [m]
  bool begun = false;
};

/// From where to go to the devices' commands.
class Pilot {
 public:
  /// \throw std::invalid_argument for options that do not fit the vehicle's devices
  Pilot(const VehicleSystem& system, PilotOptions options);

  /// A new line: its own progress, with what the controllers have learnt.
  void begin(PilotState& state, const VehicleState& estimated) const;

  /// \param estimated of the navigation \param current of the water, as estimated [m/s]
  /// \param failed rows of thrusters that are not used
  /// \param extra wrench that is known to act, to be met [N, N m]
  void step(PilotState& state, const VehicleState& estimated, const PilotTarget& target,
            const Vec3& current, double voltage, const std::vector<int>& failed, const Vec6& extra,
            double time, VehicleCommands& commands) const;

  /// The wrench that the commands of the last step are to give; of thrusters all round.
  const PilotOptions& options() const { return options_; }
  bool cruises() const { return options_.cruise.has_value(); }

  /// Directions that the thrusters cannot give without those that failed.
  std::vector<int> lost_axes(const std::vector<int>& failed) const;

 private:
  void step_hold(PilotState& state, const VehicleState& estimated, const PilotTarget& target,
                 const Vec3& current, double voltage, const std::vector<int>& failed,
                 const Vec6& extra, double time, VehicleCommands& commands) const;
  void step_cruise(PilotState& state, const VehicleState& estimated, const PilotTarget& target,
                   const Vec3& current, double voltage, double time,
                   VehicleCommands& commands) const;

  PilotOptions options_;
  std::vector<Thruster> thrusters_;
  std::optional<Allocation> allocation_;
  std::optional<PoseHold> hold_;
  std::optional<CruiseControl> cruise_;
};

}  // namespace bathyal
