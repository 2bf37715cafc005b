// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/vehicle_wrench.hpp"

#include <algorithm>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/sampling/internal/moved_bodies.hpp"

namespace bathyal {
namespace {

using workspace::MovedBodies;
using workspace::Screw;

constexpr std::size_t kWrenchGrain = 128;  ///< postures of one task

std::span<const double> row_of(const JointView& q, std::size_t i) {
  const auto size = static_cast<std::size_t>(q.cols());
  return {q.data() + i * size, size};
}

std::span<const double> row_of(const JointMatrix* rates, std::size_t i) {
  return rates == nullptr ? std::span<const double>{} : row_of(view_of(*rates), i);
}

void write(const Screw& screw, double* six) {
  Eigen::Map<Vec3>{six} = screw.linear;
  Eigen::Map<Vec3>{six + 3} = screw.angular;
}

void check_rates(const char* name, const JointView& rates, const JointView& q) {
  if (rates.rows() != q.rows() || rates.cols() != q.cols()) {
    throw_argument(
        name, "rows as q has, (" + std::to_string(q.rows()) + ", " + std::to_string(q.cols()) + ")",
        "(" + std::to_string(rates.rows()) + ", " + std::to_string(rates.cols()) + ")");
  }
  if (!rates.allFinite()) throw_argument(name, "finite numbers", "nan or inf");
}

void check_counts(const JointView& q, const Wrenches& contact, const WrenchOptions& options) {
  const std::string one_or_each = "one, or " + std::to_string(q.rows()) + ", one a row of q";
  if (contact.rows() > 1 && contact.rows() != q.rows()) {
    throw_argument("contact", one_or_each, std::to_string(contact.rows()));
  }
  if (!contact.allFinite()) throw_argument("contact", "finite numbers", "nan or inf");
  const std::size_t times = options.time.size();
  if (times > 1 && times != static_cast<std::size_t>(q.rows())) {
    throw_argument("time", one_or_each, std::to_string(times));
  }
  if (options.velocity != nullptr) check_rates("velocity", view_of(*options.velocity), q);
  if (options.acceleration != nullptr) {
    check_rates("acceleration", view_of(*options.acceleration), q);
  }
}

/// The number of row i, of none (0), one for all, or one a row.
double at_row(std::span<const double> values, std::size_t i) {
  return values.empty() ? 0.0 : values[values.size() == 1 ? 0 : i];
}

void add_contact(const Wrenches& contact, std::size_t i, const Vec3& tip, Screw& wrench) {
  if (contact.rows() == 0) return;
  const auto row = static_cast<Index>(contact.rows() == 1 ? 0 : i);
  wrench.add(contact.row(row).head<3>().transpose(), tip);
  wrench.angular += contact.row(row).tail<3>().transpose();
}

}  // namespace

void WrenchOptions::check() const {
  if (!gravity.allFinite()) throw_argument("gravity", "finite numbers", "nan or inf");
  check_not_negative("water_density", water_density);
  for (const double moment : time) check_finite("time", moment);
}

std::vector<double> vehicle_wrench(const Arm& arm, const RigidBody& attached,
                                   const Trajectory& world_from_vehicle, JointView q,
                                   Wrenches contact, const WrenchOptions& options) {
  check_joint_values(arm, q);
  attached.check("attached");
  options.check();
  check_counts(q, contact, options);
  const auto rows = static_cast<std::size_t>(q.rows());
  const bool moving = options.velocity != nullptr || options.acceleration != nullptr;
  std::vector<double> wrenches(6 * rows);
  parallel_for(rows, kWrenchGrain, options.num_threads, [&](std::size_t begin, std::size_t end) {
    MovedBodies bodies(arm, attached);
    for (std::size_t i = begin; i < end; ++i) {
      bodies.set(row_of(q, i));
      const Pose pose = world_from_vehicle.at(at_row(options.time, i));
      const Vec3 gravity = pose.linear().transpose() * options.gravity;
      Screw wrench = bodies.weight(gravity, options.water_density);
      add_contact(contact, i, bodies.frames().world_from_tool.translation(), wrench);
      if (moving) {
        const Screw rate =
            bodies.momentum_rate(row_of(options.velocity, i), row_of(options.acceleration, i));
        wrench.linear -= rate.linear;
        wrench.angular -= rate.angular;
      }
      write(wrench, &wrenches[6 * i]);
    }
  });
  return wrenches;
}

std::vector<double> vehicle_wrench(const Workspace& workspace, JointView q, Wrenches contact,
                                   const WrenchOptions& options) {
  return vehicle_wrench(workspace.arm(), workspace.attached(),
                        workspace.surroundings().world_from_vehicle, q, contact, options);
}

std::vector<double> arm_momentum(const Workspace& workspace, JointView q, JointView velocity,
                                 int num_threads) {
  check_joint_values(workspace.arm(), q);
  check_rates("velocity", velocity, q);
  const auto rows = static_cast<std::size_t>(q.rows());
  std::vector<double> momenta(6 * rows);
  parallel_for(rows, kWrenchGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    MovedBodies bodies(workspace.arm(), workspace.attached());
    for (std::size_t i = begin; i < end; ++i) {
      bodies.set(row_of(q, i));
      write(bodies.momentum(row_of(velocity, i)), &momenta[6 * i]);
    }
  });
  return momenta;
}

JointRates joint_rates(JointView q, std::span<const double> time) {
  const Index rows = q.rows();
  if (static_cast<Index>(time.size()) != rows) {
    throw_argument("time", std::to_string(rows) + " values, one a row of q",
                   std::to_string(time.size()));
  }
  for (std::size_t i = 0; i < time.size(); ++i) {
    check_finite("time", time[i]);
    if (i > 0 && !(time[i] > time[i - 1])) {
      throw_argument("time", "rising values", to_text(time[i]) + " after " + to_text(time[i - 1]));
    }
  }
  JointRates rates{JointMatrix::Zero(rows, q.cols()), JointMatrix::Zero(rows, q.cols())};
  Eigen::RowVectorXd before = Eigen::RowVectorXd::Zero(q.cols());
  double interval_before = 0.0;
  for (Index i = 0; i < rows; ++i) {
    const bool last = i + 1 == rows;
    const auto at = static_cast<std::size_t>(i);
    const double interval = last ? 0.0 : time[at + 1] - time[at];
    Eigen::RowVectorXd after = Eigen::RowVectorXd::Zero(q.cols());
    if (!last) after = (q.row(i + 1) - q.row(i)) / interval;
    const double both = interval_before + interval;
    if (both > 0.0) {
      // At the ends the weight of the motion is 0: the arm rests there.
      rates.velocity.row(i) = (interval * before + interval_before * after) / both;
      rates.acceleration.row(i) = 2.0 * (after - before) / both;
    }
    before = after;
    interval_before = interval;
  }
  return rates;
}

}  // namespace bathyal
