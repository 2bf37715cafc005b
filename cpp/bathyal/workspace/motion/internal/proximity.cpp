// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/proximity.hpp"

#include <algorithm>

namespace bathyal::workspace {
namespace {

constexpr double kNoDirection = 1e-9;  // [m]; axis and surface that touch

/// Where a point on a capsule's axis is along it, 0 to 1.
double fraction_along(const Capsule& capsule, const Vec3& point) {
  const Vec3 axis = capsule.end - capsule.start;
  const double squared = axis.squaredNorm();
  return squared > 0.0 ? std::clamp((point - capsule.start).dot(axis) / squared, 0.0, 1.0) : 0.0;
}

class Gradients {
 public:
  Gradients(const Bodies& bodies, const Posture& posture) : bodies_(bodies), posture_(posture) {}

  /// Velocity of the point of a capsule's axis; its start may hang on the link before.
  Eigen::MatrixXd of_axis(std::size_t capsule, const Vec3& point) const {
    const LinkCapsule& own = bodies_.capsules[capsule];
    const double fraction = fraction_along(posture_.capsule(capsule), point);
    if (own.start_link == own.link) return of_link(own.link, point);
    return (1.0 - fraction) * of_link(own.start_link, posture_.capsule(capsule).start) +
           fraction * of_link(own.link, posture_.capsule(capsule).end);
  }

  Eigen::MatrixXd of_link(int link, const Vec3& point) const {
    return point_jacobian(bodies_.arm, posture_.frames(), link, point);
  }

 private:
  const Bodies& bodies_;
  const Posture& posture_;
};

NearPair obstacle_pair(const Bodies& bodies, const Gradients& gradients, const Pair& pair,
                       const Nearness& near) {
  NearPair found{near.distance, bodies.link_of(pair.capsule), static_cast<int>(pair.other), -1,
                 Eigen::VectorXd::Zero(bodies.arm.size())};
  const Vec3 apart = near.axis_point - near.surface_point;
  const double gap = apart.norm();
  if (!(gap > kNoDirection)) return found;
  // An axis inside gets out through the nearest point of the surface.
  const double margin = bodies.is_in_world(pair.other) ? pose_margin(bodies, near.axis_point) : 0.0;
  const bool inside = near.distance + margin < -bodies.capsules[pair.capsule].radius;
  const Vec3 away = (inside ? -1.0 : 1.0) / gap * apart;
  Eigen::MatrixXd velocity = gradients.of_axis(pair.capsule, near.axis_point);
  const int frame = bodies.obstacles[pair.other].frame();
  if (frame >= 0) velocity -= gradients.of_link(frame, near.surface_point);
  found.gradient = velocity.transpose() * away;
  return found;
}

NearPair self_pair(const Bodies& bodies, const Posture& posture, const Gradients& gradients,
                   const Pair& pair, double distance) {
  NearPair found{distance, bodies.link_of(pair.capsule), -1, bodies.link_of(pair.other),
                 Eigen::VectorXd::Zero(bodies.arm.size())};
  const Capsule &one = posture.capsule(pair.capsule), &other = posture.capsule(pair.other);
  const SegmentPair at = nearest_of_segments(one.start, one.end, other.start, other.end);
  const Vec3 own = one.start + at.first * (one.end - one.start);
  const Vec3 against = other.start + at.second * (other.end - other.start);
  const double gap = (own - against).norm();
  if (!(gap > kNoDirection)) return found;
  found.gradient =
      (gradients.of_axis(pair.capsule, own) - gradients.of_axis(pair.other, against)).transpose() *
      ((own - against) / gap);
  return found;
}

/// The balls at a capsule's ends against the same obstacle.
void add_ends(const Bodies& bodies, const Posture& posture, const Gradients& gradients,
              const Pair& pair, double within, std::vector<NearPair>& found) {
  const Capsule& own = posture.capsule(pair.capsule);
  const Obstacle& obstacle = bodies.obstacles[pair.other];
  const Pose vehicle_from_obstacle = posture.obstacle_pose(obstacle);
  for (const Vec3& end : {own.start, own.end}) {
    Nearness near =
        obstacle.nearest(in_frame({end, end, own.radius}, vehicle_from_obstacle.inverse()), within);
    if (!(near.distance < within)) continue;
    near.axis_point = vehicle_from_obstacle * near.axis_point;
    near.surface_point = vehicle_from_obstacle * near.surface_point;
    if (bodies.is_in_world(pair.other)) near.distance -= pose_margin(bodies, near.axis_point);
    found.push_back(obstacle_pair(bodies, gradients, pair, near));
  }
}

}  // namespace

Eigen::MatrixXd point_jacobian(const Arm& arm, const RowFrames& frames, int link,
                               const Vec3& point) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3, arm.size());
  for (int k = 0; k < link; ++k) {
    const Joint& joint = arm.joints()[static_cast<std::size_t>(k)];
    if (joint.coordinate < 0) continue;
    const Pose& before = frames.world_from_row[static_cast<std::size_t>(k)];
    const Vec3 axis = before.linear().col(2);
    jacobian.col(joint.coordinate) +=
        joint.multiplier * (joint.type == JointType::kPrismatic
                                ? axis
                                : Vec3(axis.cross(point - before.translation())));
  }
  return jacobian;
}

std::vector<NearPair> near_pairs(const Bodies& bodies, const Posture& posture, double within,
                                 TipContact tip_contact) {
  const Gradients gradients(bodies, posture);
  std::vector<NearPair> found;
  for (const Pair& pair : bodies.obstacle_pairs(tip_contact)) {
    const Nearness near = posture.to_obstacle(pair, within);
    if (!(near.distance < within)) continue;
    found.push_back(obstacle_pair(bodies, gradients, pair, near));
    add_ends(bodies, posture, gradients, pair, within, found);
  }
  for (const Pair& pair : bodies.with_capsules) {
    const double distance = posture.to_capsule(pair);
    if (distance < within) {
      found.push_back(self_pair(bodies, posture, gradients, pair, distance));
    }
  }
  return found;
}

}  // namespace bathyal::workspace
