// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/geometry/rigid_body.hpp"

namespace bathyal::workspace {

/// A force with its moment, or a momentum with its moment, about the origin of the vehicle.
struct Screw {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();

  void add(const Vec3& more, const Vec3& place) {
    linear += more;
    angular += place.cross(more);
  }
};

/// How a body moves: of the point of it that is at the vehicle's origin. Accelerations are spatial
/// ones (Featherstone, Rigid Body Dynamics Algorithms, 2008, eq 2.40): the classical acceleration
/// of that point is linear + angular velocity × linear velocity.
struct BodyMotion {
  Screw velocity;
  Screw acceleration;
};

/// Bodies that an arm carries: its links and one fixed to its tool, in one posture. Poses are in
/// the frame that the arm's base is given in: the vehicle's.
class MovedBodies {
 public:
  MovedBodies(const Arm& arm, const RigidBody& attached) : arm_(&arm), attached_(&attached) {}

  void set(std::span<const double> q) { compute_row_frames(*arm_, q, frames_); }
  const RowFrames& frames() const { return frames_; }

  /// Σ m r − ρ Σ V r [kg m]: what gravity acts on.
  Vec3 mass_moment(double water_density) const;

  /// Σ m − ρ Σ V [kg].
  double net_mass(double water_density) const;

  /// Weight less buoyancy.
  Screw weight(const Vec3& gravity, double water_density) const;

  /// For rates of the coordinates; none: at rest.
  Screw momentum(std::span<const double> velocity) const;

  /// Its derivative. Either may be empty: zero.
  Screw momentum_rate(std::span<const double> velocity, std::span<const double> acceleration) const;

 private:
  /// Calls visit(body, frame_from_body, row) for each link and for the attached body.
  template <class Visit>
  void each(const Visit& visit) const;

  /// Calls visit(body, frame_from_body, motion).
  template <class Visit>
  void each_moving(std::span<const double> velocity, std::span<const double> acceleration,
                   const Visit& visit) const;

  const Arm* arm_;
  const RigidBody* attached_;
  RowFrames frames_;
};

}  // namespace bathyal::workspace
