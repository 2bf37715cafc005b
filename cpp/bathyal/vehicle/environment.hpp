// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "bathyal/scene/scene.hpp"
#include "bathyal/vehicle/vehicle.hpp"
#include "bathyal/water/water.hpp"

namespace bathyal {

/// How a vehicle's parts meet the bottom: each a damped spring along the direction from the nearest
/// point of the scene to its middle, and Coulomb's friction across it.
struct ContactOptions {
  double frequency = 40.0;  ///< √(k √n / m) of n parts' springs [rad/s], above 0
  double damping = 0.5;     ///< ratio to the critical, 0 or more
  double friction = 0.5;    ///< coefficient, 0 or more

  /// \throw std::invalid_argument
  void check() const;
};

/// The water around a vehicle and what it may touch.
class Environment {
 public:
  /// \param scene What it may touch, as at one moment; none: nothing.
  explicit Environment(Water water, std::optional<Scene> scene = {}, ContactOptions contact = {});

  const Water& water() const { return water_; }

  /// Current and orbits of waves at a point of the world; those at the surface above it.
  Flow flow(const Vec3& point, double time) const;

  /// What differs from a vehicle that is wholly under water and touches nothing: lost buoyancy and
  /// drag of the parts that are out of the water, and forces of contact. About the vehicle's origin
  /// in its frame [N, N m]; zero for a vehicle without parts. Added mass stays whole.
  Vec6 wrench(const Vehicle& vehicle, const VehicleState& state, const Flow& flow,
              double time) const;

  /// Share of the volume that is under water, 0 to 1.
  double submerged(const Vehicle& vehicle, const Pose& world_from_vehicle, double time) const;

  /// The largest step that contact bears [s]; infinite without a scene or parts.
  double largest_step(const Vehicle& vehicle) const;

 private:
  Vec6 emerged(const Vehicle& vehicle, const VehicleState& state, const Flow& flow,
               double time) const;
  Vec6 contact(const Vehicle& vehicle, const VehicleState& state) const;

  Water water_;
  std::optional<Scene> scene_;
  ContactOptions contact_;
};

}  // namespace bathyal
