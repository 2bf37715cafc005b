// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bathyal/mission/condition.hpp"
#include "bathyal/mission/pilot.hpp"
#include "bathyal/mission/tree.hpp"
#include "bathyal/navigation/navigation_options.hpp"
#include "bathyal/vehicle/environment.hpp"
#include "bathyal/vehicle/vehicle_system.hpp"

namespace bathyal {

/// What a leaf of a mission does.
enum class CommandKind : std::uint8_t {
  kWait,        ///< for `time`, where it is
  kDive,        ///< to a depth or altitude, where it is
  kFollow,      ///< the line through `points`, at a depth or altitude
  kHold,        ///< `points` (or where it is) for `time`
  kSample,      ///< holds while the arm's wrench acts
  kMark,        ///< pings, photos: a moment that is recorded
  kSurface,     ///< until the depth is below `tolerance`
  kDropWeight,  ///< all of them
  kCheck,       ///< succeeds where its condition holds
  kStop,        ///< fails
};

struct MissionCommand {
  CommandKind kind = CommandKind::kWait;
  std::string name = {};
  std::vector<Vec3> points = {};  ///< x, y of the world [m]; z is not used
  std::optional<double> depth = {}, altitude = {}, heading = {};  ///< [m], [m], [rad]
  double speed = 0.5;                                             ///< [m/s], above 0
  double time = 0.0;                                              ///< [s]
  double tolerance = 1.0;                                         ///< [m], above 0
  std::optional<Condition> condition = {};                        ///< of a check
  std::vector<double> wrench_time = {};  ///< of a sample, rising from 0 [s]
  std::vector<Vec6> wrench = {};  ///< at those times, on the vehicle about its origin [N, N m]
  std::vector<Vec6> empty_wrench = {};  ///< the same with an empty hand; none: as `wrench`

  /// \throw std::invalid_argument that names the field
  void check() const;
};

/// What is watched all the time: once the condition has held for `persist`, the mission stops and
/// the response runs instead.
struct MissionGuard {
  std::string name;
  Condition condition;
  double persist = 0.0;  ///< [s], 0 or more
  TreeNode response;     ///< leaves as the mission's
};

enum class FaultKind : std::uint8_t {
  // Of sensors; the first seven as MAVLink's FAILURE_TYPE.
  kOff,
  kStuck,
  kGarbage,       ///< noise of `size` in place of values
  kWrong,         ///< values times 1 + size
  kSlow,          ///< every `size`th sample alone
  kDelayed,       ///< later by `size` [s]
  kIntermittent,  ///< a part `size` of the samples is lost
  kBias,          ///< plus `size`
  kDrift,         ///< plus `size` a second
  kNoise,         ///< of `size`
  // Of thrusters and fins.
  kDead,
  kWeak,      ///< turns at (1 − size) of the command
  kReversed,  ///< turns the other way
  // Of the battery and the hull.
  kSag,   ///< inner resistance plus `size` [Ω]
  kLeak,  ///< takes in `size` [kg/s] of water
  // Of the arm that takes samples; it may be stuck, too: a joint.
  kLost,  ///< what it holds falls
};

/// What breaks, and when: at a time, once a condition holds, or at a rate.
struct MissionFault {
  std::string device;  ///< name of a sensor, thruster or fin; "battery", "hull", "arm"
  FaultKind kind = FaultKind::kOff;
  double size = 0.0;
  double at = std::numeric_limits<double>::infinity();  ///< [s]
  std::optional<Condition> when = {};
  double rate = 0.0;                                       ///< a mean number an hour
  double lasts = std::numeric_limits<double>::infinity();  ///< [s], above 0
};

/// A whole mission: everything but the seed that its outcome depends on.
struct MissionPlan {
  std::string name = "mission";
  VehicleSystemOptions vehicle;
  PilotOptions pilot = {};
  std::vector<SensorOptions> sensors = {};
  NavigationOptions navigation = {};  ///< its devices are the sensors
  Water water = {};
  std::optional<Scene> scene = {};               ///< bottom and objects, at rest
  ContactOptions contact = {.frequency = 20.0};  ///< soft enough for the step
  VehicleState start = {};
  std::vector<MissionCommand> commands = {};  ///< leaves, by number
  TreeNode root = {};
  std::vector<MissionGuard> guards = {};
  std::vector<MissionFault> faults = {};
  double step = 0.02;                 ///< of the motion [s]
  int steps_per_tick = 5;             ///< of the devices and the mission, 1 or more
  double longest = 4.0 * 3600.0;      ///< the run ends then [s]
  Vec3 leak_position = Vec3::Zero();  ///< where water that comes in collects [m]
  double weight_of_leak = 9.81;       ///< of a kilogram of it [N]

  double tick() const { return step * steps_per_tick; }

  /// \throw std::invalid_argument that names what is wrong, or a device that is not known
  void check() const;
};

/// Names of a mission's signals, in their order: what conditions may use. `fault.NAME` is of each
/// sensor, thruster, fin, the battery, the hull and the arm: 1 once a watcher reports it.
std::vector<std::string> mission_signals(const VehicleSystemOptions& vehicle,
                                         const std::vector<SensorOptions>& sensors);

/// Units of these signals, as Condition takes them.
std::vector<std::string> mission_units(const std::vector<std::string>& signals);

/// The first signals, in the order of mission_signals.
enum class Signal : std::uint8_t {
  kTime,         ///< [s]
  kDepth,        ///< [m]
  kAltitude,     ///< [m]
  kX,            ///< estimated [m]
  kY,            ///< [m]
  kZ,            ///< [m]
  kHeading,      ///< counter-clockwise from the world's x [rad]
  kRoll,         ///< [rad]
  kPitch,        ///< [rad], bow down
  kSpeed,        ///< over ground [m/s]
  kBattery,      ///< charge left, 0 to 1
  kVoltage,      ///< [V]
  kCurrent,      ///< drawn [A]
  kLeak,         ///< water in the hull [kg]
  kPositionStd,  ///< horizontal, of the navigation filter [m]
  kDvlAge,       ///< since the last valid velocity [s]
  kFault,        ///< how many devices are reported
  kCount
};

}  // namespace bathyal
