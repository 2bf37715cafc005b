// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/simulate.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/internal/flat_motion.hpp"
#include "bathyal/vehicle/internal/stable_step.hpp"

namespace bathyal {
namespace {

constexpr std::array<const char*, 6> kAxisNames{"surge", "sway", "heave", "roll", "pitch", "yaw"};
constexpr double kMostSteps = 1e8;

class Equations {
 public:
  Equations(const Vehicle& vehicle, const WrenchFunction& wrench, const FlowFunction& flow,
            const SimulateOptions& options)
      : vehicle_(vehicle), wrench_(wrench), flow_(flow), options_(options) {}

  Flow flow(const Vec3& point, double time) const {
    if (flow_) return flow_(point, time);
    return options_.environment ? options_.environment->flow(point, time) : Flow();
  }

  Vec6 wrench(double time, const VehicleState& state, const Flow& flow) const {
    Vec6 sum = wrench_ ? wrench_(time, state) : Vec6(Vec6::Zero());
    if (options_.environment) sum += options_.environment->wrench(vehicle_, state, flow, time);
    return sum;
  }

  vehicle::FlatMotion rate(double time, const vehicle::FlatMotion& flat) const {
    const VehicleState state = vehicle::motion_of(flat);
    const Flow water = flow(state.world_from_vehicle.translation(), time);
    return vehicle::rate_of(
        flat, state,
        vehicle_.acceleration(state, wrench(time, state, water), water, options_.free));
  }

 private:
  const Vehicle& vehicle_;
  const WrenchFunction& wrench_;
  const FlowFunction& flow_;
  const SimulateOptions& options_;
};

vehicle::FlatMotion advanced(const Equations& equations, double time,
                             const vehicle::FlatMotion& flat, double step) {
  const vehicle::FlatMotion k1 = equations.rate(time, flat);
  const vehicle::FlatMotion k2 = equations.rate(time + 0.5 * step, flat + 0.5 * step * k1);
  const vehicle::FlatMotion k3 = equations.rate(time + 0.5 * step, flat + 0.5 * step * k2);
  const vehicle::FlatMotion k4 = equations.rate(time + step, flat + step * k3);
  vehicle::FlatMotion next = flat + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  next.segment<4>(3).normalize();
  return next;
}

/// d(attitude, velocity)/dt at a small turn and a small change of velocity.
Eigen::Matrix<double, 9, 1> change_at(const Vehicle& vehicle, const VehicleState& about,
                                      const Eigen::Matrix<double, 9, 1>& off, const Vec6& wrench,
                                      const Flow& flow, const FreeAxes& free) {
  VehicleState state = about;
  state.world_from_vehicle.linear() =
      vehicle::turned(about.world_from_vehicle.linear(), off.head<3>());
  state.velocity += off.tail<6>();
  Eigen::Matrix<double, 9, 1> change;
  change << Vec3(off.tail<3>()), vehicle.acceleration(state, wrench, flow, free);
  return change;
}

void check_step(const Vehicle& vehicle, const VehicleState& start, const Equations& equations,
                const SimulateOptions& options) {
  const double touching =
      options.environment ? options.environment->largest_step(vehicle) : options.step;
  if (options.step > touching) {
    throw_argument("step", "at most " + to_text(touching) + " s, the limit of contact",
                   to_text(options.step));
  }
  const Flow water = equations.flow(start.world_from_vehicle.translation(), options.start);
  const Vec6 first = equations.wrench(options.start, start, water);
  const FastestMode mode = fastest_mode(vehicle, start, first, water, options.free);
  if (options.step <= mode.step) return;
  throw_argument("step",
                 "at most " + to_text(std::floor(mode.step * 1e6) / 1e6) +
                     " s, the limit of the fastest mode, in " +
                     kAxisNames[static_cast<std::size_t>(mode.axis)],
                 to_text(options.step));
}

}  // namespace

void SimulateOptions::check() const {
  check_not_negative("duration", duration);
  check_positive("step", step);
  check_finite("start", start);
  if (duration / step > kMostSteps) {
    throw_argument("step", "one that makes at most 10⁸ steps of the duration", to_text(step));
  }
}

FastestMode fastest_mode(const Vehicle& vehicle, const VehicleState& state, const Vec6& wrench,
                         const Flow& flow, const FreeAxes& free) {
  Eigen::Matrix<double, 9, 9> slope;
  constexpr double kOff = 1e-6;
  for (int j = 0; j < 9; ++j) {
    Eigen::Matrix<double, 9, 1> off = Eigen::Matrix<double, 9, 1>::Zero();
    off[j] = kOff;
    slope.col(j) = (change_at(vehicle, state, off, wrench, flow, free) -
                    change_at(vehicle, state, -off, wrench, flow, free)) /
                   (2.0 * kOff);
  }
  for (int i = 0; i < 6; ++i) {
    if (free[static_cast<std::size_t>(i)]) continue;
    slope.row(3 + i).setZero();
    slope.col(3 + i).setZero();
  }
  const Eigen::EigenSolver<Eigen::Matrix<double, 9, 9>> modes(slope);
  const Vec6 weights = vehicle.mass_matrix().diagonal().cwiseSqrt();  // by energy
  FastestMode fastest;
  fastest.step = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 9; ++k) {
    const std::complex<double> rate = modes.eigenvalues()[k];
    const double step = vehicle::largest_step(rate);
    if (!(step < fastest.step)) continue;
    fastest.step = step;
    fastest.rate = std::abs(rate);
    modes.eigenvectors().col(k).tail<6>().cwiseAbs().cwiseProduct(weights).maxCoeff(&fastest.axis);
  }
  return fastest;
}

VehicleMotionRecord simulate(const Vehicle& vehicle, const VehicleState& start,
                             const WrenchFunction& wrench, const FlowFunction& flow,
                             const SimulateOptions& options) {
  options.check();
  check_rigid("state", start.world_from_vehicle);
  if (!start.velocity.allFinite()) throw_argument("state", "a finite velocity", "another");
  const Equations equations(vehicle, wrench, flow, options);
  check_step(vehicle, start, equations, options);
  const auto count = static_cast<std::int64_t>(std::ceil(options.duration / options.step - 1e-9));
  VehicleMotionRecord record;
  vehicle::FlatMotion flat = vehicle::flat_of(start);
  record.time.push_back(options.start);
  record.state.push_back(start);
  for (std::int64_t k = 0; k < count; ++k) {
    const double from = options.start + static_cast<double>(k) * options.step;
    const double to = k + 1 == count ? options.start + options.duration
                                     : options.start + static_cast<double>(k + 1) * options.step;
    flat = advanced(equations, from, flat, to - from);
    if (!flat.allFinite()) {
      throw Error("the motion runs away at " + to_text(to) + " s: its numbers are not finite");
    }
    record.time.push_back(to);
    record.state.push_back(vehicle::motion_of(flat));
  }
  return record;
}

}  // namespace bathyal
