// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/watchers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace bathyal {
namespace {

constexpr double kRecent = 0.1;    // weight of the last reading in the share refused
constexpr double kLately = 0.005;  // and in the mean of innovations
constexpr double kLost = 0.02;     // and in the share lost
constexpr double kLate = 0.05;     // and in the delay
constexpr double kWindow = 40.0;   // of mean rates [s]
constexpr double kSettled = 10.0;  // from when on they are compared [s]
constexpr double kNoise = 8.0;     // of a sensor, that a jump is beyond
constexpr double kLevel = 0.3;     // of what compass and gyro may be apart
constexpr int kFewRepeats = 4;     // from which on a sensor is suspected

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

/// What a channel of a sensor changes by at most as a vehicle moves, in a time; infinite where that
/// is not known.
double most_change(SensorKind kind, std::size_t channel, double time) {
  switch (kind) {
    case SensorKind::dvl:
      return 2.0 * time;  // [m/s²]
    case SensorKind::compass:
      return 1.5 * time;  // [rad/s]
    case SensorKind::imu:
      return channel < 3 ? 30.0 * time
                         : 15.0;  // [rad/s²], [m/s²]: small vehicles have strong thrusters
    case SensorKind::depth:
    case SensorKind::altimeter:
      return 3.0 * time;  // [m/s]
    case SensorKind::leak:
      return 2.0 * time;  // [kg/s]
    default:
      return std::numeric_limits<double>::infinity();
  }
}

/// Whether a reading is farther from the one before than a vehicle moves.
bool jumps(const SensorOptions& sensor, const SensorReading& before, const SensorReading& reading) {
  if (before.index < 0 || !before.valid || !reading.valid) return false;
  for (int i = 0; i < reading.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    double change = reading.values[k] - before.values[k];
    if (reading.kind == SensorKind::compass) change = wrapped(change);
    const double most = most_change(reading.kind, k, reading.time - before.time);
    if (std::abs(change) > most + kNoise * sensor.channels[k].noise) return true;
  }
  return false;
}

void take_timing(const SensorOptions& sensor, const SensorReading& reading, SensorWatch& watch) {
  watch.seen = std::max(watch.seen, reading.arrival);
  const double delay = reading.arrival - reading.time - sensor.latency;
  watch.late += kLate * (delay - watch.late);
  if (reading.index <= watch.index) return;
  const std::int64_t missed = std::min<std::int64_t>(reading.index - watch.index - 1, 1000);
  for (std::int64_t i = 0; i < missed; ++i) watch.lost += kLost * (1.0 - watch.lost);
  watch.lost -= kLost * watch.lost;
  watch.index = reading.index;
}

/// The mean forgets in kWindow.
void take_rate(RateWatch& watch, double time, double rate) {
  if (watch.time < 0.0) {
    watch.since = time;
  } else {
    const double share = std::min(1.0, (time - watch.time) / kWindow);
    watch.mean += share * (rate - watch.mean);
  }
  watch.time = time;
}

/// The same of a value's change.
void take_value(RateWatch& watch, double time, double value, bool is_angle = false) {
  const double change = is_angle ? wrapped(value - watch.value) : value - watch.value;
  if (watch.time < 0.0) {
    take_rate(watch, time, 0.0);
  } else if (time > watch.time) {
    take_rate(watch, time, change / (time - watch.time));
  }
  watch.value = value;
}

bool settled(const RateWatch& one, const RateWatch& other) {
  const double now = std::max(one.time, other.time);
  return one.time >= 0.0 && other.time >= 0.0 &&
         now > std::max(one.since, other.since) + kSettled &&
         now < std::min(one.time, other.time) + 2.0;
}

/// Whether it has not been right for long enough, and is not reported yet.
bool persists(DeviceWatch& watch, bool wrong, double time, double persist) {
  if (!wrong) {
    watch.since = -1.0;
    return false;
  }
  if (watch.since < 0.0) watch.since = time;
  return !watch.reported && time >= watch.since + persist - 1e-9;
}

template <class Watch>
void report(Watch& watch, std::string device, std::string kind,
            std::vector<DeviceReport>& reports) {
  watch.reported = true;
  reports.push_back({std::move(device), std::move(kind)});
}

std::string drive_kind(double expected, double found) {
  if (std::abs(found) < 0.1 * std::abs(expected)) return "dead";
  return expected * found < 0.0 ? "reversed" : "weak";
}

}  // namespace

Watchers::Watchers(const VehicleSystem& system, std::vector<SensorOptions> sensors,
                   WatcherOptions options)
    : thrusters_(system.thrusters()),
      fins_(system.fins()),
      gravity_(system.vehicle().options().gravity),
      sensors_(std::move(sensors)),
      options_(options) {
  if (system.options().battery) battery_.emplace(*system.options().battery);
}

