// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/workspace.hpp"

#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/internal/bodies.hpp"
#include "bathyal/workspace/internal/motion.hpp"

namespace bathyal {

struct Workspace::State {
  Surroundings surroundings;
  workspace::Bodies bodies;
  std::vector<std::string> names;
};

namespace {

std::vector<std::string> names_of(const std::vector<workspace::Obstacle>& obstacles) {
  std::vector<std::string> names;
  for (const workspace::Obstacle& obstacle : obstacles) names.push_back(obstacle.name());
  return names;
}

Clearance clearance_of(const workspace::Bodies& bodies, const workspace::Posture& posture) {
  Clearance found;
  for (const workspace::Pair& pair : bodies.with_obstacles) {
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

}  // namespace

Workspace::Workspace(Arm arm, Surroundings surroundings) {
  workspace::Bodies bodies = workspace::make_bodies(std::move(arm), surroundings);
  std::vector<std::string> names = names_of(bodies.obstacles);
  state_ = std::make_shared<const State>(
      State{std::move(surroundings), std::move(bodies), std::move(names)});
}

const Arm& Workspace::arm() const { return state_->bodies.arm; }
const Surroundings& Workspace::surroundings() const { return state_->surroundings; }
const std::vector<std::string>& Workspace::obstacles() const { return state_->names; }
const std::vector<ExcludedPair>& Workspace::excluded() const { return state_->bodies.excluded; }

std::vector<Clearance> Workspace::clearance(JointView q, int num_threads) const {
  check_joint_values(arm(), q);
  std::vector<Clearance> found(static_cast<std::size_t>(q.rows()));
  parallel_for(found.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    workspace::Posture posture(state_->bodies);
    for (std::size_t i = begin; i < end; ++i) {
      posture.set(
          {q.data() + static_cast<Index>(i) * q.cols(), static_cast<std::size_t>(q.cols())});
      found[i] = clearance_of(state_->bodies, posture);
    }
  });
  return found;
}

MotionCheck Workspace::check_motion(JointView q) const {
  check_joint_values(arm(), q);
  if (q.rows() == 0) throw_argument("q", "one row or more", "none");
  return workspace::first_contact(state_->bodies, q);
}

}  // namespace bathyal
