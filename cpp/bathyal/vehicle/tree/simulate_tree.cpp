// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/tree/simulate_tree.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/internal/flat_motion.hpp"
#include "bathyal/vehicle/internal/stable_step.hpp"

namespace bathyal {
namespace {

constexpr double kMostTreeSteps = 1e8;
void check_joint_count(std::string_view name, std::size_t count, std::size_t expected) {
  if (count == expected) return;
  throw_argument(name, std::to_string(expected) + " numbers", std::to_string(count));
}

/// d(attitude, velocity, q, rate)/dt at a small change of these.
Eigen::VectorXd change_at(const BodyTree& tree, BodyTreeState state, const TreeLoads& loads,
                          const Eigen::VectorXd& off) {
  const auto n = static_cast<Index>(tree.size());
  state.base.world_from_vehicle.linear() =
      vehicle::turned(state.base.world_from_vehicle.linear(), off.head<3>());
  state.base.velocity += off.segment<6>(3);
  Eigen::Map<Eigen::VectorXd>(state.q.data(), n) += off.segment(9, n);
  Eigen::Map<Eigen::VectorXd>(state.rate.data(), n) += off.tail(n);
  TreeAcceleration found;
  tree.accelerations(state, loads, found);
  Eigen::VectorXd change(off.size());
  change << off.segment<3>(6), found.base, off.tail(n),
      Eigen::Map<const Eigen::VectorXd>(found.joints.data(), n);
  return change;
}

}  // namespace

TreeIntegrator::TreeIntegrator(BodyTree tree, TreeLoadsFunction loads,
                               TreeJointMotionFunction motion)
    : tree_(std::move(tree)),
      loads_(std::move(loads)),
      motion_(std::move(motion)),
      state_(tree_.rest()) {}

const TreeLoads& TreeIntegrator::at(double time, BodyTreeState& state) {
  if (motion_) {
    motion_(time, motion_now_);
    check_joint_count("q", motion_now_.q.size(), tree_.size());
    check_joint_count("rate", motion_now_.rate.size(), tree_.size());
    check_joint_count("acceleration", motion_now_.acceleration.size(), tree_.size());
    state.q = motion_now_.q;
    state.rate = motion_now_.rate;
  }
  if (loads_) loads_(time, state, loads_now_);
  if (motion_) {
    loads_now_.drive = JointDrive::kAcceleration;
    loads_now_.joints = motion_now_.acceleration;
  }
  return loads_now_;
}

void TreeIntegrator::set_state(const Numbers& flat) {
  const auto n = static_cast<Index>(tree_.size());
  state_.base = vehicle::motion_of(flat.head<13>());
  if (motion_) return;
  Eigen::Map<Eigen::VectorXd>(state_.q.data(), n) = flat.segment(13, n);
  Eigen::Map<Eigen::VectorXd>(state_.rate.data(), n) = flat.tail(n);
}

TreeIntegrator::Numbers TreeIntegrator::rate(double time, const Numbers& flat) {
  set_state(flat);
  tree_.accelerations(state_, at(time, state_), found_);
  const auto n = static_cast<Index>(tree_.size());
  Numbers change = Numbers::Zero(flat.size());
  change.head<13>() = vehicle::rate_of(flat.head<13>(), state_.base, found_.base);
  if (!motion_) {
    change.segment(13, n) = flat.tail(n);
    change.tail(n) = Eigen::Map<const Eigen::VectorXd>(found_.joints.data(), n);
  }
  return change;
}

void TreeIntegrator::step(double time, double step, BodyTreeState& state) {
  const auto n = static_cast<Index>(tree_.size());
  Numbers flat(13 + 2 * n);
  flat << vehicle::flat_of(state.base), Eigen::Map<const Eigen::VectorXd>(state.q.data(), n),
      Eigen::Map<const Eigen::VectorXd>(state.rate.data(), n);
  const Numbers k1 = rate(time, flat);
  const Numbers k2 = rate(time + 0.5 * step, flat + 0.5 * step * k1);
  const Numbers k3 = rate(time + 0.5 * step, flat + 0.5 * step * k2);
  const Numbers k4 = rate(time + step, flat + step * k3);
  flat += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  if (!flat.allFinite()) {
    throw Error("the motion runs away at " + to_text(time + step) +
                " s: its numbers are not finite");
  }
  set_state(flat);
  at(time + step, state_);
  state = state_;
}

void SimulateTreeOptions::check() const {
  check_not_negative("duration", duration);
  check_positive("step", step);
  check_finite("start", start);
  if (duration / step > kMostTreeSteps) {
    throw_argument("step", "one that makes at most 10⁸ steps of the duration", to_text(step));
  }
}

double largest_stable_step(const BodyTree& tree, const BodyTreeState& state, const TreeLoads& loads,
                           bool joints_held) {
  constexpr double kOff = 1e-6;
  const auto all = static_cast<Index>(9 + 2 * tree.size());
  const Index moving = joints_held ? 9 : all;
  Eigen::MatrixXd slope(moving, moving);
  for (Index j = 0; j < moving; ++j) {
    Eigen::VectorXd off = Eigen::VectorXd::Zero(all);
    off[j] = kOff;
    slope.col(j) =
        (change_at(tree, state, loads, off) - change_at(tree, state, loads, -off)).head(moving) /
        (2.0 * kOff);
  }
  double least = std::numeric_limits<double>::infinity();
  const Eigen::VectorXcd rates = slope.eigenvalues();
  for (const std::complex<double>& rate : rates)
    least = std::min(least, vehicle::largest_step(rate));
  return least;
}

TreeMotionRecord simulate_tree(const BodyTree& tree, const BodyTreeState& start,
                               const TreeLoadsFunction& loads,
                               const TreeJointMotionFunction& motion,
                               const SimulateTreeOptions& options) {
  options.check();
  check_rigid("state", start.base.world_from_vehicle);
  if (!start.base.velocity.allFinite()) throw_argument("state", "a finite velocity", "another");
  check_joint_count("q", start.q.size(), tree.size());
  check_joint_count("rate", start.rate.size(), tree.size());
  TreeIntegrator integrator(tree, loads, motion);
  BodyTreeState now = start;
  const TreeLoads& first = integrator.at(options.start, now);
  const double stable = largest_stable_step(tree, now, first, bool(motion));
  if (options.step > stable) {
    throw_argument(
        "step",
        "at most " + to_text(std::floor(stable * 1e6) / 1e6) + " s, the limit of the fastest mode",
        to_text(options.step));
  }
  TreeMotionRecord record{{options.start}, {now}};
  const auto count = static_cast<std::int64_t>(std::ceil(options.duration / options.step - 1e-9));
  for (std::int64_t k = 0; k < count; ++k) {
    const double from = options.start + static_cast<double>(k) * options.step;
    const double to = k + 1 == count ? options.start + options.duration
                                     : options.start + static_cast<double>(k + 1) * options.step;
    integrator.step(from, to - from, now);
    record.time.push_back(to);
    record.state.push_back(now);
  }
  return record;
}

}  // namespace bathyal