WatcherState Watchers::fresh() const {
  WatcherState state;
  state.sensors.resize(sensors_.size());
  state.thrusters.resize(thrusters_.size());
  state.fins.resize(fins_.size());
  return state;
}

/// Whether a device that predicts is suspected, so that what rests on it is not assessed.
bool Watchers::suspects(const WatcherState& state, std::size_t except) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const SensorKind kind = sensors_[i].kind;
    const bool predicts =
        kind == SensorKind::dvl || kind == SensorKind::compass || kind == SensorKind::imu;
    const SensorWatch& watch = state.sensors[i];
    if (predicts && i != except &&
        (watch.reported || watch.refused > options_.suspected || watch.repeats >= kFewRepeats)) {
      return true;
    }
  }
  return false;
}

/// What a sensor's own readings say against it; null: nothing.
const char* Watchers::own_fault(const SensorOptions& sensor, const SensorWatch& watch) const {
  if (watch.repeats >= options_.repeats) return "stuck";
  if (watch.lost > sensor.dropout + options_.lost) return "intermittent";
  if (watch.late > options_.late && sensor.kind != SensorKind::usbl) return "delayed";
  return nullptr;
}

/// Whether a propeller or fin does something else than it should: the vehicle may tumble then, and
/// sensors are not assessed by how it moves.
bool Watchers::is_driven_wrong(const WatcherState& state) const {
  const auto wrong = [](const DeviceWatch& watch) { return watch.since >= 0.0; };
  return std::any_of(state.thrusters.begin(), state.thrusters.end(), wrong) ||
         std::any_of(state.fins.begin(), state.fins.end(), wrong);
}

/// By how much compass and gyro differ in how fast the vehicle turns [rad/s].
double Watchers::turns_apart(const WatcherState& state) const {
  const RateWatch &compass = state.compass_turn, &gyro = state.gyro_turn;
  return settled(compass, gyro) ? std::abs(compass.mean - gyro.mean) : 0.0;
}

void Watchers::blame(WatcherState& state, SensorKind kind,
                     std::vector<DeviceReport>& reports) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    SensorWatch& watch = state.sensors[i];
    if (sensors_[i].kind == kind && !watch.reported) {
      report(watch, sensors_[i].name, "wrong", reports);
      return;
    }
  }
}

void Watchers::compare_rates(WatcherState& state, std::size_t row, const SensorReading& reading,
                             const Eigen::Quaterniond& attitude,
                             std::vector<DeviceReport>& reports) const {
  const Eigen::Matrix3d mount = sensors_[row].vehicle_from_sensor.linear();
  const Vec3 first(reading.values[0], reading.values[1], reading.values[2]);
  switch (reading.kind) {
    case SensorKind::depth:
      take_value(state.depth_rise, reading.time, -reading.values[0]);
      break;
    case SensorKind::altimeter:
      take_value(state.altimeter_rise, reading.time, reading.values[0]);
      break;
    case SensorKind::dvl:
      take_rate(state.log_rise, reading.time, (attitude * (mount * first)).z());
      break;
    case SensorKind::compass:
      take_value(state.compass_turn, reading.time, reading.values[2], true);
      break;
    case SensorKind::imu: {
      take_rate(state.gyro_turn, reading.time, (attitude * (mount * first)).z());
      const Vec3 force(reading.values[3], reading.values[4], reading.values[5]);
      take_rate(state.roll, reading.time, (mount * first).x());
      take_rate(state.pitch, reading.time, (mount * first).y());
      take_rate(state.force, reading.time, force.norm() - gravity_);
      const Vec3 turned = attitude * (mount * force);
      take_rate(state.level_x, reading.time, turned.x());
      take_rate(state.level_y, reading.time, turned.y());
      if (is_driven_wrong(state)) break;
      const double rolling = std::max(std::abs(state.roll.mean), std::abs(state.pitch.mean));
      if (rolling > options_.rolling || std::abs(state.force.mean) > options_.force) {
        blame(state, SensorKind::imu, reports);
      }
      break;
    }
    default:
      return;
  }
  if (suspects(state, sensors_.size()) || is_driven_wrong(state)) return;
  const double apart = turns_apart(state);
  if (apart < options_.turn) {
    state.turn_since = -1.0;
  } else if (state.turn_since < 0.0) {
    state.turn_since = reading.time;
  } else if (reading.time > state.turn_since + options_.turn_persist) {
    // a compass that errs in roll or pitch makes gravity lie along the level; a gyro does not
    const bool level = std::hypot(state.level_x.mean, state.level_y.mean) < options_.level;
    const bool rolls = std::hypot(state.roll.mean, state.pitch.mean) > 0.5 * apart;
    blame(state, level && rolls ? SensorKind::imu : SensorKind::compass, reports);
  }
  if (apart > kLevel * options_.turn) return;  // the log's velocity is turned by the compass
  const RateWatch &depth = state.depth_rise, &log = state.log_rise, &above = state.altimeter_rise;
  if (settled(depth, log) && std::abs(depth.mean - log.mean) > options_.rise) {
    const bool third = settled(log, above) && settled(depth, above);
    const bool log_is_apart =
        third && std::abs(depth.mean - above.mean) < std::abs(log.mean - above.mean);
    blame(state, log_is_apart ? SensorKind::dvl : SensorKind::depth, reports);
  }
}

