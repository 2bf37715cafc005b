// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/internal/sampling_loads.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/workspace/sampling/vehicle_wrench.hpp"

namespace bathyal::workspace {
namespace {

std::vector<Pose> poses_of(const Arm& arm, const JointMatrix& q, int num_threads) {
  const std::vector<double> values = forward(arm, view_of(q), num_threads);
  std::vector<Pose> poses(static_cast<std::size_t>(q.rows()));
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = pose_of_rows(&values[16 * i]);
  return poses;
}

/// Of the bottom on the tip, against the direction [N].
double push_of(const Pose& tip, const SamplingSite& site, const SamplingOptions& options) {
  const double penetration = (tip.translation() - site.contact).dot(site.aim.direction);
  return std::min(options.force_limit, options.stiffness * std::max(0.0, penetration));
}

std::vector<double> wrench_of(const Workspace& ws, const SamplingPhase& phase,
                              const std::vector<double>& push, const Vec3& direction,
                              const SamplingOptions& sampling) {
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> contact(phase.q.rows(), 6);
  contact.setZero();
  for (std::size_t i = 0; i < push.size(); ++i) {
    contact.row(static_cast<Index>(i)).head<3>() = -push[i] * direction.transpose();
  }
  WrenchOptions options;
  options.gravity = sampling.gravity;
  options.water_density = sampling.water_density;
  options.time = {&sampling.time, 1};
  options.num_threads = sampling.num_threads;
  JointRates rates;
  if (sampling.inertia) {
    rates = joint_rates(view_of(phase.q), phase.time);
    options.velocity = &rates.velocity;
    options.acceleration = &rates.acceleration;
  }
  return vehicle_wrench(ws, view_of(phase.q), Wrenches(contact.data(), contact.rows(), 6), options);
}

/// What comes after the first `skip` values.
void append(const std::vector<double>& values, std::size_t skip, std::vector<double>& all) {
  all.insert(all.end(), values.begin() + static_cast<std::ptrdiff_t>(skip), values.end());
}

}  // namespace

void add_phases(const SamplingSearch& search, const SamplingOptions& options, SamplingPlan& plan) {
  double start = options.time;
  for (std::size_t i = 0; i < search.legs().size(); ++i) {
    const SamplingLeg& leg = search.legs()[i];
    const Workspace& ws = search.held(i);
    SamplingPhase phase;
    phase.name = leg.name;
    phase.q = leg.motion.q;
    phase.time = leg.motion.time;
    for (double& time : phase.time) time += start;
    start = phase.time.back();
    phase.tip = poses_of(ws.arm(), phase.q, options.num_threads);
    phase.retreat = leg.retreat.q;
    phase.retreat_time = leg.retreat.time;
    const std::size_t shared = i == 0 ? 0 : 1;  // rows with the phase before
    phase.first = plan.time.size() - shared;
    const bool in_bottom = i == kPress || i == kGrab || i == kLift;
    std::vector<double> push(phase.time.size(), 0.0);
    if (in_bottom) {
      std::ranges::transform(phase.tip, push.begin(),
                             [&](const Pose& tip) { return push_of(tip, search.site(), options); });
    }
    append(phase.time, shared, plan.time);
    append(push, shared, plan.contact_force);
    append(wrench_of(ws, phase, push, search.site().aim.direction, options), 6 * shared,
           plan.wrench);
    plan.phases.push_back(std::move(phase));
  }
}

}  // namespace bathyal::workspace
