// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/bodies.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "bathyal/arm/kinematics.hpp"
#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/workspace/internal/postures.hpp"

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
  for (const double value : surroundings.vehicle_pose_std) {
    check_not_negative("vehicle_pose_std", value);
  }
  check_not_negative("tip_depth", surroundings.tip_depth);
  if (surroundings.vehicle_body) surroundings.vehicle_body->check("vehicle_body");
  for (const LinkCapsule& capsule : surroundings.capsules) {
    check_link("capsules", capsule.link, arm);
    check_link("capsules", capsule.start_link, arm);
    Capsule{capsule.start, capsule.end, capsule.radius}.check("capsules");
  }
  for (const auto& [one, other] : surroundings.allowed) {
    check_link("allowed", one, arm);
    check_link("allowed", other, arm);
    if (one == other)
      throw_argument("allowed", "two different links", link_name(arm, one) + " twice");
  }
}

int frame_of(const Arm& arm, const KeepOut& keepout) {
  if (keepout.frame() == "hull") return kVehicleFrame;
  if (keepout.frame() == "world") return kWorldFrame;
  for (int link = 0; link < std::ssize(arm.links()); ++link) {
    if (link_name(arm, link) == keepout.frame()) return link;
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
  for (std::size_t o = 0; o < bodies.obstacles.size(); ++o) {
    bodies.excluded.push_back({0, -1, static_cast<int>(o), "foot"});
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
    if (bodies.obstacles[p.other].is_hull()) {
      add({bodies.link_of(p.capsule), -1, static_cast<int>(p.other), "touch in every posture"});
    }
  }
  for (const Pair& p : bodies.with_capsules) {
    add({bodies.link_of(p.capsule), bodies.link_of(p.other), -1, "touch in every posture"});
  }
  RandomStream random(0);
  const Trajectory at_rest;  // hull and links move with the vehicle
  Posture posture(bodies, at_rest);
  for (int i = 0; i < kSampledPostures && !always.empty(); ++i) {
    const JointRow q = drawn_posture(bodies.arm, random);
    posture.set({q.data(), static_cast<std::size_t>(q.size())}, 0.0);
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
  // A hull that the whole arm is in is a mistake to see, too.
  const int last = static_cast<int>(bodies.arm.links().size()) - 1;
  if (std::ranges::any_of(always, [&](const ExcludedPair& pair) {
        return pair.obstacle >= 0 && pair.link == last;
      })) {
    std::erase_if(always, [](const ExcludedPair& pair) { return pair.obstacle >= 0; });
  }
  for (const ExcludedPair& pair : always) exclude(bodies, pair);
}

/// What of a capsule lies farther than `reach` from a point: the longer way from one of its ends up
/// to there; none where both ends are near.
std::optional<LinkCapsule> without_ball(const LinkCapsule& capsule, const Vec3& middle,
                                        double reach) {
  const Vec3 start = capsule.start - middle, span = capsule.end - capsule.start;
  const bool start_near = start.norm() < reach, end_near = (start + span).norm() < reach;
  if (start_near && end_near) return std::nullopt;
  if (!start_near && !end_near) return capsule;
  // |start + t span|² = reach²: it leaves the ball once.
  const double a = span.squaredNorm(), b = start.dot(span), c = start.squaredNorm() - reach * reach;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  LinkCapsule rest = capsule;
  if (end_near) {
    rest.end = middle + start + (-b - root) / a * span;
  } else {
    rest.start = middle + start + (-b + root) / a * span;
  }
  return rest;
}

/// The pairs of an arm whose tool may touch the scene.
void spare_the_tip(Bodies& bodies, double depth) {
  constexpr double kLeastReach = 1e-3;  // [m]
  const int last = static_cast<int>(bodies.arm.links().size()) - 1;
  const Vec3 tip = link_from_tool(bodies.arm).translation();
  for (const Pair& pair : bodies.with_obstacles) {
    const LinkCapsule& capsule = bodies.capsules[pair.capsule];
    if (!bodies.obstacles[pair.other].is_scene() || capsule.link != last ||
        capsule.start_link != last) {
      bodies.with_obstacles_but_tip.push_back(pair);
      continue;
    }
    const auto rest =
        without_ball(capsule, tip, depth + std::max(2.0 * capsule.radius, kLeastReach));
    if (!rest) continue;
    bodies.with_obstacles_but_tip.push_back({bodies.capsules.size(), pair.other});
    bodies.capsules.push_back(*rest);
  }
}

/// Ends of a capsule's axis and its radius: the greatest distance of its points from one.
double farthest(const Capsule& capsule, const Vec3& point) {
  return std::max((capsule.start - point).norm(), (capsule.end - point).norm()) + capsule.radius;
}

}  // namespace

Pose link_from_tool(const Arm& arm) {
  return arm.links().back().row_from_link.inverse() * arm.flange() * arm.tool();
}

Bodies make_bodies(Arm arm, const Surroundings& surroundings) {
  check(surroundings, arm);
  Bodies bodies{.arm = std::move(arm)};
  bodies.arm.set_base(surroundings.vehicle_from_base);
  bodies.pose_std = surroundings.vehicle_pose_std;
  bodies.angle_std = bodies.pose_std.tail<3>().maxCoeff();
  bodies.capsules =
      surroundings.capsules.empty() ? capsules_of_rows(bodies.arm) : surroundings.capsules;
  bodies.obstacles = obstacles_of(surroundings, bodies.arm);
  pair_up(bodies, surroundings);
  exclude_what_always_touches(bodies);
  spare_the_tip(bodies, surroundings.tip_depth);
  return bodies;
}

double pose_margin(const Bodies& bodies, const Vec3& point) {
  if (bodies.pose_std.isZero()) return 0.0;
  constexpr double kDeviations = 3.0;
  Eigen::Matrix3d cross;
  cross << 0.0, -point.z(), point.y(), point.z(), 0.0, -point.x(), -point.y(), point.x(), 0.0;
  const Vec3 origin = bodies.pose_std.head<3>(), turn = bodies.pose_std.tail<3>();
  Eigen::Matrix3d covariance = cross * turn.cwiseAbs2().asDiagonal() * cross.transpose();
  covariance.diagonal() += origin.cwiseAbs2();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
  return kDeviations * std::sqrt(std::max(0.0, solver.eigenvalues()[2]));
}

void Posture::set(std::span<const double> q, double time) {
  time_ = time;
  vehicle_from_world_ = world_from_vehicle_->at(time).inverse();
  compute_row_frames(bodies_->arm, q, frames_);
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    placed_[i] = placed(bodies_->arm, bodies_->capsules[i], frames_);
  }
}

