// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/internal/run_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/navigation/dead_reckoning.hpp"

namespace bathyal {
namespace {

constexpr double kChartSteepest = 0.15;  ///< of the path over the bottom ahead, height over way
constexpr double kArmBehind = 1.0;       ///< that an arm is behind its plan, to be reported [s]
constexpr double kSilence = 0.5;    // of a velocity log or compass, before it is done without [s]
constexpr double kModelWalk = 0.5;  // of the position, reckoned by the vehicle's model [m/√s]
constexpr double kTelemetryNoise = 0.005;  // share of a propeller's speed as its motor reports it

NavigationOptions with_devices(const MissionPlan& plan) {
  NavigationOptions options = plan.navigation;
  options.devices = plan.sensors;
  return options;
}

std::vector<BehaviorTree> responses_of(const MissionPlan& plan) {
  std::vector<BehaviorTree> trees;
  for (const MissionGuard& guard : plan.guards) trees.emplace_back(guard.response);
  return trees;
}

/// Row of the device that a fault is of, among its kind; −1 for battery and hull.
int device_row(const MissionPlan& plan, const std::string& name) {
  const auto row_in = [&name](const auto& devices) {
    for (std::size_t i = 0; i < devices.size(); ++i) {
      if (devices[i].name == name) return static_cast<int>(i);
    }
    return -1;
  };
  for (const int row :
       {row_in(plan.sensors), row_in(plan.vehicle.thrusters), row_in(plan.vehicle.fins)}) {
    if (row >= 0) return row;
  }
  return -1;
}

bool is_sensor(const MissionPlan& plan, const std::string& name) {
  return std::any_of(plan.sensors.begin(), plan.sensors.end(),
                     [&name](const SensorOptions& s) { return s.name == name; });
}

bool is_thruster(const MissionPlan& plan, const std::string& name) {
  return std::any_of(plan.vehicle.thrusters.begin(), plan.vehicle.thrusters.end(),
                     [&name](const ThrusterOptions& t) { return t.name == name; });
}

Vec6 interpolated(const std::vector<double>& times, const std::vector<Vec6>& rows, double time) {
  if (times.empty() || time < times.front() || time > times.back()) return Vec6::Zero();
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.end()) return rows.back();
  const auto k = static_cast<std::size_t>(after - times.begin());
  const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return (1.0 - share) * rows[k - 1] + share * rows[k];
}

}  // namespace

MissionRun::Parts::Parts(std::shared_ptr<const MissionPlan> given, std::uint64_t given_seed,
                         MissionSink* given_sink)
    : plan(std::move(given)),
      seed(given_seed),
      sink(given_sink),
      system(plan->vehicle),
      pilot(*system, plan->pilot),
      filter(with_devices(*plan)),
      environment(plan->water, plan->scene, plan->contact),
      known(Water({.surface = plan->water.surface()}), std::nullopt, plan->contact),
      tree(plan->root),
      responses(responses_of(*plan)),
      names(mission_signals(plan->vehicle, plan->sensors)),
      watchers(*system, plan->sensors) {
  for (const MissionFault& fault : plan->faults) {
    fault_device.push_back(device_row(*plan, fault.device));
  }
  state.vehicle = system->rest();
  state.vehicle.motion = plan->start;
  state.lines.resize(plan->sensors.size());
  state.navigation =
      filter.start(0.0, plan->start.world_from_vehicle,
                   plan->start.world_from_vehicle.linear() * plan->start.velocity.head<3>());
  state.velocity = plan->start.velocity.head<3>();
  state.attitude = Eigen::Quaterniond(plan->start.world_from_vehicle.linear()).coeffs();
  state.target.to = state.target.from = plan->start.world_from_vehicle.translation().head<2>();
  state.target.z = plan->start.world_from_vehicle.translation().z();
  state.tree = tree.fresh();
  state.guard_since.assign(plan->guards.size(), -1.0);
  state.leaves.resize(plan->commands.size());
  state.faults.resize(plan->faults.size());
  state.watchers = watchers.fresh();
  state.signals.assign(names.size(), std::numeric_limits<double>::quiet_NaN());
  state.held_commands.assign(plan->vehicle.thrusters.size() + plan->vehicle.fins.size(), 0.0);
  state.commands.thrusters.assign(plan->vehicle.thrusters.size(), 0.0);
  state.commands.fins.assign(plan->vehicle.fins.size(), 0.0);
  state.commands.drop.assign(plan->vehicle.drop_weights.size(), 0);
  state.load = system->supply(state.vehicle, state.commands);
  state.altitude = altitude_at(plan->start.world_from_vehicle.translation());
  sense(0.0, Vec6::Zero());
}

