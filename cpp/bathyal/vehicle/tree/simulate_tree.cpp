// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/tree/simulate_tree.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/internal/flat_motion.hpp"
#include "bathyal/vehicle/internal/stable_step.hpp"

namespace bathyal {
namespace {

constexpr double kMostTreeSteps = 1e8;
constexpr int kMostNumbers = 13 + 2 * static_cast<int>(BodyTree::kMostLinks);

/// Of the hull, then coordinates, then rates.
using TreeNumbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostNumbers, 1>;

void check_joint_count(std::string_view name, std::size_t count, std::size_t expected) {
  if (count == expected) return;
  throw_argument(name, std::to_string(expected) + " numbers", std::to_string(count));
}

/// One state and load, filled anew at each stage.
class TreeEquations {
 public:
  TreeEquations(const BodyTree& tree, const TreeLoadsFunction& loads,
                const JointMotionFunction& motion)
      : tree_(tree), loads_(loads), motion_(motion), state_(tree.rest()) {}

  const TreeState& state(double time, const TreeNumbers& flat) {
    const auto n = static_cast<Index>(tree_.size());
    state_.base = vehicle::motion_of(flat.head<13>());
    if (motion_) {
      motion_(time, joint_motion_);
      check_joint_count("q", joint_motion_.q.size(), tree_.size());
      check_joint_count("rate", joint_motion_.rate.size(), tree_.size());
      check_joint_count("acceleration", joint_motion_.acceleration.size(), tree_.size());
      std::copy(joint_motion_.q.begin(), joint_motion_.q.end(), state_.q.begin());
      std::copy(joint_motion_.rate.begin(), joint_motion_.rate.end(), state_.rate.begin());
    } else {
      Eigen::Map<Eigen::VectorXd>(state_.q.data(), n) = flat.segment(13, n);
      Eigen::Map<Eigen::VectorXd>(state_.rate.data(), n) = flat.tail(n);
    }
    return state_;
  }

  /// Of the state that was asked for last.
  const TreeLoads& loads(double time) {
    if (loads_) loads_(time, state_, loads_now_);
    if (motion_) {
      loads_now_.drive = JointDrive::kAcceleration;
      loads_now_.joints.assign(joint_motion_.acceleration.begin(),
                               joint_motion_.acceleration.end());
    }
    return loads_now_;
  }

  TreeNumbers rate(double time, const TreeNumbers& flat) {
    state(time, flat);
    tree_.accelerations(state_, loads(time), found_);
    const auto n = static_cast<Index>(tree_.size());
    TreeNumbers change = TreeNumbers::Zero(flat.size());
    change.head<13>() = vehicle::rate_of(flat.head<13>(), state_.base, found_.base);
    if (!motion_) {
      change.segment(13, n) = flat.tail(n);
      change.tail(n) = Eigen::Map<const Eigen::VectorXd>(found_.joints.data(), n);
    }
    return change;
  }

 private:
  const BodyTree& tree_;
  const TreeLoadsFunction& loads_;
  const JointMotionFunction& motion_;
  TreeState state_;
  TreeLoads loads_now_;
  JointMotion joint_motion_;
  TreeAcceleration found_;
};

TreeNumbers flat_of(const TreeState& state) {
  const auto n = static_cast<Index>(state.q.size());
  TreeNumbers flat(13 + 2 * n);
  flat << vehicle::flat_of(state.base), Eigen::Map<const Eigen::VectorXd>(state.q.data(), n),
      Eigen::Map<const Eigen::VectorXd>(state.rate.data(), n);
  return flat;
}

TreeNumbers advanced(TreeEquations& equations, double time, const TreeNumbers& flat, double step) {
  const TreeNumbers k1 = equations.rate(time, flat);
  const TreeNumbers k2 = equations.rate(time + 0.5 * step, flat + 0.5 * step * k1);
  const TreeNumbers k3 = equations.rate(time + 0.5 * step, flat + 0.5 * step * k2);
  const TreeNumbers k4 = equations.rate(time + step, flat + step * k3);
  TreeNumbers next = flat + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  next.segment<4>(3).normalize();
  return next;
}

/// d(attitude, velocity, q, rate)/dt at a small change of these.
Eigen::VectorXd change_at(const BodyTree& tree, TreeState state, const TreeLoads& loads,
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

void SimulateTreeOptions::check() const {
  check_not_negative("duration", duration);
  check_positive("step", step);
  check_finite("start", start);
  if (duration / step > kMostTreeSteps) {
    throw_argument("step", "one that makes at most 10⁸ steps of the duration", to_text(step));
  }
}

double largest_stable_step(const BodyTree& tree, const TreeState& state, const TreeLoads& loads,
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

TreeMotionRecord simulate_tree(const BodyTree& tree, const TreeState& start,
                               const TreeLoadsFunction& loads, const JointMotionFunction& motion,
                               const SimulateTreeOptions& options) {
  options.check();
  check_rigid("state", start.base.world_from_vehicle);
  if (!start.base.velocity.allFinite()) throw_argument("state", "a finite velocity", "another");
  check_joint_count("q", start.q.size(), tree.size());
  check_joint_count("rate", start.rate.size(), tree.size());
  TreeEquations equations(tree, loads, motion);
  TreeNumbers flat = flat_of(start);
  TreeMotionRecord record;
  record.time.push_back(options.start);
  record.state.push_back(equations.state(options.start, flat));
  const double stable =
      largest_stable_step(tree, record.state[0], equations.loads(options.start), bool(motion));
  if (options.step > stable) {
    throw_argument(
        "step",
        "at most " + to_text(std::floor(stable * 1e6) / 1e6) + " s, the limit of the fastest mode",
        to_text(options.step));
  }
  const auto count = static_cast<std::int64_t>(std::ceil(options.duration / options.step - 1e-9));
  for (std::int64_t k = 0; k < count; ++k) {
    const double from = options.start + static_cast<double>(k) * options.step;
    const double to = k + 1 == count ? options.start + options.duration
                                     : options.start + static_cast<double>(k + 1) * options.step;
    flat = advanced(equations, from, flat, to - from);
    if (!flat.allFinite()) {
      throw Error("the motion runs away at " + to_text(to) + " s: its numbers are not finite");
    }
    record.time.push_back(to);
    record.state.push_back(equations.state(to, flat));
  }
  return record;
}

}  // namespace bathyal
