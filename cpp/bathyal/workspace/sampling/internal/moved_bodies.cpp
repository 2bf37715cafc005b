// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/internal/moved_bodies.hpp"

namespace bathyal::workspace {
namespace {

/// Motion of the body behind a joint from that of the body before it.
void pass_joint(const Joint& joint, const Pose& frame, double rate, double change,
                BodyMotion& motion) {
  const Vec3 axis = frame.linear().col(2);
  Screw unit;
  if (joint.type == JointType::kRevolute) {
    unit = {frame.translation().cross(axis), axis};
  } else {
    unit.linear = axis;
  }
  const Screw& before = motion.velocity;
  // The axis itself is carried along: d/dt unit = before × unit.
  motion.acceleration.linear += change * unit.linear + rate * (before.angular.cross(unit.linear) +
                                                               before.linear.cross(unit.angular));
  motion.acceleration.angular += change * unit.angular + rate * before.angular.cross(unit.angular);
  motion.velocity.linear += rate * unit.linear;
  motion.velocity.angular += rate * unit.angular;
}

double rate_of(const Joint& joint, std::span<const double> rates) {
  if (rates.empty() || joint.type == JointType::kFixed) return 0.0;
  return joint.multiplier * rates[static_cast<std::size_t>(joint.coordinate)];
}

/// About the centre of mass, in the vehicle's axes.
Eigen::Matrix3d turned_inertia(const RigidBody& body, const Pose& frame) {
  return frame.linear() * body.inertia * frame.linear().transpose();
}

}  // namespace

template <class Visit>
void MovedBodies::each(const Visit& visit) const {
  const std::vector<Link>& links = arm_->links();
  for (std::size_t k = 0; k < links.size(); ++k) {
    visit(links[k].body, Pose(frames_.world_from_row[k] * links[k].row_from_link), k);
  }
  visit(*attached_, frames_.world_from_tool, links.size() - 1);
}

template <class Visit>
void MovedBodies::each_moving(std::span<const double> velocity,
                              std::span<const double> acceleration, const Visit& visit) const {
  const std::vector<Joint>& joints = arm_->joints();
  std::vector<BodyMotion> motions(joints.size() + 1);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    motions[k + 1] = motions[k];
    if (joints[k].type == JointType::kFixed) continue;
    pass_joint(joints[k], frames_.world_from_row[k], rate_of(joints[k], velocity),
               rate_of(joints[k], acceleration), motions[k + 1]);
  }
  each([&](const RigidBody& body, const Pose& frame, std::size_t row) {
    visit(body, frame, motions[row]);
  });
}

Vec3 MovedBodies::mass_moment(double water_density) const {
  Vec3 sum = Vec3::Zero();
  each([&](const RigidBody& body, const Pose& frame, std::size_t) {
    sum += body.mass * (frame * body.center_of_mass) -
           water_density * body.volume * (frame * body.center_of_buoyancy);
  });
  return sum;
}

double MovedBodies::net_mass(double water_density) const {
  double sum = 0.0;
  each([&](const RigidBody& body, const Pose&, std::size_t) {
    sum += body.mass - water_density * body.volume;
  });
  return sum;
}

Screw MovedBodies::weight(const Vec3& gravity, double water_density) const {
  return {net_mass(water_density) * gravity, mass_moment(water_density).cross(gravity)};
}

Screw MovedBodies::momentum(std::span<const double> velocity) const {
  Screw sum;
  each_moving(velocity, {}, [&](const RigidBody& body, const Pose& frame, const BodyMotion& m) {
    const Vec3 center = frame * body.center_of_mass;
    const Vec3& spin = m.velocity.angular;
    sum.add(body.mass * (m.velocity.linear + spin.cross(center)), center);
    sum.angular += turned_inertia(body, frame) * spin;
  });
  return sum;
}

Screw MovedBodies::momentum_rate(std::span<const double> velocity,
                                 std::span<const double> acceleration) const {
  Screw sum;
  each_moving(velocity, acceleration,
              [&](const RigidBody& body, const Pose& frame, const BodyMotion& m) {
                const Vec3 center = frame * body.center_of_mass;
                const Vec3& spin = m.velocity.angular;
                const Eigen::Matrix3d inertia = turned_inertia(body, frame);
                const Vec3 center_velocity = m.velocity.linear + spin.cross(center);
                const Vec3 center_acceleration = m.acceleration.linear +
                                                 m.acceleration.angular.cross(center) +
                                                 spin.cross(center_velocity);
                sum.add(body.mass * center_acceleration, center);
                sum.angular += inertia * m.acceleration.angular + spin.cross(inertia * spin);
              });
  return sum;
}

}  // namespace bathyal::workspace