void MissionRun::Parts::emit(const char* kind, std::string text) {
  if (sink != nullptr) sink->event({time(), kind, std::move(text)});
}

VehicleState MissionRun::Parts::estimated() const {
  VehicleState found;
  const NavigationEstimate& now = state.navigation.now;
  const double since = std::max(0.0, time() - now.time);
  found.world_from_vehicle.linear() = Eigen::Quaterniond(state.attitude).toRotationMatrix();
  found.world_from_vehicle.translation() =
      now.position + since * (found.world_from_vehicle.linear() * state.velocity);
  found.velocity << state.velocity, state.spin;
  return found;
}

double MissionRun::Parts::altitude_at(const Vec3& point) const {
  if (!plan->scene) return std::numeric_limits<double>::quiet_NaN();
  const RayHit hit = plan->scene->cast(point, -Vec3::UnitZ());
  return hit.mesh < 0 ? std::numeric_limits<double>::quiet_NaN() : hit.range;
}

void MissionRun::Parts::renew_system() {
  double more = 0.0;
  for (std::size_t i = 0; i < plan->faults.size(); ++i) {
    const bool sags = plan->faults[i].kind == FaultKind::kSag && state.faults[i].active;
    more += sags ? plan->faults[i].size : 0.0;
  }
  if (more == resistance) return;
  resistance = more;
  VehicleSystemOptions options = plan->vehicle;
  if (options.battery) options.battery->resistance += more;
  system.emplace(std::move(options));
}

void MissionRun::Parts::update_faults_now() {
  update_faults(plan->faults, state.faults, time(), plan->tick(), state.number, state.signals, seed,
                changed);
  for (const int row : changed) {
    const MissionFault& fault = plan->faults[static_cast<std::size_t>(row)];
    const bool begins = state.faults[static_cast<std::size_t>(row)].active;
    emit("fault",
         fault.device + " " + std::string(fault_name(fault.kind)) + (begins ? " begins" : " ends"));
  }
  if (!changed.empty()) renew_system();
}

SensorTruth MissionRun::Parts::truth(double at, const Vec6& acceleration) const {
  const VehicleState& motion = state.vehicle.motion;
  const Vec3 place = motion.world_from_vehicle.translation();
  SensorTruth found;
  found.time = at;
  found.world_from_vehicle = motion.world_from_vehicle;
  found.velocity = motion.velocity;
  found.acceleration = acceleration;
  found.water_velocity = environment.flow(place, at).velocity;
  found.altitude = state.altitude;
  const auto surface = plan->water.surface();
  found.mean_surface = surface.value_or(0.0);
  found.surface = surface ? plan->water.surface_height(place.x(), place.y(), at)
                          : std::numeric_limits<double>::infinity();
  found.gravity = plan->vehicle.vehicle.gravity;
  found.leak = state.leak;
  return found;
}

void MissionRun::Parts::sense(double at, const Vec6& acceleration) {
  constexpr double kSlack = 1e-9;
  std::optional<SensorTruth> here;
  for (std::size_t i = 0; i < plan->sensors.size(); ++i) {
    LineState& line = state.lines[i];
    while (next_time(plan->sensors[i], line.sensor) <= at + kSlack) {
      if (!here) {
        state.altitude = altitude_at(state.vehicle.motion.world_from_vehicle.translation());
        here = truth(at, acceleration);
      }
      // sampled at the end of the step in which it is due, and stamped so
      here->time = std::max(at, next_time(plan->sensors[i], line.sensor));
      auto reading = sample(plan->sensors[i], line.sensor, *here, seed);
      if (!reading) continue;
      bool comes = true;
      for (std::size_t k = 0; k < plan->faults.size(); ++k) {
        const MissionFault& fault = plan->faults[k];
        const bool acts = state.faults[k].active && fault_device[k] == static_cast<int>(i) &&
                          is_sensor(*plan, fault.device);
        if (acts && comes) {
          comes = apply_sensor_fault(fault, state.faults[k], seed, line.held, *reading);
        }
      }
      line.held = *reading;
      if (comes) state.pending.push_back({static_cast<std::int32_t>(i), *reading});
    }
  }
}

