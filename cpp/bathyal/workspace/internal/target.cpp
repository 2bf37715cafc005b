// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/target.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/internal/postures.hpp"

namespace bathyal::workspace {
namespace {

constexpr double kInside = 1e-6;  // [m]; a target on the bottom is not under it
constexpr Index kPostures = 24;   // that are tried of a target
constexpr double kLimitAngle = 0.01, kLimitLength = 1e-3;

/// What the point itself lies in, and how far it is from what it must not lie in. `point` is in the
/// vehicle's frame.
TargetCheck check_point(const Workspace& workspace, const Bodies& bodies, const Vec3& point,
                        const Posture& at_time) {
  TargetCheck found;
  const Surroundings& around = workspace.surroundings();
  const std::size_t first_keepout = around.hull ? 1 : 0;
  bool in_hull = false, in_ground = false;
  for (std::size_t i = 0; i < bodies.obstacles.size(); ++i) {
    const Obstacle& obstacle = bodies.obstacles[i];
    if (obstacle.frame() >= 0) continue;  // moves with the arm
    const Vec3 own = at_time.obstacle_pose(obstacle).inverse() * point;
    double distance = obstacle.nearest({own, own, 0.0}).distance;
    // Targets are in the world: what is fixed to the vehicle may be elsewhere.
    if (!bodies.is_in_world(i)) distance -= pose_margin(bodies, point);
    found.distance = std::min(found.distance, distance);
    if (!(distance < -kInside)) continue;
    if (obstacle.is_hull()) {
      in_hull = true;
    } else if (obstacle.is_scene()) {
      in_ground = true;
    } else if (found.keepout < 0) {
      found.keepout = static_cast<int>(i - first_keepout);
    }
  }
  if (in_hull) {
    found.status = TargetIndicator::kHull;
  } else if (found.keepout >= 0) {
    found.status = TargetIndicator::kKeepOut;
  } else if (in_ground) {
    found.status = TargetIndicator::kGround;
  }
  return found;
}

bool at_limit(const Arm& arm, const double* q) {
  for (const Joint& joint : arm.joints()) {
    if (joint.coordinate < 0) continue;
    const double near = joint.type == JointType::kPrismatic ? kLimitLength : kLimitAngle;
    const Index k = joint.coordinate;
    if (q[k] < arm.lower()[k] + near || q[k] > arm.upper()[k] - near) return true;
  }
  return false;
}

/// Postures whose tip is in the point, each from a start of its own; the first by all of the
/// search.
JointMatrix postures(const Arm& arm, const Vec3& point, const TargetQuery& query) {
  Pose target = Pose::Identity();
  target.translation() = point;
  InverseOptions options{.task = InverseTask::kPosition, .num_threads = 1};
  options.seed = query.seed;
  const InverseResult found = inverse(arm, row_major(target), JointView(nullptr, 0, 0), options);
  if (found.status[0] != InverseStatus::kReached) return JointMatrix(0, arm.size());
  JointMatrix starts(kPostures, arm.size());
  RandomStream random(query.seed);
  for (Index i = 0; i < kPostures; ++i) starts.row(i) = drawn_posture(arm, random);
  options.max_starts = 1;
  const JointMatrix others = reached_postures(arm, target, starts, options).q;
  JointMatrix q(others.rows() + 1, arm.size());
  q << found.q, others;
  return q;
}

/// Which of the postures is best: free and away from the limits, free at one, in collision; among
/// those the one with the most room.
void check_postures(const Workspace& workspace, const JointMatrix& q, double time,
                    TargetCheck& check) {
  const std::vector<Clearance> clear =
      workspace.clearance(view_of(q), {&time, 1}, TipContact::kAllowed, 1);
  const auto rank = [&](std::size_t i) {
    const double room = clear[i].least();
    const bool free = room > 0.0;
    const bool limited = at_limit(workspace.arm(), q.data() + static_cast<Index>(i) * q.cols());
    return std::tuple(free, free && !limited, room);
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < clear.size(); ++i) {
    if (rank(i) > rank(best)) best = i;
  }
  const auto [free, away, room] = rank(best);
  check.status = away   ? TargetIndicator::kFree
                 : free ? TargetIndicator::kLimit
                        : TargetIndicator::kCollision;
  const double* row = q.data() + static_cast<Index>(best) * q.cols();
  check.q.assign(row, row + q.cols());
}

}  // namespace

std::vector<TargetCheck> check_targets(const Workspace& workspace, const Bodies& bodies,
                                       PointView points, const TargetQuery& query) {
  std::vector<TargetCheck> found(static_cast<std::size_t>(points.rows()));
  const Trajectory& motion = workspace.surroundings().world_from_vehicle;
  const Pose vehicle_from_world = motion.at(query.time).inverse();
  parallel_for(found.size(), 1, query.num_threads, [&](std::size_t begin, std::size_t end) {
    Posture posture(bodies, motion);
    posture.set(std::vector<double>(static_cast<std::size_t>(bodies.arm.size())), query.time);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 point = vehicle_from_world * Vec3(points.row(static_cast<Index>(i)).transpose());
      found[i] = check_point(workspace, bodies, point, posture);
      const JointMatrix q = postures(bodies.arm, point, query);
      if (q.rows() > 0) {
        const TargetIndicator of_point = found[i].status;
        check_postures(workspace, q, query.time, found[i]);
        if (of_point != TargetIndicator::kFree) found[i].status = of_point;
      } else if (found[i].status == TargetIndicator::kFree) {
        found[i].status = TargetIndicator::kUnreachable;
      }
    }
  });
  return found;
}

}  // namespace bathyal::workspace
