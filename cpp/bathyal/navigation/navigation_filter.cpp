// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/navigation_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/navigation/internal/filter_steps.hpp"

namespace bathyal {
namespace {

constexpr int kInertial = 1, kMotion = 2, kReading = 3;
constexpr double kLongestHold = 1.0;    // [s], of the last input, for a reading after it
constexpr double kSameTime = 1e-9;      // [s]
constexpr double kSnapshotsALag = 8.0;  // late readings repeat up to an eighth of the lag more

using Record = std::vector<NavigationStep>;

void append(Record* record, NavigationEstimate& estimate, const Transition& transition,
            bool is_row) {
  if (record == nullptr) return;
  ++estimate.steps;
  NavigationStep& step = record->emplace_back();
  step.is_row = is_row;
  step.transition = transition;
  step.after = estimate;
}

void append(Record& record, NavigationEstimate& estimate, const Correction& correction) {
  ++estimate.steps;
  NavigationStep& step = record.emplace_back();
  step.is_correction = true;
  step.correction = correction;
  step.after = estimate;
}

NavigationUpdate run(const NavigationOptions& options, NavigationEstimate& estimate,
                     const NavigationInput& input, Record* record) {
  if (input.kind != kReading) {
    append(record, estimate, apply_prediction(options, estimate, input), true);
    return {};
  }
  if (input.time > estimate.time + kSameTime) {
    append(record, estimate, hold_until(options, estimate, input.time), false);
  }
  const SensorOptions& device = options.devices[static_cast<std::size_t>(input.device)];
  Correction correction;
  const NavigationUpdate result =
      apply_reading(options, estimate, device, input.reading, correction);
  if (result.accepted && record != nullptr) append(*record, estimate, correction);
  return result;
}

/// Forgets inputs and snapshots that no reading can be late for.
void forget(const NavigationOptions& options, NavigationState& state) {
  const double oldest = state.now.time - options.lag;
  auto& snapshots = state.snapshots;
  std::size_t past = 0;
  while (past + 1 < snapshots.size() && snapshots[past + 1].estimate.time <= oldest) ++past;
  if (past == 0) return;
  snapshots.erase(snapshots.begin(), snapshots.begin() + static_cast<std::ptrdiff_t>(past));
  const std::int64_t gone = snapshots.front().next_input - state.dropped;
  state.inputs.erase(state.inputs.begin(), state.inputs.begin() + gone);
  state.dropped += gone;
}

void remember(const NavigationOptions& options, NavigationState& state, std::int64_t next) {
  const double due = options.lag / kSnapshotsALag;
  if (!state.snapshots.empty() && state.now.time - state.snapshots.back().estimate.time < due) {
    return;
  }
  state.snapshots.push_back({state.now, next});
  forget(options, state);
}

/// Runs an input that is not late, and keeps it for those that will be.
NavigationUpdate run_and_keep(const NavigationOptions& options, NavigationState& state,
                              const NavigationInput& input, Record* record) {
  if (options.lag == 0.0) return run(options, state.now, input, record);
  state.inputs.push_back(input);
  const NavigationUpdate result = run(options, state.now, input, record);
  remember(options, state, state.dropped + static_cast<std::int64_t>(state.inputs.size()));
  return result;
}

/// Goes back to the last snapshot before the reading and runs everything since in order of time.
NavigationUpdate run_late(const NavigationOptions& options, NavigationState& state,
                          const NavigationInput& late, Record* record) {
  auto& snapshots = state.snapshots;
  if (snapshots.empty() || snapshots.front().estimate.time > late.time) return {};
  while (snapshots.back().estimate.time > late.time) snapshots.pop_back();
  auto& inputs = state.inputs;
  const auto place = std::upper_bound(
      inputs.begin(), inputs.end(), late,
      [](const NavigationInput& a, const NavigationInput& b) { return a.time < b.time; });
  const auto at = static_cast<std::size_t>(place - inputs.begin());
  inputs.insert(place, late);
  state.now = snapshots.back().estimate;
  if (record != nullptr) record->resize(static_cast<std::size_t>(state.now.steps));
  NavigationUpdate result;
  const auto first = static_cast<std::size_t>(snapshots.back().next_input - state.dropped);
  for (std::size_t i = first; i < inputs.size(); ++i) {
    const NavigationUpdate one = run(options, state.now, inputs[i], record);
    if (i == at) result = one;
    const double due = snapshots.back().estimate.time + options.lag / kSnapshotsALag;
    if (state.now.time >= due) {
      snapshots.push_back({state.now, state.dropped + static_cast<std::int64_t>(i) + 1});
    }
  }
  return result;
}

void check_vector(std::string_view name, const Vec3& values) {
  for (const double value : values) check_finite(name, value);
}

void check_after(const NavigationState& state, double time) {
  check_finite("time", time);
  const bool begins = state.now.input == 0;
  if (time > state.now.time || (begins && time == state.now.time)) return;
  throw_argument("time", "one after " + to_text(state.now.time) + " s, the filter's",
                 to_text(time));
}

void check_reading(const SensorOptions& device, const SensorReading& reading, double now) {
  if (reading.kind != device.kind) {
    throw_argument("reading", "one of the kind " + sensor_kind_name(device.kind),
                   sensor_kind_name(reading.kind));
  }
  if (reading.count != device.channel_count()) {
    throw_argument("reading", std::to_string(device.channel_count()) + " values",
                   std::to_string(reading.count));
  }
  check_finite("reading.time", reading.time);
  if (reading.kind != SensorKind::imu && reading.time > now + kLongestHold) {
    throw_argument("reading.time", "at most a second after the filter's, " + to_text(now) + " s",
                   to_text(reading.time));
  }
  if (!reading.valid) return;
  for (int i = 0; i < reading.count; ++i) {
    check_finite("reading.values", reading.values[static_cast<std::size_t>(i)]);
  }
}

}  // namespace

Pose NavigationEstimate::world_from_vehicle() const {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(attitude).toRotationMatrix();
  pose.translation() = position;
  return pose;
}

Vec3 NavigationEstimate::fix_point() const {
  return position + Eigen::Quaterniond(attitude) * fix_lever;
}

NavigationFilter::NavigationFilter(NavigationOptions options) : options_(std::move(options)) {
  options_.check();
}

NavigationState NavigationFilter::start(double time, const Pose& world_from_vehicle,
                                        const Vec3& velocity) const {
  check_finite("time", time);
  check_rigid("world_from_vehicle", world_from_vehicle);
  check_vector("velocity", velocity);
  NavigationState state;
  NavigationEstimate& now = state.now;
  now.time = time;
  now.position = world_from_vehicle.translation();
  now.velocity = velocity;
  now.attitude = Eigen::Quaterniond(world_from_vehicle.linear()).normalized().coeffs();
  NavigationVector deviation = NavigationVector::Zero();
  deviation.segment<3>(kPosition) = options_.initial_position;
  deviation.segment<3>(kVelocity) = options_.initial_velocity;
  deviation.segment<3>(kAttitude) = options_.initial_attitude;
  deviation.segment<3>(kGyroBias).setConstant(options_.initial_gyro_bias);
  deviation.segment<3>(kAccelBias).setConstant(options_.initial_accel_bias);
  deviation[kLogScale] = options_.log_scale;
  deviation.segment<3>(kLogMount).setConstant(options_.log_mount);
  deviation.segment<2>(kCurrent).setConstant(options_.current);
  deviation.segment<3>(kFixLever).setConstant(options_.fix_lever);
  now.covariance.diagonal() = deviation.cwiseAbs2();
  if (options_.lag > 0.0) state.snapshots.push_back({now, 0});
  return state;
}

void NavigationFilter::predict(NavigationState& state, double time, const Vec3& rate,
                               const Vec3& force, std::vector<NavigationStep>* record) const {
  check_after(state, time);
  check_vector("rate", rate);
  check_vector("force", force);
  NavigationInput input;
  input.kind = kInertial;
  input.time = time;
  input.first = rate;
  input.second = force;
  run_and_keep(options_, state, input, record);
}

void NavigationFilter::predict_motion(NavigationState& state, double time,
                                      const Eigen::Quaterniond& attitude, const Vec3& velocity,
                                      std::vector<NavigationStep>* record, double walk) const {
  check_after(state, time);
  if (!(std::abs(attitude.norm() - 1.0) < 1e-6)) {
    throw_argument("attitude", "a unit quaternion", "norm " + to_text(attitude.norm()));
  }
  check_vector("velocity", velocity);
  check_not_negative("walk", walk);
  NavigationInput input;
  input.first.x() = walk;
  input.kind = kMotion;
  input.time = time;
  input.second = velocity;
  input.attitude = attitude.normalized().coeffs();
  run_and_keep(options_, state, input, record);
}

NavigationUpdate NavigationFilter::update(NavigationState& state, int device,
                                          const SensorReading& reading,
                                          std::vector<NavigationStep>* record) const {
  if (device < 0 || device >= static_cast<int>(options_.devices.size())) {
    throw_argument("device", "0 to " + std::to_string(options_.devices.size()) + ", exclusive",
                   std::to_string(device));
  }
  const SensorOptions& options = options_.devices[static_cast<std::size_t>(device)];
  check_reading(options, reading, state.now.time);
  if (reading.kind == SensorKind::imu) {
    if (reading.valid) predict_reading(state, options.vehicle_from_sensor, reading, record);
    return {};
  }
  NavigationInput input;
  input.kind = kReading;
  input.time = reading.time;
  input.reading = reading;
  input.device = device;
  if (reading.time < state.now.time - kSameTime) return run_late(options_, state, input, record);
  return run_and_keep(options_, state, input, record);
}

void NavigationFilter::predict_reading(NavigationState& state, const Pose& mount,
                                       const SensorReading& reading,
                                       std::vector<NavigationStep>* record) const {
  const auto& v = reading.values;
  const Vec3 arm = mount.translation();
  const Vec3 rate = mount.linear() * Vec3(v[0], v[1], v[2]);
  const Vec3 spin = rate - state.now.gyro_bias;
  Vec3 force = mount.linear() * Vec3(v[3], v[4], v[5]) - spin.cross(spin.cross(arm));
  const double dt = reading.time - state.now.input_time;
  if (state.now.input == kInertial && dt > 0.0) force -= (rate - state.now.rate).cross(arm) / dt;
  predict(state, reading.time, rate, force, record);
}

int NavigationFilter::device(const std::string& name) const {
  std::string names;
  for (std::size_t i = 0; i < options_.devices.size(); ++i) {
    if (options_.devices[i].name == name) return static_cast<int>(i);
    names += (names.empty() ? "" : ", ") + options_.devices[i].name;
  }
  throw_argument("device",
                 names.empty() ? "a device of the filter, which has none" : "one of " + names,
                 "\"" + name + "\"");
}

}  // namespace bathyal