Pose Posture::obstacle_pose(const Obstacle& obstacle) const {
  Pose pose = Pose::Identity();
  if (obstacle.frame() == kWorldFrame) pose = vehicle_from_world_;
  if (obstacle.frame() >= 0) {
    const auto link = static_cast<std::size_t>(obstacle.frame());
    pose = frames_.world_from_row[link] * bodies_->arm.links()[link].row_from_link;
  }
  return pose * obstacle.motion().at(time_);
}

Nearness Posture::to_obstacle(const Pair& pair, double within) const {
  const Obstacle& obstacle = bodies_->obstacles[pair.other];
  const Capsule& own = placed_[pair.capsule];
  if (obstacle.frame() == kVehicleFrame && !obstacle.moved()) {
    return obstacle.nearest(own, within);
  }
  double margin = 0.0;
  if (obstacle.frame() == kWorldFrame && !bodies_->pose_std.isZero()) {
    margin = std::max(pose_margin(*bodies_, own.start), pose_margin(*bodies_, own.end)) +
             3.0 * bodies_->angle_std * own.radius;
  }
  const Pose vehicle_from_obstacle = obstacle_pose(obstacle);
  Nearness found =
      obstacle.nearest(in_frame(own, vehicle_from_obstacle.inverse()), within + margin);
  found.distance -= margin;
  found.axis_point = vehicle_from_obstacle * found.axis_point;
  found.surface_point = vehicle_from_obstacle * found.surface_point;
  return found;
}

double Posture::drift(const Pair& pair, double duration) const {
  const Obstacle& obstacle = bodies_->obstacles[pair.other];
  const Capsule& own = placed_[pair.capsule];
  double moved = 0.0;
  // A rotation moves a point by its angle times the distance from the centre in the posture; the
  // rest only turns along.
  const auto add = [&](const Trajectory& motion, const Vec3& center) {
    if (!motion.moves()) return;
    const Trajectory::Rates rates = motion.max_rates(time_ - duration, time_ + duration);
    moved += duration * (rates.linear + rates.angular * farthest(own, center));
  };
  if (obstacle.frame() == kWorldFrame) add(*world_from_vehicle_, Vec3::Zero());
  add(obstacle.motion(), obstacle_pose(obstacle).translation());
  return moved;
}

}  // namespace bathyal::workspace
