// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/bodies.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "bathyal/arm/kinematics.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal::workspace {
namespace {

constexpr int kSampledPostures = 64;

void check_link(std::string_view name, int link, const Arm& arm) {
  if (link >= 0 && link < std::ssize(arm.links())) return;
  throw_argument(name, "links from 0 to " + std::to_string(arm.links().size() - 1),
                 std::to_string(link));
}

void check(const Surroundings& surroundings, const Arm& arm) {
  check_rigid("mount", surroundings.vehicle_from_base);
  check_rigid("vehicle_pose", surroundings.world_from_vehicle);
  for (const LinkCapsule& capsule : surroundings.capsules) {
    check_link("capsules", capsule.link, arm);
    check_link("capsules", capsule.start_link, arm);
    Capsule{capsule.start, capsule.end, capsule.radius}.check("capsules");
  }
  for (const auto& [one, other] : surroundings.allowed) {
    check_link("allowed", one, arm);
    check_link("allowed", other, arm);
  }
}

int frame_of(const Arm& arm, const KeepOut& keepout) {
  if (keepout.frame() == "hull") return kVehicleFrame;
  if (keepout.frame() == "world") return kWorldFrame;
  for (std::size_t link = 0; link < arm.links().size(); ++link) {
    if (arm.links()[link].name == keepout.frame()) return static_cast<int>(link);
  }
  throw_argument("keepouts: frame of " + keepout.name(), "\"hull\", \"world\" or a link's name",
                 "\"" + keepout.frame() + "\"");
}

std::vector<Obstacle> obstacles_of(const Surroundings& surroundings, const Arm& arm) {
  std::vector<Obstacle> obstacles;
  if (surroundings.hull) obstacles.emplace_back(*surroundings.hull);
  for (const KeepOut& keepout : surroundings.keepouts) {
    obstacles.emplace_back(keepout, frame_of(arm, keepout));
  }
  if (surroundings.scene) obstacles.emplace_back(*surroundings.scene);
  return obstacles;
}

/// Within the limits; within half a turn, or the arm's length, where there are none.
std::vector<double> drawn_posture(const Arm& arm, RandomStream& random) {
  std::vector<double> q(static_cast<std::size_t>(arm.size()));
  for (const Joint& joint : arm.joints()) {
    if (joint.coordinate < 0 || !joint.follows.empty()) continue;
    const double reach = joint.type == JointType::kPrismatic ? chain_length(arm) : std::numbers::pi;
    const Index k = joint.coordinate;
    q[static_cast<std::size_t>(k)] =
        random.uniform(std::max(arm.lower()[k], -reach), std::min(arm.upper()[k], reach));
  }
  return q;
}

/// Why two links are never compared; empty where they are.
std::string reason_of_links(int one, int other, const Surroundings& surroundings) {
  if (std::abs(one - other) <= 1) return "neighbours";
  const auto& allowed = surroundings.allowed;
  const bool is_allowed = std::ranges::find(allowed, std::pair(one, other)) != allowed.end() ||
                          std::ranges::find(allowed, std::pair(other, one)) != allowed.end();
  return is_allowed ? "allowed" : "";
}

/// Excludes an obstacle or a link, `target`, from comparison with `link`.
void exclude(Bodies& bodies, const ExcludedPair& pair) {
  std::erase_if(bodies.with_obstacles, [&](const Pair& p) {
    return bodies.link_of(p.capsule) == pair.link && std::cmp_equal(p.other, pair.obstacle);
  });
  std::erase_if(bodies.with_capsules, [&](const Pair& p) {
    return bodies.link_of(p.capsule) == pair.link && bodies.link_of(p.other) == pair.other_link;
  });
  bodies.excluded.push_back(pair);
}

/// All pairs but those that a rule leaves out.
void pair_up(Bodies& bodies, const Surroundings& surroundings) {
  for (std::size_t c = 0; c < bodies.capsules.size(); ++c) {
    if (bodies.link_of(c) == 0) continue;
    for (std::size_t o = 0; o < bodies.obstacles.size(); ++o)
      bodies.with_obstacles.push_back({c, o});
    for (std::size_t k = 0; k < bodies.capsules.size(); ++k) {
      if (bodies.link_of(k) < bodies.link_of(c)) bodies.with_capsules.push_back({c, k});
    }
  }
  const int links = static_cast<int>(bodies.arm.links().size());
  for (int link = 1; link < links; ++link) {
    for (int other = 0; other < link; ++other) {
      const std::string reason = reason_of_links(link, other, surroundings);
      if (!reason.empty()) exclude(bodies, {link, other, -1, reason});
    }
    for (std::size_t o = 0; o < bodies.obstacles.size(); ++o) {
      if (bodies.obstacles[o].frame() == link) {
        exclude(bodies, {link, -1, static_cast<int>(o), "fixed to it"});
      }
    }
  }
}

/// What touches in every posture is built so: the arm's first links and the hull they hang on.
void exclude_what_always_touches(Bodies& bodies) {
  std::vector<ExcludedPair> always;
  const auto add = [&](const ExcludedPair& pair) {
    const auto same = [&](const ExcludedPair& p) {
      return p.link == pair.link && p.other_link == pair.other_link && p.obstacle == pair.obstacle;
    };
    if (std::ranges::none_of(always, same)) always.push_back(pair);
  };
  // Keep-outs and the bottom are there to be avoided: what always lies in them is a mistake to see.
  for (const Pair& p : bodies.with_obstacles) {
    if (bodies.obstacles[p.other].name() == "hull") {
      add({bodies.link_of(p.capsule), -1, static_cast<int>(p.other), "touch in every posture"});
    }
  }
  for (const Pair& p : bodies.with_capsules) {
    add({bodies.link_of(p.capsule), bodies.link_of(p.other), -1, "touch in every posture"});
  }
  RandomStream random(0);
  Posture posture(bodies);
  for (int i = 0; i < kSampledPostures && !always.empty(); ++i) {
    posture.set(drawn_posture(bodies.arm, random));
    std::erase_if(always, [&](const ExcludedPair& pair) {
      const auto meets = [&](const Pair& p) {
        if (bodies.link_of(p.capsule) != pair.link) return false;
        if (pair.obstacle < 0) {
          return bodies.link_of(p.other) == pair.other_link && posture.to_capsule(p) <= 0.0;
        }
        return std::cmp_equal(p.other, pair.obstacle) &&
               posture.to_obstacle(p, 0.0).distance <= 0.0;
      };
      return std::ranges::none_of(pair.obstacle < 0 ? bodies.with_capsules : bodies.with_obstacles,
                                  meets);
    });
  }
  for (const ExcludedPair& pair : always) exclude(bodies, pair);
}

}  // namespace