void Watchers::reading(WatcherState& state, int device, const SensorReading& before,
                       const SensorReading& reading, const Eigen::Quaterniond& attitude,
                       const NavigationUpdate* update, std::vector<DeviceReport>& reports) const {
  const auto row = static_cast<std::size_t>(device);
  const SensorOptions& sensor = sensors_[row];
  SensorWatch& watch = state.sensors[row];
  take_timing(sensor, reading, watch);
  const bool noisy = sensor.channels[0].noise > 0.0 && sensor.channels[0].quantum == 0.0;
  const bool equal =
      before.index >= 0 && before.valid && reading.valid && before.values == reading.values;
  watch.repeats = equal && noisy ? watch.repeats + 1 : 0;
  const bool jump = jumps(sensor, before, reading) && !is_driven_wrong(state);
  bool drifts = false;
  const bool assessed = !is_driven_wrong(state) && !suspects(state, row) &&
                        turns_apart(state) < kLevel * options_.turn;
  if (update != nullptr && update->used && assessed) {
    watch.refused += kRecent * ((update->accepted && !jump ? 0.0 : 1.0) - watch.refused);
    for (int i = 0; i < std::min(update->count, 3); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double sigma = std::sqrt(update->covariance(i, i));
      watch.mean[k] += kLately * (update->innovation[k] / sigma - watch.mean[k]);
      drifts = drifts || std::abs(watch.mean[k]) > options_.mean;
    }
  } else {
    watch.refused += kRecent * ((jump ? 1.0 : 0.0) - watch.refused);
  }
  if (reading.valid) compare_rates(state, row, reading, attitude, reports);
  if (watch.reported) return;
  if (const char* own = own_fault(sensor, watch)) {
    report(watch, sensor.name, own, reports);
  } else if (drifts || watch.refused > options_.refused) {
    report(watch, sensor.name, "wrong", reports);
  } else if (sensor.kind == SensorKind::leak && reading.valid &&
             reading.values[0] > options_.leak_least && !state.hull.reported) {
    report(state.hull, "hull", "leak", reports);
  }
}

void Watchers::tick(WatcherState& state, double time, double step, const VehicleCommands& commands,
                    const std::vector<double>& speeds, const std::vector<double>& angles,
                    double voltage, double current, double charge,
                    std::vector<DeviceReport>& reports) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    SensorWatch& watch = state.sensors[i];
    const double patience =
        std::max(1.0, options_.silence / sensors_[i].rate) + sensors_[i].latency;
    if (!watch.reported && time > watch.seen + patience && sensors_[i].dropout < 0.5) {
      report(watch, sensors_[i].name, "off", reports);
    }
  }
  for (std::size_t i = 0; i < thrusters_.size(); ++i) {
    DeviceWatch& watch = state.thrusters[i];
    const ThrusterDrive drive = thrusters_[i].drive(commands.thrusters[i], voltage);
    watch.expected = thrusters_[i].advanced({watch.expected}, drive, step).speed;
    const double allowed =
        std::max(options_.speed_least, options_.speed_share * std::abs(watch.expected));
    const bool wrong = std::abs(speeds[i] - watch.expected) > allowed;
    if (persists(watch, wrong, time, options_.persist)) {
      report(watch, thrusters_[i].options().name, drive_kind(watch.expected, speeds[i]), reports);
    }
  }
  for (std::size_t i = 0; i < fins_.size(); ++i) {
    DeviceWatch& watch = state.fins[i];
    watch.expected = fins_[i].advanced({watch.expected}, commands.fins[i], step).angle;
    const bool wrong = std::abs(angles[i] - watch.expected) > options_.angle_least;
    if (persists(watch, wrong, time, options_.persist)) {
      report(watch, fins_[i].options().name, "stuck", reports);
    }
  }
  if (!battery_) return;
  const double expected = battery_->open_circuit(charge) - battery_->options().resistance * current;
  if (persists(state.battery, voltage < expected - options_.voltage_least, time,
               options_.persist)) {
    report(state.battery, battery_->options().name, "sag", reports);
  }
}

}  // namespace bathyal