std::size_t sort_arrived(std::vector<PendingReading>& pending, double time) {
  const double now = time + 1e-9;
  const auto due =
      std::stable_partition(pending.begin(), pending.end(),
                            [now](const PendingReading& p) { return p.reading.arrival <= now; });
  std::stable_sort(pending.begin(), due, [](const auto& a, const auto& b) {
    const auto later = [](SensorKind kind) {  // what says how it moves comes first
      return kind == SensorKind::imu || kind == SensorKind::compass ? 0
             : kind == SensorKind::dvl                              ? 1
                                                                    : 2;
    };
    return std::pair(a.reading.arrival, later(a.reading.kind)) <
           std::pair(b.reading.arrival, later(b.reading.kind));
  });
  return static_cast<std::size_t>(due - pending.begin());
}

void MissionRun::Parts::deliver() {
  const auto count = static_cast<std::ptrdiff_t>(sort_arrived(state.pending, time()));
  for (std::ptrdiff_t i = 0; i < count; ++i) take(state.pending[static_cast<std::size_t>(i)]);
  state.pending.erase(state.pending.begin(), state.pending.begin() + count);
}

void MissionRun::Parts::take(const PendingReading& pending) {
  const SensorOptions& sensor = plan->sensors[static_cast<std::size_t>(pending.device)];
  const SensorReading& reading = pending.reading;
  LineState& line = state.lines[static_cast<std::size_t>(pending.device)];
  if (sink != nullptr) sink->reading(sensor, reading);
  const Eigen::Matrix3d mount = sensor.vehicle_from_sensor.linear();
  NavigationUpdate update;
  bool updated = false;
  if (reading.valid && is_trusted(pending.device)) {
    const Vec3 first(reading.values[0], reading.values[1], reading.values[2]);
    switch (reading.kind) {
      case SensorKind::imu:
        turn_by_gyro(mount * first, reading.time);
        break;
      case SensorKind::compass: {
        const Eigen::Quaterniond turn(rotation_of_angles(first));
        state.attitude = turn.coeffs();
        state.attitude_time = reading.time;
        break;
      }
      case SensorKind::dvl: {
        const Vec3 arm = sensor.vehicle_from_sensor.translation();
        state.velocity = mount * first - state.spin.cross(arm);
        state.velocity_time = reading.time;
        reckon(reading.time);
        break;
      }
      case SensorKind::altimeter:
      case SensorKind::leak:
      case SensorKind::current:
      case SensorKind::rpm:
      case SensorKind::modem:
        break;
      default:
        update = filter.update(state.navigation, pending.device, reading);
        updated = true;
    }
  }
  watchers.reading(state.watchers, pending.device, line.latest, reading,
                   Eigen::Quaterniond(state.attitude), updated ? &update : nullptr, reports);
  line.latest = reading;
}

/// Not of a sensor that repeats itself; nor of one that jumps, where nothing else would stop it.
bool MissionRun::Parts::is_trusted(int device) const {
  const SensorWatch& watch = state.watchers.sensors[static_cast<std::size_t>(device)];
  const SensorKind kind = plan->sensors[static_cast<std::size_t>(device)].kind;
  const bool ungated = kind == SensorKind::dvl || kind == SensorKind::compass;
  return watch.repeats < watchers.options().repeats &&
         !(ungated && watch.refused > watchers.options().refused);
}

/// Keeps the attitude while the compass is silent.
void MissionRun::Parts::turn_by_gyro(const Vec3& spin, double measured) {
  state.spin = spin;
  const double since = std::max(state.spin_time, state.attitude_time);
  state.spin_time = measured;
  if (measured <= state.attitude_time + kSilence || measured <= since) return;
  const Vec3 turn = (measured - since) * spin;
  const double angle = turn.norm();
  if (angle == 0.0) return;
  const Eigen::Quaterniond by(Eigen::AngleAxisd(angle, turn / angle));
  state.attitude = (Eigen::Quaterniond(state.attitude) * by).normalized().coeffs();
}