Bodies make_bodies(Arm arm, const Surroundings& surroundings) {
  check(surroundings, arm);
  Bodies bodies{.arm = std::move(arm)};
  bodies.arm.set_base(surroundings.vehicle_from_base);
  bodies.vehicle_from_world = surroundings.world_from_vehicle.inverse();
  bodies.capsules =
      surroundings.capsules.empty() ? capsules_of_rows(bodies.arm) : surroundings.capsules;
  bodies.obstacles = obstacles_of(surroundings, bodies.arm);
  pair_up(bodies, surroundings);
  exclude_what_always_touches(bodies);
  return bodies;
}

void Posture::set(std::span<const double> q) {
  compute_row_frames(bodies_->arm, q, frames_);
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    placed_[i] = placed(bodies_->arm, bodies_->capsules[i], frames_);
  }
}

Nearness Posture::to_obstacle(const Pair& pair, double within) const {
  const Obstacle& obstacle = bodies_->obstacles[pair.other];
  const Capsule& own = placed_[pair.capsule];
  if (obstacle.frame() == kVehicleFrame) return obstacle.nearest(own, within);
  Pose vehicle_from_obstacle = bodies_->vehicle_from_world;
  if (obstacle.frame() >= 0) {
    const auto link = static_cast<std::size_t>(obstacle.frame());
    vehicle_from_obstacle = frames_.world_from_row[link] * bodies_->arm.links()[link].row_from_link;
  }
  Nearness found = obstacle.nearest(in_frame(own, vehicle_from_obstacle.inverse()), within);
  found.axis_point = vehicle_from_obstacle * found.axis_point;
  found.surface_point = vehicle_from_obstacle * found.surface_point;
  return found;
}

}  // namespace bathyal::workspace
