// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/workspace.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/internal/bodies.hpp"
#include "bathyal/workspace/internal/motion.hpp"
#include "bathyal/workspace/internal/target.hpp"

namespace bathyal {

struct Workspace::State {
  Surroundings surroundings;
  workspace::Bodies bodies;
  std::vector<std::string> names;
  std::vector<std::string> warnings;
  std::size_t own_capsules = 0;  ///< of the arm; what is attached comes behind
  std::vector<Capsule> attached_capsules;
  RigidBody attached;
};

namespace {

std::vector<std::string> names_of(const std::vector<workspace::Obstacle>& obstacles) {
  std::vector<std::string> names;
  for (const workspace::Obstacle& obstacle : obstacles) {
    std::string name = obstacle.name();
    for (int k = 2; std::ranges::find(names, name) != names.end(); ++k) {
      name = obstacle.name() + "_" + std::to_string(k);
    }
    names.push_back(std::move(name));
  }
  return names;
}

Clearance clearance_of(const workspace::Bodies& bodies, const workspace::Posture& posture,
                       TipContact tip_contact) {
  Clearance found;
  for (const workspace::Pair& pair : bodies.obstacle_pairs(tip_contact)) {
    const workspace::Nearness near = posture.to_obstacle(pair, found.distance);
    if (!(near.distance < found.distance)) continue;
    found.distance = near.distance;
    found.link = bodies.link_of(pair.capsule);
    found.obstacle = static_cast<int>(pair.other);
    found.axis_point = near.axis_point;
    found.obstacle_point = near.surface_point;
  }
  for (const workspace::Pair& pair : bodies.with_capsules) {
    const double apart = posture.to_capsule(pair);
    if (!(apart < found.self_distance)) continue;
    found.self_distance = apart;
    found.self_links = {bodies.link_of(pair.capsule), bodies.link_of(pair.other)};
  }
  return found;
}

void check_times(std::span<const double> time, std::size_t rows) {
  if (time.size() > 1 && time.size() != rows) {
    throw_argument("time", "one time, or one for each of " + std::to_string(rows) + " rows",
                   std::to_string(time.size()));
  }
  for (const double value : time) check_finite("time", value);
}

/// Of a motion: each row's, rising.
void check_motion_times(std::span<const double> time, std::size_t rows) {
  if (time.size() != rows) {
    throw_argument("time", "one for each of " + std::to_string(rows) + " rows",
                   std::to_string(time.size()));
  }
  check_times(time, rows);
  for (std::size_t i = 1; i < rows; ++i) {
    if (!(time[i] > time[i - 1])) {
      throw_argument("time", "rising times", to_text(time[i]) + " in row " + std::to_string(i));
    }
  }
}

std::vector<double> checked_acceleration(const Arm& arm, std::span<const double> given) {
  if (given.empty()) return default_acceleration(arm);
  if (std::cmp_not_equal(given.size(), arm.size())) {
    throw_argument("acceleration", std::to_string(arm.size()) + " values",
                   std::to_string(given.size()));
  }
  for (const double value : given) check_positive("acceleration", value);
  return {given.begin(), given.end()};
}

bool has_moving_obstacle(const workspace::Bodies& bodies) {
  return std::ranges::any_of(bodies.obstacles,
                             [](const auto& obstacle) { return obstacle.motion().moves(); });
}

bool has_world_obstacle(const workspace::Bodies& bodies) {
  return std::ranges::any_of(bodies.obstacles, [](const auto& obstacle) {
    return obstacle.frame() == workspace::kWorldFrame;
  });
}

/// With the capsules given put on the last link, from the tool's frame.
Surroundings with_capsules(const Arm& arm, Surroundings surroundings, std::size_t own,
                           const std::vector<Capsule>& attached) {
  surroundings.capsules.resize(own);
  const Pose link_from_tool = workspace::link_from_tool(arm);
  const int last = static_cast<int>(arm.links().size()) - 1;
  for (const Capsule& capsule : attached) {
    const Capsule placed = in_frame(capsule, link_from_tool);
    surroundings.capsules.push_back({last, last, placed.start, placed.end, placed.radius});
  }
  return surroundings;
}

}  // namespace

Workspace::Workspace(Arm arm, Surroundings surroundings) {
  if (surroundings.capsules.empty()) surroundings.capsules = capsules_of_rows(arm);
  const std::size_t own = surroundings.capsules.size();
  workspace::Bodies bodies = workspace::make_bodies(std::move(arm), surroundings);
  std::vector<std::string> names = names_of(bodies.obstacles);
  std::vector<std::string> warnings = workspace::plausibility(bodies);
  state_ = std::make_shared<const State>(State{std::move(surroundings),
                                               std::move(bodies),
                                               std::move(names),
                                               std::move(warnings),
                                               own,
                                               {},
                                               {}});
}

const Arm& Workspace::arm() const { return state_->bodies.arm; }
const Surroundings& Workspace::surroundings() const { return state_->surroundings; }
const std::vector<std::string>& Workspace::obstacles() const { return state_->names; }
const std::vector<ExcludedPair>& Workspace::excluded() const { return state_->bodies.excluded; }
const std::vector<std::string>& Workspace::warnings() const { return state_->warnings; }
const RigidBody& Workspace::attached() const { return state_->attached; }
const std::vector<Capsule>& Workspace::attached_capsules() const {
  return state_->attached_capsules;
}

bool Workspace::moves() const {
  return has_moving_obstacle(state_->bodies) ||
         (state_->surroundings.world_from_vehicle.moves() && has_world_obstacle(state_->bodies));
}

std::vector<Clearance> Workspace::clearance(JointView q, std::span<const double> time,
                                            TipContact tip_contact, int num_threads) const {
  check_joint_values(arm(), q);
  const auto rows = static_cast<std::size_t>(q.rows()), size = static_cast<std::size_t>(q.cols());
  check_times(time, rows);
  std::vector<Clearance> found(rows);
  parallel_for(rows, 1, num_threads, [&](std::size_t begin, std::size_t end) {
    workspace::Posture posture(state_->bodies, state_->surroundings.world_from_vehicle);
    for (std::size_t i = begin; i < end; ++i) {
      const double at = time.empty() ? 0.0 : time[time.size() == 1 ? 0 : i];
      posture.set({q.data() + i * size, size}, at);
      found[i] = clearance_of(state_->bodies, posture, tip_contact);
    }
  });
  return found;
}

MotionCheck Workspace::check_motion(JointView q, const MotionOptions& options) const {
  check_joint_values(arm(), q);
  if (q.rows() == 0) throw_argument("q", "one row or more", "none");
  MotionOptions complete = options;
  if (!options.time.empty()) check_motion_times(options.time, static_cast<std::size_t>(q.rows()));
  if (options.time.empty() && (options.stopping || moves())) {
    throw_argument("time",
                   options.stopping ? "the time of each row, which stopping depends on"
                                    : "the time of each row, since something moves",
                   "none");
  }
  std::vector<double> acceleration;
  if (options.stopping) {
    acceleration = checked_acceleration(arm(), options.acceleration);
    complete.acceleration = acceleration;
  }
  return workspace::first_contact(state_->bodies, state_->surroundings.world_from_vehicle, q,
                                  complete);
}

std::vector<TargetCheck> Workspace::check_target(PointView points, double time, std::uint64_t seed,
                                                 int num_threads) const {
  check_finite("time", time);
  check_points_finite("points", points);
  return workspace::check_targets(*this, state_->bodies, points, {time, seed, num_threads});
}

std::vector<Capsule> Workspace::placed_capsules(JointView q) const {
  check_joint_values(arm(), q);
  std::vector<Capsule> capsules;
  RowFrames frames;
  for (Index i = 0; i < q.rows(); ++i) {
    compute_row_frames(arm(), {q.data() + i * q.cols(), static_cast<std::size_t>(q.cols())},
                       frames);
    for (const LinkCapsule& capsule : state_->surroundings.capsules) {
      capsules.push_back(placed(arm(), capsule, frames));
    }
  }
  return capsules;
}

Workspace Workspace::with_vehicle_pose(Trajectory world_from_vehicle) const {
  State moved = *state_;
  moved.surroundings.world_from_vehicle = std::move(world_from_vehicle);
  Workspace workspace = *this;
  workspace.state_ = std::make_shared<const State>(std::move(moved));
  return workspace;
}

Workspace Workspace::with_tip_depth(double tip_depth) const {
  State deeper = *state_;
  deeper.surroundings.tip_depth = tip_depth;
  deeper.bodies = workspace::make_bodies(deeper.bodies.arm, deeper.surroundings);
  Workspace workspace = *this;
  workspace.state_ = std::make_shared<const State>(std::move(deeper));
  return workspace;
}

Workspace Workspace::attach(std::span<const Capsule> capsules, const RigidBody& body) const {
  body.check("body");
  for (const Capsule& capsule : capsules) capsule.check("capsules");
  State held = *state_;
  held.attached_capsules.insert(held.attached_capsules.end(), capsules.begin(), capsules.end());
  held.attached = combined(held.attached, body);
  held.surroundings =
      with_capsules(arm(), std::move(held.surroundings), held.own_capsules, held.attached_capsules);
  held.bodies = workspace::make_bodies(held.bodies.arm, held.surroundings);
  Workspace workspace = *this;
  workspace.state_ = std::make_shared<const State>(std::move(held));
  return workspace;
}

Workspace Workspace::detach() const {
  const RigidBody& held = state_->attached;
  if (state_->attached_capsules.empty() && held.mass == 0.0 && held.volume == 0.0) {
    throw_argument("detach", "a workspace with something attached", "none");
  }
  State empty = *state_;
  empty.attached_capsules.clear();
  empty.attached = {};
  empty.surroundings = with_capsules(arm(), std::move(empty.surroundings), empty.own_capsules, {});
  empty.bodies = workspace::make_bodies(empty.bodies.arm, empty.surroundings);
  Workspace workspace = *this;
  workspace.state_ = std::make_shared<const State>(std::move(empty));
  return workspace;
}

std::vector<double> default_acceleration(const Arm& arm) {
  constexpr double kRiseTime = 0.5;                 // [s]
  constexpr double kTurning = 1.0, kSliding = 0.5;  // [rad/s²], [m/s²], without a rate limit
  std::vector<double> acceleration(static_cast<std::size_t>(arm.size()), kTurning);
  for (const Joint& joint : arm.joints()) {
    if (joint.coordinate < 0 || !joint.follows.empty()) continue;
    const double unlimited = joint.type == JointType::kPrismatic ? kSliding : kTurning;
    acceleration[static_cast<std::size_t>(joint.coordinate)] =
        std::isfinite(joint.velocity) && joint.velocity > 0.0 ? joint.velocity / kRiseTime
                                                              : unlimited;
  }
  return acceleration;
}

}  // namespace bathyal