/// Where the log is silent, by the vehicle's model from the last velocity on, in water at rest.
void MissionRun::Parts::reckon_by_model() {
  VehicleSystemState model = state.vehicle;
  model.motion = estimated();
  const auto around = [&](double, const VehicleState& motion) {
    StepConditions found;
    found.wrench = extra + known.wrench(system->vehicle(), motion, found.flow, time());
    return found;
  };
  for (int i = 0; i < plan->steps_per_tick; ++i) {
    system->step(model, state.commands, around, plan->step);
  }
  state.velocity = model.motion.velocity.head<3>();
  const NavigationEstimate& now = state.navigation.now;
  if (time() <= now.time && now.input != 0) return;
  filter.predict_motion(state.navigation, time(), Eigen::Quaterniond(state.attitude),
                        state.velocity, nullptr, kModelWalk);
}

/// By a velocity of the log.
void MissionRun::Parts::reckon(double measured) {
  const NavigationEstimate& now = state.navigation.now;
  const double at = measured > now.time || now.input == 0 ? measured : time();
  if (at <= now.time && now.input != 0) return;
  filter.predict_motion(state.navigation, at, Eigen::Quaterniond(state.attitude), state.velocity);
}

void MissionRun::Parts::find_failed() {
  failed.clear();
  for (std::size_t i = 0; i < state.watchers.thrusters.size(); ++i) {
    if (state.watchers.thrusters[i].reported) failed.push_back(static_cast<int>(i));
  }
}

void MissionRun::Parts::watch() {
  std::vector<double> speeds, angles;
  for (std::size_t i = 0; i < state.vehicle.thrusters.size(); ++i) {
    RandomStream draw = keyed_stream(seed, plan->vehicle.thrusters[i].name, 0,
                                     static_cast<std::uint64_t>(state.number));
    const double speed = state.vehicle.thrusters[i].speed;
    speeds.push_back(speed * (1.0 + kTelemetryNoise * draw.normal()));
  }
  for (const FinState& fin : state.vehicle.fins) angles.push_back(fin.angle);
  find_failed();
  const std::size_t before = failed.size();
  watchers.tick(state.watchers, time(), plan->tick(), state.commands, speeds, angles,
                state.load.voltage, state.load.current, state.vehicle.battery.charge, reports);
  find_failed();
  for (const DeviceReport& report : reports) emit("report", report.device + " " + report.kind);
  if (failed.size() > before) {
    for (const int axis : pilot.lost_axes(failed)) {
      std::string text("no more ");
      emit("report", text.append(kAxisNames[static_cast<std::size_t>(axis)]));
    }
  }
  reports.clear();
}

void MissionRun::Parts::update_signals() {
  const auto set = [this](Signal signal, double value) {
    state.signals[static_cast<std::size_t>(signal)] = value;
  };
  const NavigationEstimate& now = state.navigation.now;
  const Pose here = estimated().world_from_vehicle;
  const Vec3 place = here.translation();
  const Eigen::Matrix3d turn = here.linear();
  set(Signal::kTime, time());
  set(Signal::kDepth, plan->water.surface().value_or(0.0) - place.z());
  set(Signal::kX, place.x());
  set(Signal::kY, place.y());
  set(Signal::kZ, place.z());
  set(Signal::kHeading, std::atan2(turn(1, 0), turn(0, 0)));
  set(Signal::kRoll, std::atan2(turn(2, 1), turn(2, 2)));
  set(Signal::kPitch, std::atan2(-turn(2, 0), std::hypot(turn(2, 1), turn(2, 2))));
  set(Signal::kSpeed, state.velocity.norm());
  set(Signal::kBattery, state.vehicle.battery.charge);
  set(Signal::kVoltage, state.load.voltage);
  set(Signal::kCurrent, state.load.current);
  set(Signal::kPositionStd, std::sqrt(std::max(0.0, now.covariance(0, 0) + now.covariance(1, 1))));
  set(Signal::kDvlAge, time() - std::max(0.0, state.velocity_time));
  for (std::size_t i = 0; i < plan->sensors.size(); ++i) {
    const SensorReading& latest = state.lines[i].latest;
    if (latest.index < 0) continue;
    const double value = latest.valid ? latest.values[0] : std::numeric_limits<double>::quiet_NaN();
    if (latest.kind == SensorKind::altimeter) set(Signal::kAltitude, value);
    if (latest.kind == SensorKind::leak) set(Signal::kLeak, value);
  }
  std::size_t row = static_cast<std::size_t>(Signal::kCount);
  double count = 0.0;
  const auto put = [&](const auto& watch) {
    state.signals[row++] = watch.reported ? 1.0 : 0.0;
    count += watch.reported ? 1.0 : 0.0;
  };
  for (const SensorWatch& watch : state.watchers.sensors) put(watch);
  for (const DeviceWatch& watch : state.watchers.thrusters) put(watch);
  for (const DeviceWatch& watch : state.watchers.fins) put(watch);
  put(state.watchers.battery);
  put(state.watchers.hull);
  put(state.arm);
  set(Signal::kFault, count);
}

