// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/internal/saved_run.hpp"

#include <algorithm>

#include "bathyal/log/crc32.hpp"
#include "bathyal/mission/archive.hpp"
#include "bathyal/navigation/navigation_state_bytes.hpp"

namespace bathyal {

template <class A>
void archive(A& a, VehicleState& s) {
  a(s.world_from_vehicle, s.velocity);
}
template <class A>
void archive(A& a, ThrusterState& s) {
  a(s.speed);
}
template <class A>
void archive(A& a, FinState& s) {
  a(s.angle);
}
template <class A>
void archive(A& a, DropWeightState& s) {
  a(s.released);
}
template <class A>
void archive(A& a, BatteryState& s) {
  a(s.charge);
}
template <class A>
void archive(A& a, VehicleSystemState& s) {
  a(s.motion, s.thrusters, s.fins, s.battery, s.drop_weights);
}
template <class A>
void archive(A& a, SensorReading& s) {
  a(s.kind, s.time, s.arrival, s.index, s.values, s.count, s.valid);
}
template <class A>
void archive(A& a, SensorState& s) {
  a(s.index, s.time, s.walk, s.markov);
}
template <class A>
void archive(A& a, LineState& s) {
  a(s.sensor, s.held, s.latest);
}
template <class A>
void archive(A& a, PendingReading& s) {
  a(s.device, s.reading);
}
template <class A>
void archive(A& a, PoseHoldState& s) {
  a(s.integral, s.shortfall);
}
template <class A>
void archive(A& a, CruiseState& s) {
  a(s.heading, s.depth, s.speed);
}
template <class A>
void archive(A& a, PilotState& s) {
  a(s.hold, s.cruise, s.along, s.z, s.heading, s.drift, s.begun);
}
template <class A>
void archive(A& a, std::optional<double>& value) {
  bool there = value.has_value();
  double number = value.value_or(0.0);
  a(there, number);
  value = there ? std::optional<double>(number) : std::nullopt;
}
template <class A>
void archive(A& a, PilotTarget& s) {
  a(s.from, s.to, s.z, s.climb, s.heading, s.speed, s.moves);
}
template <class A>
void archive(A& a, TreeState& s) {
  a(s.status, s.current, s.failures, s.since);
}
template <class A>
void archive(A& a, LeafState& s) {
  a(s.since, s.within, s.row);
}
template <class A>
void archive(A& a, FaultState& s) {
  a(s.active, s.since, s.over);
}
template <class A>
void archive(A& a, DeviceWatch& s) {
  a(s.since, s.reported, s.expected);
}
template <class A>
void archive(A& a, SensorWatch& s) {
  a(s.seen, s.index, s.repeats, s.lost, s.late, s.refused, s.mean, s.reported);
}
template <class A>
void archive(A& a, RateWatch& s) {
  a(s.time, s.value, s.since, s.mean);
}
template <class A>
void archive(A& a, WatcherState& s) {
  a(s.sensors, s.thrusters, s.fins, s.battery, s.hull, s.depth_rise, s.log_rise, s.altimeter_rise,
    s.compass_turn, s.gyro_turn, s.roll, s.pitch, s.force, s.level_x, s.level_y, s.turn_since);
}
template <class A>
void archive(A& a, VehicleCommands& s) {
  a(s.thrusters, s.fins, s.drop);
}
template <class A>
void archive(A& a, BatteryLoad& s) {
  a(s.voltage, s.current, s.collapsed);
}
template <class A>
void archive(A& a, SamplingArmState& s) {
  a(s.behind, s.reported, s.wrench, s.samples);
}
template <class A>
void archive(A& a, MissionSums& s) {
  a(s.distance, s.deepest, s.least_altitude, s.energy, s.squared_error, s.largest_error);
}

namespace {

constexpr std::uint64_t kMagic = 0x3152594854414221U;  // "!BATHYR1"

template <class A>
void archive_state(A& a, MissionState& s, std::string& navigation) {
  a(s.number, s.status, s.vehicle, s.lines, s.pending, navigation, s.velocity, s.velocity_time,
    s.attitude, s.attitude_time, s.spin, s.spin_time, s.pilot, s.target, s.tree, s.guard,
    s.guard_since, s.leaves, s.faults, s.watchers, s.signals, s.commands, s.held_commands, s.load,
    s.altitude, s.leak, s.arm, s.sums);
}

}  // namespace

std::string saved_run(const MissionState& state, const std::string& fingerprint,
                      std::uint64_t seed) {
  MissionState copy = state;
  std::uint64_t magic = kMagic;
  std::string of = fingerprint, navigation = to_bytes(state.navigation);
  ByteWriter writer;
  writer(magic, of, seed);
  archive_state(writer, copy, navigation);
  std::string bytes = writer.take();
  std::uint32_t sum = crc32(bytes);
  ByteWriter end;
  end(sum);
  return bytes.append(end.take());
}

MissionState loaded_run(const std::string& bytes, const MissionState& like,
                        const std::string& fingerprint, std::uint64_t seed) {
  std::uint32_t sum = 0;
  if (bytes.size() < sizeof sum) throw Error("a saved run ends too early");
  const std::string_view content(bytes.data(), bytes.size() - sizeof sum);
  ByteReader(std::string_view(bytes).substr(content.size()))(sum);
  ByteReader reader(content);
  std::uint64_t magic = 0, of_seed = 0;
  std::string of, navigation;
  reader(magic);
  if (magic != kMagic) throw Error("expected a saved run, got other bytes");
  if (sum != crc32(content)) throw Error("a saved run that was cut or changed");
  reader(of, of_seed);
  if (of != fingerprint) throw Error("a saved run of another mission");
  if (of_seed != seed) {
    throw Error("a saved run of seed " + std::to_string(of_seed) + ", not " + std::to_string(seed));
  }
  MissionState state;
  archive_state(reader, state, navigation);
  const bool same =
      reader.left() == 0 && state.lines.size() == like.lines.size() &&
      state.leaves.size() == like.leaves.size() && state.faults.size() == like.faults.size() &&
      state.signals.size() == like.signals.size() &&
      state.vehicle.thrusters.size() == like.vehicle.thrusters.size() &&
      state.held_commands.size() == like.held_commands.size() &&
      state.guard_since.size() == like.guard_since.size() &&
      state.watchers.sensors.size() == like.watchers.sensors.size() && state.guard >= -1 &&
      state.guard < static_cast<std::int64_t>(like.guard_since.size()) &&
      std::all_of(state.pending.begin(), state.pending.end(),
                  [&like](const PendingReading& reading) {
                    return reading.device >= 0 &&
                           reading.device < static_cast<std::int64_t>(like.lines.size());
                  });
  if (!same) throw Error("a saved run that does not fit its mission");
  state.navigation = navigation_state_of(navigation);
  return state;
}

}  // namespace bathyal
