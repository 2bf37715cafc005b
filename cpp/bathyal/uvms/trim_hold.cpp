// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/uvms/trim_hold.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr double kBalanced = 1e-3;  // of a wrench, or of 1 N or N m where it is smaller

bool balances(const Allocation& allocation, double voltage, const Vec6& wanted) {
  AllocationResult given;
  allocation.allocate(wanted, voltage, {}, given);
  const Vec6 allowed = kBalanced * wanted.cwiseAbs().cwiseMax(1.0);
  return ((given.achieved - wanted).cwiseAbs().array() <= allowed.array()).all();
}

/// The axis that takes the largest part of what all thrusters together give in it.
int hardest_axis(const Allocation& allocation, double voltage, const Vec6& wanted) {
  Vec6 most = Vec6::Constant(1e-9);
  for (const Thruster& thruster : allocation.thrusters()) {
    most += thruster.steady(1.0, voltage).thrust * thruster.column().cwiseAbs();
  }
  int axis = 0;
  wanted.cwiseQuotient(most).cwiseAbs().maxCoeff(&axis);
  return axis;
}

/// That the thrusters can balance what is expected, in each row.
void check_balance(const Allocation& allocation, const TrimHoldOptions& options) {
  const auto& times = options.expected_wrench.time;
  for (std::size_t k = 0; k < options.expected_wrench.rows.size(); ++k) {
    const Vec6 wanted = -options.expected_wrench.rows[k];
    if (balances(allocation, options.voltage, wanted)) continue;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 20; ++i) {
      const double middle = 0.5 * (low + high);
      (balances(allocation, options.voltage, middle * wanted) ? low : high) = middle;
    }
    const int axis = hardest_axis(allocation, options.voltage, wanted);
    throw_argument("expected_wrench", "what the thrusters can balance",
                   to_text(options.expected_wrench.rows[k][axis]) + (axis < 3 ? " N" : " N m") +
                       " in " + kAxisNames[static_cast<std::size_t>(axis)] +
                       (times.empty() ? "" : " at " + to_text(times[k]) + " s") + ": they give " +
                       to_text(std::floor(100.0 * low)) + " % of that wrench");
  }
}

/// What turns within a period: thrusters that near the speeds they were asked for.
class Drives {
 public:
  Drives(const Allocation& allocation, double voltage)
      : allocation_(allocation),
        voltage_(voltage),
        states_(allocation.thrusters().size()),
        drives_(allocation.thrusters().size()) {}

  void command(double time, const std::vector<double>& commands) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Thruster& thruster = allocation_.thrusters()[i];
      if (begun_) states_[i] = thruster.advanced(states_[i], drives_[i], time - since_);
      drives_[i] = thruster.drive(commands[i], voltage_);
      if (!begun_) states_[i].speed = drives_[i].speed;  // the vehicle was held before
    }
    begun_ = true;
    since_ = time;
  }

  Vec6 wrench(double time, const Vec6& relative) const {
    Vec6 sum = Vec6::Zero();
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Thruster& thruster = allocation_.thrusters()[i];
      const ThrusterState now = thruster.advanced(states_[i], drives_[i], time - since_);
      sum += thruster.wrench(now.speed, drives_[i], relative);
    }
    return sum;
  }

 private:
  const Allocation& allocation_;
  double voltage_, since_ = 0.0;
  bool begun_ = false;
  std::vector<ThrusterState> states_;
  std::vector<ThrusterDrive> drives_;
};

void append(const ArmMotionRecord& part, std::size_t from, ArmMotionRecord& whole) {
  const auto tail = [from](const auto& values, std::size_t width, auto& all) {
    all.insert(all.end(), values.begin() + static_cast<std::ptrdiff_t>(from * width), values.end());
  };
  const std::size_t joints = part.q.size() / part.vehicle.time.size();
  tail(part.vehicle.time, 1, whole.vehicle.time);
  tail(part.vehicle.state, 1, whole.vehicle.state);
  tail(part.q, joints, whole.q);
  tail(part.effort, joints, whole.effort);
}

}  // namespace

void TrimHoldOptions::check() const {
  SimulateTreeOptions steps;
  steps.duration = duration;
  steps.step = step;
  steps.check();
  check_positive("period", period);
  check_positive("voltage", voltage);
  if (std::abs(std::round(period / step) * step - period) > 1e-9 * period || period < 0.5 * step) {
    throw_argument("period", "a whole number of steps of " + to_text(step) + " s", to_text(period));
  }
  tip_wrench.check("tip_wrench");
  expected_wrench.check("expected_wrench");
  if (!current.allFinite()) throw_argument("current", "finite numbers", "others");
}

TrimHoldRecord hold_trim(const ArmOnVehicle& system, const Allocation& allocation,
                         const PoseHold& controller, const VehicleState& start,
                         const JointSpline& motion, const TrimHoldOptions& options) {
  options.check();
  check_balance(allocation, options);
  Drives drives(allocation, options.voltage);
  PoseHoldState memory;
  AllocationResult given;
  TrimHoldRecord record;
  const PoseTarget target{start.world_from_vehicle, Vec6::Zero()};
  const auto through_water = [&](const VehicleState& state) {
    Vec6 relative = state.velocity;
    relative.head<3>() -= state.world_from_vehicle.linear().transpose() * options.current;
    return relative;
  };

  ArmMotionOptions how;
  how.tip_wrench = options.tip_wrench;
  how.current = options.current;
  how.steps.step = options.step;
  how.wrench = [&](double time, const VehicleState& state) {
    return drives.wrench(time, through_water(state));
  };
  const auto periods = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(options.duration / options.period - 1e-9)));
  VehicleState now = start;
  for (std::int64_t k = 0; k < periods; ++k) {
    const double from = static_cast<double>(k) * options.period;
    const Vec6 wanted = controller.step(memory, now, target, options.current, options.period) -
                        options.expected_wrench.at(from);
    allocation.allocate(wanted, options.voltage, {}, given);
    memory.shortfall = given.achieved - wanted;
    record.saturated = record.saturated || given.saturated;
    drives.command(from, given.command);
    how.steps.start = from;
    how.steps.duration = std::min(options.period, options.duration - from);
    ArmMotionRecord part = simulate_arm_motion(system, now, motion, how);
    now = part.vehicle.state.back();
    for (std::size_t i = k == 0 ? 0 : 1; i < part.vehicle.time.size(); ++i) {
      const VehicleState& state = part.vehicle.state[i];
      record.thrust.push_back(drives.wrench(part.vehicle.time[i], through_water(state)));
    }
    append(part, k == 0 ? 0 : 1, record.motion);
  }
  return record;
}

}  // namespace bathyal