void MissionRun::Parts::decide() {
  extra = Eigen::Map<const Vec6>(state.arm.wrench.data());
  unknown.setZero();
  for (std::size_t i = 0; state.guard < 0 && i < plan->guards.size(); ++i) {
    const MissionGuard& guard = plan->guards[i];
    double& since = state.guard_since[i];
    if (!guard.condition.holds(state.signals)) {
      since = -1.0;
      continue;
    }
    if (since < 0.0) since = time();
    if (time() < since + guard.persist - 1e-9) continue;
    tree.stop(state.tree, *this);
    state.guard = static_cast<std::int32_t>(i);
    state.tree = responses[i].fresh();
    emit("guard", guard.name + ": " + guard.condition.text());
  }
  const bool aborts = state.guard >= 0;
  const BehaviorTree& active = aborts ? responses[static_cast<std::size_t>(state.guard)] : tree;
  const NodeStatus found = active.tick(state.tree, time(), *this);
  if (found == NodeStatus::kRunning) return;
  if (aborts) {
    state.status = RunStatus::kAborted;
  } else {
    state.status = found == NodeStatus::kSuccess ? RunStatus::kDone : RunStatus::kFailed;
  }
}

void MissionRun::Parts::start(int leaf) {
  LeafState& own = state.leaves[static_cast<std::size_t>(leaf)];
  own = {};
  own.since = time();
  const MissionCommand& command = plan->commands[static_cast<std::size_t>(leaf)];
  const VehicleState here = estimated();
  const Vec3 place = here.world_from_vehicle.translation();
  state.target.heading = command.heading;
  state.target.speed = command.speed;
  state.target.moves = false;
  pilot.begin(state.pilot, here);
  if (command.kind == CommandKind::kFollow) {
    state.target.from = place.head<2>();
    aim_at_points(command, own);
  } else if (!command.points.empty()) {
    state.target.from = state.target.to = command.points.front().head<2>();
  } else if (command.kind != CommandKind::kCheck && command.kind != CommandKind::kMark &&
             command.kind != CommandKind::kStop) {
    state.target.from = state.target.to = place.head<2>();
  }
  if (command.kind != CommandKind::kCheck) emit("command", command.name + " starts");
}

void MissionRun::Parts::stop(int leaf) {
  emit("command", plan->commands[static_cast<std::size_t>(leaf)].name + " is interrupted");
}

void MissionRun::Parts::aim_at_height(const MissionCommand& command) {
  const double surface = plan->water.surface().value_or(0.0);
  state.target.climb = 0.0;
  if (command.depth) state.target.z = surface - *command.depth;
  if (!command.altitude) return;
  const double measured = state.signals[static_cast<std::size_t>(Signal::kAltitude)];
  const Vec3 place = estimated().world_from_vehicle.translation();
  if (std::isnan(measured)) {
    state.target.z = place.z();
    return;
  }
  const double bottom = place.z() - measured;
  const std::optional<BottomFollowOutput> path = path_ahead(*command.altitude, place, bottom);
  state.target.z = std::min(path ? path->z : bottom + *command.altitude, surface);
  if (path) state.target.climb = path->climb;
}

