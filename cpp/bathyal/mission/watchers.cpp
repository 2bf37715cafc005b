// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/watchers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bathyal {
namespace {

constexpr double kRecent = 0.1;    // weight of the last reading in the share refused
constexpr double kLately = 0.005;  // and in the mean of innovations

/// Whether a velocity changed faster than a vehicle does.
bool jumps(const SensorOptions& sensor, const SensorReading& before, const SensorReading& reading,
           double acceleration) {
  if (before.index < 0 || !before.valid || !reading.valid) return false;
  double change = 0.0, noise = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    change = std::max(change, std::abs(reading.values[i] - before.values[i]));
    noise = std::max(noise, sensor.channels[i].noise);
  }
  return change > acceleration * (reading.time - before.time) + 8.0 * noise;
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

void report(DeviceWatch& watch, std::string device, std::string kind,
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

void Watchers::reading(WatcherState& state, int device, const SensorReading& before,
                       const SensorReading& reading, const NavigationUpdate* update,
                       std::vector<DeviceReport>& reports) const {
  const auto row = static_cast<std::size_t>(device);
  const SensorOptions& sensor = sensors_[row];
  DeviceWatch& watch = state.sensors[row];
  watch.seen = std::max(watch.seen, reading.arrival);
  const bool noisy = sensor.channels[0].noise > 0.0 && sensor.channels[0].quantum == 0.0;
  const bool equal =
      before.index >= 0 && before.valid && reading.valid && before.values == reading.values;
  watch.repeats = equal && noisy ? watch.repeats + 1 : 0;
  bool drifts = false;
  if (update != nullptr && update->used) {
    watch.refused += kRecent * ((update->accepted ? 0.0 : 1.0) - watch.refused);
    for (int i = 0; i < std::min(update->count, 3); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double sigma = std::sqrt(update->covariance(i, i));
      watch.mean[k] += kLately * (update->innovation[k] / sigma - watch.mean[k]);
      drifts = drifts || std::abs(watch.mean[k]) > options_.mean;
    }
  } else if (reading.kind == SensorKind::dvl) {
    const bool jump = jumps(sensor, before, reading, options_.acceleration);
    watch.refused += kRecent * ((jump ? 1.0 : 0.0) - watch.refused);
  }
  if (watch.reported) return;
  if (watch.repeats >= options_.repeats) report(watch, sensor.name, "stuck", reports);
  if (!watch.reported && (drifts || watch.refused > options_.refused)) {
    report(watch, sensor.name, "wrong", reports);
  }
  if (!watch.reported && sensor.kind == SensorKind::leak && reading.valid &&
      reading.values[0] > options_.leak_least && !state.hull.reported) {
    report(state.hull, "hull", "leak", reports);
  }
}

void Watchers::tick(WatcherState& state, double time, double step, const VehicleCommands& commands,
                    const std::vector<double>& speeds, const std::vector<double>& angles,
                    double voltage, double current, double charge,
                    std::vector<DeviceReport>& reports) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    DeviceWatch& watch = state.sensors[i];
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
