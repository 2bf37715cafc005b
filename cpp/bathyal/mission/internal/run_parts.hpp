// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/mission/run.hpp"

namespace bathyal {

/// Puts first what has arrived by then, in the order in which it is taken in. \return how many
std::size_t sort_arrived(std::vector<PendingReading>& pending, double time);

/// What a run is made of; its tick is in this order: faults, sensors, navigation, watchers,
/// signals, guards and tree, pilot, motion.
struct MissionRun::Parts final : TreeLeaves {
  Parts(std::shared_ptr<const MissionPlan> given, std::uint64_t seed, MissionSink* sink);

  std::shared_ptr<const MissionPlan> plan;
  std::uint64_t seed;
  MissionSink* sink;
  std::optional<VehicleSystem> system;
  double resistance = 0.0;  ///< that `system` has besides the plan's [Ω]
  Pilot pilot;
  NavigationFilter filter;
  Environment environment;
  Environment known;  ///< of it what software on board knows: no bottom, no current
  BehaviorTree tree;
  std::vector<BehaviorTree> responses;
  std::vector<std::string> names;  ///< of the signals
  Watchers watchers;
  std::vector<int> fault_device;  ///< of each fault: row of its sensor, thruster or fin
  MissionState state;

  // What a tick works on, kept so that nothing is allocated.
  VehicleCommands driven;
  std::vector<DeviceReport> reports;
  std::vector<int> changed, failed;
  Vec6 extra = Vec6::Zero();    ///< of a sample, known to the pilot
  Vec6 unknown = Vec6::Zero();  ///< what it truly is besides

  double time() const { return static_cast<double>(state.number) * plan->tick(); }
  VehicleState estimated() const;
  std::string fingerprint() const;  ///< of the plan's parts that a saved state depends on
  void renew_system();

  bool step(const LiveInputs& inputs);

  // TreeLeaves
  void start(int leaf) override;
  NodeStatus update(int leaf) override;
  void stop(int leaf) override;

 private:
  void emit(const char* kind, std::string text);
  void update_faults_now();
  void sense(double at, const Vec6& acceleration);
  void deliver();
  void take(const PendingReading& pending);
  bool is_trusted(int device) const;
  void turn_by_gyro(const Vec3& spin, double measured);
  void reckon(double measured);
  void reckon_by_model();
  void find_failed();
  void watch();
  void update_signals();
  void decide();
  void steer(const LiveInputs& inputs);
  void move(const LiveInputs& inputs);
  void account(double before_x, double before_y, double before_z);
  void record();
  double altitude_at(const Vec3& point) const;
  SensorTruth truth(double at, const Vec6& acceleration) const;
  void aim_at_height(const MissionCommand& command);
  std::optional<BottomFollowOutput> path_ahead(double altitude, const Vec3& place,
                                               double bottom) const;
  NodeStatus follow(const MissionCommand& command, LeafState& leaf);
  NodeStatus reach_height(const MissionCommand& command, LeafState& leaf);
  bool has_fault(std::string_view device, FaultKind kind) const;
  NodeStatus take_sample(const MissionCommand& command, LeafState& leaf);
  NodeStatus stay(const MissionCommand& command, LeafState& leaf);
  void aim_at_points(const MissionCommand& command, const LeafState& leaf);
  bool held_for(LeafState& leaf, bool within, double seconds) const;
};

}  // namespace bathyal