/// A vehicle with planes cannot climb at once: it follows the chart ahead, which is the world's
/// terrain at the start, raised to the bottom that the altimeter has found below.
std::optional<BottomFollowOutput> MissionRun::Parts::path_ahead(double altitude, const Vec3& place,
                                                                double bottom) const {
  const Eigen::Vector2d line = state.target.to - state.target.from;
  if (!pilot.cruises() || !state.target.moves || line.isZero()) return std::nullopt;
  const double top = plan->water.surface().value_or(place.z());
  const auto chart = [&](double x, double y) { return top - altitude_at({x, y, top}); };
  const double here = chart(place.x(), place.y());
  if (std::isnan(here)) return std::nullopt;
  BottomFollowOptions options;
  options.altitude = altitude;
  options.steepest = std::min(kChartSteepest, pilot.options().climb_speed / state.target.speed);
  options.spacing = 1.0;
  const double heading = std::atan2(line.y(), line.x());
  return follow_bottom(options, place, heading, [&](double x, double y) {
    const double height = chart(x, y);
    return std::isnan(height) ? bottom : height + bottom - here;
  });
}

bool MissionRun::Parts::held_for(LeafState& leaf, bool within, double seconds) const {
  if (!within) {
    leaf.within = -1.0;
    return false;
  }
  if (leaf.within < 0.0) leaf.within = time();
  return time() >= leaf.within + seconds - 1e-9;
}

void MissionRun::Parts::aim_at_points(const MissionCommand& command, const LeafState& leaf) {
  state.target.to = command.points[static_cast<std::size_t>(leaf.row)].head<2>();
  state.target.moves = true;
}

NodeStatus MissionRun::Parts::follow(const MissionCommand& command, LeafState& leaf) {
  const Eigen::Vector2d place = estimated().world_from_vehicle.translation().head<2>();
  const Eigen::Vector2d line = state.target.to - state.target.from;
  const double length = line.norm();
  const bool near = (state.target.to - place).norm() < command.tolerance;
  const bool passed = length > 0.0 && (place - state.target.from).dot(line) >= length * length;
  if (!near && !passed) return NodeStatus::kRunning;
  if (static_cast<std::size_t>(leaf.row) + 1 < command.points.size()) {
    state.target.from = state.target.to;
    ++leaf.row;
    aim_at_points(command, leaf);
    pilot.begin(state.pilot, estimated());
    return NodeStatus::kRunning;
  }
  state.target.moves = false;
  return NodeStatus::kSuccess;
}

NodeStatus MissionRun::Parts::reach_height(const MissionCommand& command, LeafState& leaf) {
  const double off = std::abs(estimated().world_from_vehicle.translation().z() - state.target.z);
  return held_for(leaf, off < std::min(command.tolerance, 0.5), 2.0) ? NodeStatus::kSuccess
                                                                     : NodeStatus::kRunning;
}

bool MissionRun::Parts::has_fault(std::string_view device, FaultKind kind) const {
  for (std::size_t k = 0; k < plan->faults.size(); ++k) {
    const MissionFault& fault = plan->faults[k];
    if (state.faults[k].active && fault.kind == kind && fault.device == device) return true;
  }
  return false;
}

/// The arm's encoders show a joint that is stuck; nothing on board shows a hand that is empty.
NodeStatus MissionRun::Parts::take_sample(const MissionCommand& command, LeafState& leaf) {
  SamplingArmState& arm = state.arm;
  if (arm.reported) return NodeStatus::kFailure;
  const bool stuck = has_fault("arm", FaultKind::kStuck);
  if (stuck) leaf.since += plan->tick();
  arm.behind = stuck ? arm.behind + plan->tick() : 0.0;
  const double since = time() - leaf.since;
  extra = interpolated(command.wrench_time, command.wrench, since);
  const bool lost = has_fault("arm", FaultKind::kLost);
  if (lost && !command.empty_wrench.empty()) {
    unknown = interpolated(command.wrench_time, command.empty_wrench, since) - extra;
  }
  if (arm.behind >= kArmBehind) {
    arm.reported = true;
    std::copy(extra.begin(), extra.end(), arm.wrench.begin());
    emit("report", "arm stuck");
    return NodeStatus::kFailure;
  }
  const Eigen::Vector2d off =
      estimated().world_from_vehicle.translation().head<2>() - state.target.to;
  if (off.norm() > command.tolerance) return NodeStatus::kFailure;
  if (since < command.wrench_time.back()) return NodeStatus::kRunning;
  arm.samples += lost ? 0 : 1;
  return NodeStatus::kSuccess;
}

