// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/environment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

constexpr double kRealLimit = 2.78, kImaginaryLimit = 2.83;  // of the Runge–Kutta method
constexpr double kCreep = 0.01;     // speed at which friction has √½ of its force [m/s]
constexpr double kSlipRate = 50.0;  // at most so fast does friction bring a slip to rest [1/s]

/// Share of a ball that lies below a level `height` above its middle.
double ball_below(double radius, double height) {
  const double h = std::clamp(height / radius, -1.0, 1.0);
  return 0.25 * (1.0 + h) * (1.0 + h) * (2.0 - h);
}

Vec6 wrench_at(const Vec3& point, const Vec3& force) {
  Vec6 wrench;
  wrench << force, point.cross(force);
  return wrench;
}

}  // namespace

void ContactOptions::check() const {
  check_positive("contact frequency", frequency);
  check_not_negative("contact damping", damping);
  check_not_negative("contact friction", friction);
}

Environment::Environment(Water water, std::optional<Scene> scene, ContactOptions contact)
    : water_(std::move(water)), scene_(std::move(scene)), contact_(contact) {
  contact_.check();
}

Flow Environment::flow(const Vec3& point, double time) const {
  Vec3 place = point;
  if (water_.surface()) {
    place.z() = std::min(place.z(), water_.surface_height(place.x(), place.y(), time));
  }
  const Waves::Motion motion = water_.motion(place, time);
  return {motion.velocity, motion.acceleration};
}

double Environment::submerged(const Vehicle& vehicle, const Pose& world_from_vehicle,
                              double time) const {
  const auto& parts = vehicle.options().parts;
  if (!water_.surface() || parts.empty()) return 1.0;
  double below = 0.0, whole = 0.0;
  for (const VehiclePart& part : parts) {
    const Vec3 middle = world_from_vehicle * part.center;
    const double level = water_.surface_height(middle.x(), middle.y(), time);
    below += part.volume * ball_below(part.radius, level - middle.z());
    whole += part.volume;
  }
  return below / whole;
}

Vec6 Environment::emerged(const Vehicle& vehicle, const VehicleState& state, const Flow& flow,
                          double time) const {
  const VehicleOptions& options = vehicle.options();
  const Pose& pose = state.world_from_vehicle;
  double whole = 0.0, lost = 0.0;
  Vec3 moment = Vec3::Zero();
  for (const VehiclePart& part : options.parts) {
    const Vec3 middle = pose * part.center;
    const double level = water_.surface_height(middle.x(), middle.y(), time);
    const double out = part.volume * (1.0 - ball_below(part.radius, level - middle.z()));
    whole += part.volume;
    lost += out;
    moment += out * part.center;
  }
  if (lost == 0.0) return Vec6::Zero();
  const Vec3 up = pose.linear().row(2).transpose();
  const Vec3 pushed = pose.linear().transpose() * flow.acceleration;
  const Vec3 density_force = options.water_density * (options.gravity * up + pushed);
  const double scale = options.body.volume / whole;
  Vec6 wrench;
  wrench << -scale * lost * density_force, -scale * moment.cross(density_force);
  Vec6 relative = state.velocity;
  relative.head<3>() -= pose.linear().transpose() * flow.velocity;
  return wrench - lost / whole * vehicle.drag(relative);
}

Vec6 Environment::contact(const Vehicle& vehicle, const VehicleState& state) const {
  const VehicleOptions& options = vehicle.options();
  const Pose& pose = state.world_from_vehicle;
  double reach = 0.0;
  for (const VehiclePart& part : options.parts) {
    reach = std::max(reach, part.center.norm() + part.radius);
  }
  Vec6 wrench = Vec6::Zero();
  if (scene_->nearest(pose.translation()).distance > reach) return wrench;

  const double count = static_cast<double>(options.parts.size());
  const double mass = options.body.mass / std::sqrt(count);
  const double stiffness = mass * contact_.frequency * contact_.frequency;
  const double viscosity = 2.0 * contact_.damping * mass * contact_.frequency;
  const Vec3 linear = state.velocity.head<3>(), angular = state.velocity.tail<3>();
  for (const VehiclePart& part : options.parts) {
    const Vec3 middle = pose * part.center;
    const NearestPoint nearest = scene_->nearest(middle);
    if (nearest.distance >= part.radius || nearest.distance == 0.0) continue;
    const Vec3 normal = pose.linear().transpose() * ((middle - nearest.point) / nearest.distance);
    const Vec3 touched = part.center - normal * nearest.distance;
    const Vec3 velocity = linear + angular.cross(touched);
    const double speed = velocity.dot(normal);
    const double push =
        std::max(0.0, stiffness * (part.radius - nearest.distance) - viscosity * speed);
    const Vec3 slip = velocity - speed * normal;
    const double hold = contact_.friction * push;
    const double creep = std::max(kCreep, hold / (kSlipRate * mass));
    const Vec3 drag = hold / std::sqrt(slip.squaredNorm() + creep * creep) * slip;
    wrench += wrench_at(touched, push * normal - drag);
  }
  return wrench;
}

Vec6 Environment::wrench(const Vehicle& vehicle, const VehicleState& state, const Flow& flow,
                         double time) const {
  Vec6 wrench = Vec6::Zero();
  if (vehicle.options().parts.empty()) return wrench;
  if (water_.surface()) wrench += emerged(vehicle, state, flow, time);
  if (scene_) wrench += contact(vehicle, state);
  return wrench;
}

double Environment::largest_step(const Vehicle& vehicle) const {
  const double count = static_cast<double>(vehicle.options().parts.size());
  if (!scene_ || count == 0.0) return std::numeric_limits<double>::infinity();
  const double together = std::sqrt(count);  // all parts against one's share of stiffness
  const double spring = kImaginaryLimit / (contact_.frequency * std::sqrt(together));
  const double damper =
      kRealLimit / (2.0 * contact_.damping * contact_.frequency * together + kSlipRate);
  return std::min(spring, damper);
}

}  // namespace bathyal
