// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bathyal/mission/faults.hpp"
#include "bathyal/mission/plan.hpp"
#include "bathyal/mission/watchers.hpp"
#include "bathyal/navigation/navigation_filter.hpp"

namespace bathyal {

enum class RunStatus : std::uint8_t {
  kRunning,
  kDone,     ///< the mission succeeded
  kFailed,   ///< it failed
  kAborted,  ///< a guard's response ran instead
  kTimeout,  ///< it took longer than `longest`
  kStopped,  ///< by an input
};
std::string_view status_name(RunStatus status);

/// Something that happened.
struct MissionEvent {
  double time = 0.0;  ///< [s]
  std::string kind;   ///< "start", "command", "fault", "report", "guard", "mark", "end"
  std::string text;
};

/// What comes from outside, for one tick.
struct LiveInputs {
  bool stop = false;                   ///< ends the run
  std::vector<double> wrench = {};     ///< (6,) on the vehicle besides; empty: none
  std::vector<double> thrusters = {};  ///< commands in place of the pilot's; or empty
  std::vector<double> fins = {};       ///< angles in place of the pilot's [rad]; or empty

  bool none() const { return !stop && wrench.empty() && thrusters.empty() && fins.empty(); }
};

/// A moment of a run, for its log.
struct MissionTick {
  double time = 0.0;
  std::int64_t number = 0;
  const VehicleSystemState* truth = nullptr;
  VehicleState estimated = {};
  double position_std = 0.0;  ///< horizontal [m]
  PilotTarget target = {};
  const VehicleCommands* commands = nullptr;
  BatteryLoad load = {};
  double altitude = 0.0;  ///< true [m]; NaN: no bottom
  double depth = 0.0;     ///< true [m]
};

/// Where a run's record goes. What it is given is the same for the same plan, seed and inputs.
class MissionSink {
 public:
  virtual void tick(const MissionTick& tick) = 0;
  virtual void reading(const SensorOptions& sensor, const SensorReading& reading) = 0;
  virtual void event(const MissionEvent& event) = 0;
  virtual void inputs(double time, std::int64_t number, const LiveInputs& inputs) = 0;

  MissionSink() = default;
  MissionSink(const MissionSink&) = delete;
  MissionSink& operator=(const MissionSink&) = delete;
  virtual ~MissionSink() = default;
};

struct LeafState {
  double since = 0.0;    ///< [s]
  double within = -1.0;  ///< since when it has been at its aim [s]; −1: it is not
  std::int32_t row = 0;  ///< of its points
};

/// A sensor's line to the vehicle.
struct LineState {
  SensorState sensor;
  SensorReading held = {.index = -1};    ///< the last before a fault
  SensorReading latest = {.index = -1};  ///< that has arrived
};

struct PendingReading {
  std::int32_t device = 0;
  SensorReading reading;
};

/// A reading, and of what.
struct ArrivedReading {
  std::string device;
  SensorReading reading;
};

/// Sums that a run ends with.
struct MissionSums {
  double distance = 0.0;                                            ///< of the true way [m]
  double deepest = 0.0;                                             ///< [m]
  double least_altitude = std::numeric_limits<double>::infinity();  ///< [m]
  double energy = 0.0;                                              ///< drawn [J]
  double squared_error = 0.0;  ///< of the horizontal position, summed over ticks [m²]
  double largest_error = 0.0;  ///< [m]
};

/// All that a run remembers.
/// The arm that takes samples.
struct SamplingArmState {
  double behind = 0.0;             ///< of its plan, where a joint is stuck [s]
  bool reported = false;           ///< that it does not follow
  std::array<double, 6> wrench{};  ///< on the vehicle, as it is believed
  std::int32_t samples = 0;        ///< taken and not lost
};

struct MissionState {
  std::int64_t number = 0;  ///< of the next tick
  RunStatus status = RunStatus::kRunning;
  VehicleSystemState vehicle;
  std::vector<LineState> lines;
  std::vector<PendingReading> pending;
  NavigationState navigation;
  Vec3 velocity = Vec3::Zero();  ///< the last from a log, in the vehicle [m/s]
  double velocity_time = -1.0;   ///< of it [s]
  Eigen::Vector4d attitude{0, 0, 0, 1};
  double attitude_time = 0.0;  ///< of the last that a compass has reported [s]
  Vec3 spin = Vec3::Zero();
  double spin_time = 0.0;  ///< of it [s]
  PilotState pilot;
  PilotTarget target;
  TreeState tree;
  std::int32_t guard = -1;  ///< whose response runs
  std::vector<double> guard_since;
  std::vector<LeafState> leaves;
  std::vector<FaultState> faults;
  WatcherState watchers;
  std::vector<double> signals;
  VehicleCommands commands;           ///< of the pilot
  std::vector<double> held_commands;  ///< of thrusters, then fins, as the devices got them
  BatteryLoad load;
  double altitude = 0.0;  ///< true [m]; NaN: no bottom
  double leak = 0.0;      ///< water taken in [kg]
  SamplingArmState arm;
  MissionSums sums;
};

/// One run of a mission, tick by tick: a pure function of plan, seed and inputs.
class MissionRun {
 public:
  /// \param sink outlives the run; null: no record
  /// \throw std::invalid_argument as MissionPlan::check
  MissionRun(std::shared_ptr<const MissionPlan> plan, std::uint64_t seed, MissionSink* sink);
  ~MissionRun();
  MissionRun(const MissionRun&) = delete;
  MissionRun& operator=(const MissionRun&) = delete;

  /// One tick. \return whether the run goes on
  bool step(const LiveInputs& inputs = {});

  double time() const;
  const MissionPlan& plan() const;
  const MissionState& state() const;
  VehicleState estimated() const;
  const std::vector<std::string>& signals() const;

  /// What the next tick takes in, in its order.
  std::vector<ArrivedReading> arrived() const;

  std::map<std::string, double> metrics() const;

  /// The state as bytes, and back into a run of the same plan and seed.
  std::string save() const;
  /// \throw Error for bytes that are none, or of another plan or seed
  void load(const std::string& bytes);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace bathyal