NodeStatus MissionRun::Parts::stay(const MissionCommand& command, LeafState& leaf) {
  return time() >= leaf.since + command.time - 1e-9 ? NodeStatus::kSuccess : NodeStatus::kRunning;
}

NodeStatus MissionRun::Parts::update(int leaf) {
  const MissionCommand& command = plan->commands[static_cast<std::size_t>(leaf)];
  LeafState& own = state.leaves[static_cast<std::size_t>(leaf)];
  NodeStatus found = NodeStatus::kSuccess;
  aim_at_height(command);
  switch (command.kind) {
    case CommandKind::kWait:
    case CommandKind::kHold:
      found = stay(command, own);
      break;
    case CommandKind::kDive:
      found = reach_height(command, own);
      break;
    case CommandKind::kFollow:
      found = follow(command, own);
      break;
    case CommandKind::kSample:
      found = take_sample(command, own);
      break;
    case CommandKind::kMark:
      emit("mark", command.name);
      break;
    case CommandKind::kSurface: {
      const double depth = state.signals[static_cast<std::size_t>(Signal::kDepth)];
      state.target.z = plan->water.surface().value_or(0.0);
      found = held_for(own, depth < command.tolerance, 1.0) ? NodeStatus::kSuccess
                                                            : NodeStatus::kRunning;
      break;
    }
    case CommandKind::kDropWeight:
      std::fill(state.commands.drop.begin(), state.commands.drop.end(), 1);
      break;
    case CommandKind::kCheck:
      found = command.condition->holds(state.signals) ? NodeStatus::kSuccess : NodeStatus::kFailure;
      return found;
    case CommandKind::kStop:
      found = NodeStatus::kFailure;
  }
  if (found != NodeStatus::kRunning) {
    emit("command", command.name + (found == NodeStatus::kSuccess ? " succeeds" : " fails"));
  }
  return found;
}

void MissionRun::Parts::steer(const LiveInputs& inputs) {
  const Vec3 current(state.navigation.now.current.x(), state.navigation.now.current.y(), 0.0);
  const double voltage =
      state.load.voltage > 0.0 ? state.load.voltage : plan->vehicle.supply_voltage;
  pilot.step(state.pilot, estimated(), state.target, current, voltage, failed, extra, plan->tick(),
             state.commands);
  if (!inputs.thrusters.empty()) state.commands.thrusters = inputs.thrusters;
  if (!inputs.fins.empty()) state.commands.fins = inputs.fins;
  driven = state.commands;
  for (std::size_t k = 0; k < plan->faults.size(); ++k) {
    const MissionFault& fault = plan->faults[k];
    if (!state.faults[k].active || fault_device[k] < 0 || is_sensor(*plan, fault.device)) continue;
    const auto row = static_cast<std::size_t>(fault_device[k]);
    if (is_thruster(*plan, fault.device)) {
      double& command = driven.thrusters[row];
      command = apply_drive_fault(fault, command, state.held_commands[row]);
    } else {
      double& command = driven.fins[row];
      command =
          apply_drive_fault(fault, command, state.held_commands[driven.thrusters.size() + row]);
    }
  }
  std::copy(driven.thrusters.begin(), driven.thrusters.end(), state.held_commands.begin());
  std::copy(driven.fins.begin(), driven.fins.end(),
            state.held_commands.begin() + static_cast<std::ptrdiff_t>(driven.thrusters.size()));
}

void MissionRun::Parts::move(const LiveInputs& inputs) {
  Vec6 outside = extra + unknown;
  for (std::size_t i = 0; i < inputs.wrench.size(); ++i) {
    outside[static_cast<Eigen::Index>(i)] += inputs.wrench[i];
  }
  const Vehicle& vehicle = system->vehicle();
  const double start = time();
  double leaking = 0.0;
  for (std::size_t k = 0; k < plan->faults.size(); ++k) {
    const bool leaks = state.faults[k].active && plan->faults[k].kind == FaultKind::kLeak;
    leaking += leaks ? plan->faults[k].size : 0.0;
  }
  for (int i = 0; i < plan->steps_per_tick; ++i) {
    const double from = start + i * plan->step;
    const auto around = [&](double after, const VehicleState& motion) {
      StepConditions found;
      found.flow = environment.flow(motion.world_from_vehicle.translation(), from + after);
      found.wrench = outside + environment.wrench(vehicle, motion, found.flow, from + after);
      if (state.leak > 0.0) {
        const Vec3 down = -motion.world_from_vehicle.linear().row(2).transpose();
        const Vec3 weight = state.leak * plan->weight_of_leak * down;
        found.wrench.head<3>() += weight;
        found.wrench.tail<3>() += plan->leak_position.cross(weight);
      }
      return found;
    };
    const Vec6 before = state.vehicle.motion.velocity;
    state.load = system->supply(state.vehicle, driven);
    system->step(state.vehicle, driven, around, plan->step);
    state.leak += leaking * plan->step;
    state.sums.energy += state.load.voltage * state.load.current * plan->step;
    const Vec6 acceleration = (state.vehicle.motion.velocity - before) / plan->step;
    sense(start + (i + 1) * plan->step, acceleration);
  }
  driven.drop.assign(driven.drop.size(), 0);
  state.commands.drop = driven.drop;
}

void MissionRun::Parts::account(double before_x, double before_y, double before_z) {
  const Vec3 place = state.vehicle.motion.world_from_vehicle.translation();
  MissionSums& sums = state.sums;
  sums.distance += (place - Vec3(before_x, before_y, before_z)).norm();
  sums.deepest = std::max(sums.deepest, plan->water.surface().value_or(0.0) - place.z());
  if (!std::isnan(state.altitude)) {
    sums.least_altitude = std::min(sums.least_altitude, state.altitude);
  }
  const double error = (estimated().world_from_vehicle.translation() - place).head<2>().norm();
  sums.squared_error += error * error;
  sums.largest_error = std::max(sums.largest_error, error);
}

void MissionRun::Parts::record() {
  if (sink == nullptr) return;
  MissionTick tick;
  tick.time = time();
  tick.number = state.number;
  tick.truth = &state.vehicle;
  tick.estimated = estimated();
  tick.position_std = state.signals[static_cast<std::size_t>(Signal::kPositionStd)];
  tick.target = state.target;
  tick.commands = &state.commands;
  tick.load = state.load;
  tick.altitude = state.altitude;
  tick.depth = plan->water.surface().value_or(0.0) -
               state.vehicle.motion.world_from_vehicle.translation().z();
  sink->tick(tick);
}

bool MissionRun::Parts::step(const LiveInputs& inputs) {
  if (state.status != RunStatus::kRunning) return false;
  if (state.number == 0) emit("start", plan->name);
  if (sink != nullptr && !inputs.none()) sink->inputs(time(), state.number, inputs);
  update_faults_now();
  deliver();
  const bool silent = time() > std::max(0.0, state.velocity_time) + kSilence;
  if (silent) {
    reckon_by_model();
  } else if (state.navigation.now.input == 0) {
    reckon(time());
  }
  watch();
  update_signals();
  decide();
  if (inputs.stop) state.status = RunStatus::kStopped;
  if (state.status == RunStatus::kRunning && time() >= plan->longest) {
    state.status = RunStatus::kTimeout;
  }
  if (state.status != RunStatus::kRunning) {
    emit("end", std::string(status_name(state.status)));
    record();
    return false;
  }
  steer(inputs);
  record();
  const Vec3 before = state.vehicle.motion.world_from_vehicle.translation();
  move(inputs);
  ++state.number;
  account(before.x(), before.y(), before.z());
  return true;
}

std::string MissionRun::Parts::fingerprint() const {
  std::string text = plan->name;
  text.append("|").append(plan->vehicle.vehicle.name);
  const auto put = [&text](const std::string& part) { text.append("|").append(part); };
  for (const auto& sensor : plan->sensors) put(sensor.name);
  for (const auto& command : plan->commands) put(command.name);
  for (const auto& fault : plan->faults) put(fault.device);
  put(to_text(plan->step));
  put(std::to_string(plan->steps_per_tick));
  return text;
}

}  // namespace bathyal
